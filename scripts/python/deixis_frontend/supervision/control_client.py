"""Talks to the supervisor of a system; starts one when there is none."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl, require_bus
from deixis_frontend.supervision.guard import TOKEN_VARIABLE
from deixis_frontend.supervision.run_folder import RunFolder, of_another_file
from deixis_frontend.supervision.supervisor import log_folder
from deixis_frontend.supervision.system_file import System

_APPEARS_WITHIN_S = 15.0
_POLL_S = 0.02
_ANSWERS_WITHIN_S = 10.0  # a supervisor that is well takes some milliseconds
Line = dict[str, Any]


class Client:
    """Commands for the supervisor of one system."""

    def __init__(self, system: System, layout: Layout) -> None:
        self._system = system
        self._layout = layout
        self._folder = RunFolder(system.name)

    def is_supervised(self) -> bool:
        """True while the system has a supervisor."""
        return self._folder.is_locked()

    def command(self, command: str, names: list[str],
                on_service: Callable[[Line], None] = lambda _: None) -> Line:
        """Has a command carried out; calls on_service with the facts of each service done."""
        if command != "status":
            status = self.own_status()  # A supervisor that hangs is told from one that works.
            if command in ("start", "restart") and status.get("file_digest") != self._system.digest:
                print(f"deixis: {self._system.path} has changed since the system was started, which"
                      " goes on as it was: `deixis restart` without names takes the changes",
                      file=sys.stderr)
        with self._connect() as connection:
            request = {"command": command, "names": names,
                       "system_file": str(self._system.path.resolve())}
            connection.sendall(json.dumps(request).encode() + b"\n")
            if command != "status":
                connection.settimeout(None)  # Services may take as long as their entries allow.
            return self._answer(connection, on_service)

    def own_status(self) -> Line:
        """What the supervisor says; UserError when its system file is not the one at hand."""
        status: Line = self.command("status", [])["status"]
        if status["file"] != str(self._system.path.resolve()):
            raise UserError(of_another_file(self._system.name, status["file"],
                                            status["supervisor_pid"]))
        return status

    def _answer(self, connection: socket.socket, on_service: Callable[[Line], None]) -> Line:
        try:
            for text in connection.makefile("r", encoding="utf-8"):
                line = json.loads(text)
                if line.get("done"):
                    return self._checked(line)
                on_service(line)
        except TimeoutError:
            raise self._hangs() from None
        raise UserError("the supervisor ended in the middle of the command:"
                        f" see {self.log_file}, then `deixis start` again")

    @property
    def log_file(self) -> Path:
        """Where the supervisor itself writes."""
        return log_folder(self._system, self._layout) / "supervisor.log"

    def ensure_supervisor(self, url: LcmUrl, *, url_is_wanted: bool,
                          while_pid: int | None = None) -> None:
        """Starts a supervisor on `url` unless there is one.

        One on another bus will do, unless somebody asked for just this one (url_is_wanted). With
        while_pid it ends when that process has ended.
        """
        if not (self.is_supervised() and self._appears()):
            require_bus(url)
            self._layout.use_types()
            self._folder.create()
            self._spawn(url, ["--while-pid", str(while_pid)] if while_pid else [])
        self._check_same(url if url_is_wanted else None)

    def wait_until_gone(self, seconds: float = 10.0) -> bool:
        """True when the supervisor has ended within the time."""
        return _becomes_true(lambda: not self.is_supervised(), seconds)

    def _check_same(self, url: LcmUrl | None) -> None:
        status = self.own_status()
        if url and status["lcm_url"] != str(url):
            raise UserError(f"the system '{self._system.name}' runs on {status['lcm_url']} already,"
                            f" not on {url}: `deixis stop` first")

    def _appears(self) -> bool:
        """True when a locked system answers; false when its supervisor has gone meanwhile."""
        _becomes_true(lambda: self._answers() or not self.is_supervised(), _APPEARS_WITHIN_S)
        if self._answers():
            return True
        if self.is_supervised():
            raise UserError(f"the supervisor of '{self._system.name}' does not answer:"
                            f" see {self.log_file}, or kill the process named in the first line"
                            f" of {self._folder.path / 'lock'}")
        return False

    def _spawn(self, url: LcmUrl, options: list[str]) -> None:
        with self._open_log() as log:
            begin = log.tell()
            daemon = subprocess.Popen(
                [sys.executable, "-m", "deixis_frontend.supervision.daemon",
                 "--system", str(self._system.path.resolve()), "--lcm-url", str(url), *options],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=_environment(),
                start_new_session=True)
        _becomes_true(lambda: self._answers() or daemon.poll() is not None, _APPEARS_WITHIN_S)
        if daemon.poll() is not None and not (self.is_supervised() and self._appears()):
            said = self.log_file.read_bytes()[begin:].decode(errors="replace").strip()
            raise UserError(said or f"the supervisor did not start: see {self.log_file}")
        # It may be another one that answers, started in the same moment: as good as ours.
        if not self._answers():
            raise UserError(f"the supervisor does not answer: see {self.log_file}")

    def _open_log(self) -> BinaryIO:
        try:
            self.log_file.parent.mkdir(parents=True, exist_ok=True)
            return self.log_file.open("ab")
        except OSError as error:
            raise UserError(f"{self.log_file} cannot be written ({error.strerror}): name another"
                            f" folder under log.folder in {self._system.path}") from None

    def _hangs(self) -> UserError:
        pid = self._folder.holder()
        return UserError(f"the supervisor of '{self._system.name}' (pid {pid}) has not answered for"
                         f" {_ANSWERS_WITHIN_S:g} s: `kill -CONT {pid}` lets it go on if it was"
                         f" stopped, `kill -KILL {pid}` ends it and its services")

    def _answers(self) -> bool:
        try:
            self._connect().close()
        except UserError:
            return False
        return True

    def _connect(self) -> socket.socket:
        connection = socket.socket(socket.AF_UNIX)
        connection.settimeout(_ANSWERS_WITHIN_S)
        try:
            connection.connect(str(self._folder.socket))
        except BlockingIOError:  # Others wait already, more than it has room for.
            connection.close()
            raise self._hangs() from None
        except OSError:
            connection.close()
            raise UserError(f"nothing runs of the system '{self._system.name}':"
                            " `deixis start` first") from None
        return connection

    def _checked(self, line: Line) -> Line:
        if line.get("error"):
            raise UserError(line["error"])
        return line


def _environment() -> dict[str, str]:
    package_folder = str(Path(__file__).resolve().parents[2])
    path = [package_folder, *filter(None, [os.environ.get("PYTHONPATH")])]
    others = {key: value for key, value in os.environ.items() if key != TOKEN_VARIABLE}
    return {**others, "PYTHONPATH": os.pathsep.join(path), "PYTHONUNBUFFERED": "1"}


def _becomes_true(condition: Callable[[], bool], seconds: float) -> bool:
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(_POLL_S)
    return True
