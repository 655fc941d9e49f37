"""The folder of a running supervisor: its lock and its socket."""

from __future__ import annotations

import fcntl
import hashlib
import os
import stat
import tempfile
from pathlib import Path

from deixis_frontend.errors import UserError

_LONGEST_SOCKET_PATH = 107  # bytes; see unix(7)


class RunFolder:
    """One folder per system name and user.

    It is below /tmp and not in $XDG_RUNTIME_DIR: that one is removed when the user logs out, and is
    not there for services that start with the machine, while a supervisor lives on and must be
    found again by whoever comes next.
    """

    def __init__(self, system_name: str) -> None:
        base = Path(os.environ.get("DEIXIS_RUN_DIR") or _base())
        self.system_name = system_name
        self.path = base / hashlib.sha256(system_name.encode()).hexdigest()[:16]
        self.socket = self.path / "control"
        self._lock_file = self.path / "lock"
        self._locks: list[int] = []
        if len(os.fsencode(self.socket)) > _LONGEST_SOCKET_PATH:
            raise UserError(f"the path of the control socket is too long ({self.socket}):"
                            " name a folder with a shorter path in DEIXIS_RUN_DIR")

    def create(self) -> None:
        """Makes the folder, for this user alone."""
        for folder in (self.path.parent, self.path):
            try:
                folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            except OSError as error:
                raise UserError(f"the folder {folder} for locks and sockets cannot be made"
                                f" ({error.strerror}): name another one in DEIXIS_RUN_DIR"
                                ) from None
            facts = folder.lstat()
            if not stat.S_ISDIR(facts.st_mode) or facts.st_uid != os.getuid():
                raise UserError(f"{folder} belongs to someone else: remove it, or name another"
                                " folder in DEIXIS_RUN_DIR")

    def lock(self, system_file: Path, token: str) -> list[str]:
        """Claims the system for this process; raises UserError when another one has it.

        Returns the tokens of supervisors before us that may have left services behind.
        """
        self.create()
        descriptor = os.open(self._lock_file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        if not _try_lock(descriptor):
            os.close(descriptor)
            raise UserError(self._taken(system_file))
        left_behind = [line for line in self._facts()[2:] if line]
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f"{os.getpid()}\n{system_file}\n{token}\n".encode())
        # A locked folder is passed over by those who tidy up /tmp.
        folder = os.open(self.path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        _try_lock(folder)
        self._locks = [descriptor, folder]
        self.hide()
        return left_behind

    def hide(self) -> None:
        """Takes the socket away, if the system is ours: no new commands."""
        if self._locks:
            self.socket.unlink(missing_ok=True)

    def release(self) -> None:
        """Gives the system up, with nothing left behind."""
        self.hide()
        if self._locks:
            os.ftruncate(self._locks[0], 0)
        for descriptor in self._locks:
            os.close(descriptor)
        self._locks = []

    def is_lost(self) -> bool:
        """True when the lock file that we hold is not, or no more, the one in the folder."""
        try:
            return not os.path.samestat(self._lock_file.stat(), os.fstat(self._locks[0]))
        except OSError:
            return True

    def lock_again(self, system_file: Path, token: str) -> None:
        """Claims the system anew when its folder is lost; raises UserError when another has it."""
        lost, self._locks = self._locks, []
        for descriptor in lost:
            os.close(descriptor)
        self.lock(system_file, token)

    def holder(self) -> str:
        """The process id of the supervisor; "?" when it is not known."""
        try:
            return self._facts()[0]
        except (OSError, IndexError):
            return "?"

    def is_locked(self) -> bool:
        """True while a supervisor lives."""
        try:
            descriptor = os.open(self._lock_file, os.O_RDWR | os.O_CLOEXEC)
        except OSError:
            return False
        try:
            return not _try_lock(descriptor)
        finally:
            os.close(descriptor)

    def _facts(self) -> list[str]:
        return self._lock_file.read_text(encoding="utf-8", errors="replace").splitlines()

    def _taken(self, system_file: Path) -> str:
        pid, its_file = (*self._facts(), "?", "?")[:2]
        if its_file != str(system_file):
            return of_another_file(self.system_name, its_file, pid)
        return (f"the system '{self.system_name}' is looked after by process {pid} already"
                f" ({its_file}): stop it with `deixis stop`")


def of_another_file(system_name: str, its_file: str, pid: int | str) -> str:
    """What to say when the supervisor `pid` has another system file than the one at hand."""
    cure = (f"use --system {its_file}, or give one of them another name" if Path(its_file).exists()
            else f"it is there no more: `kill {pid}` stops it and its services")
    return f"the running system '{system_name}' was started from {its_file}: {cure}"


def _base() -> Path:
    return Path(tempfile.gettempdir()) / f"deixis-{os.getuid()}"


def _try_lock(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
