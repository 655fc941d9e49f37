"""Puts units where systemd looks for them, and takes them away again."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.errors import UserError
from deixis_frontend.deployment.systemd_units import MARK
from deixis_frontend.output_files import require_folder, write_text


_SEAL = "# Taken away with the units as long as this is the SHA-256 of the lines below: "


@dataclass(frozen=True)
class UnitFile:
    """A file to write. One that is the user's is not replaced, and removed only unchanged."""

    path: Path
    text: str
    is_users: bool = False

    def is_needed(self) -> bool:
        """Whether writing it changes anything."""
        present = self.present()
        return present is None or (not self.is_users and present != self.text)

    def is_ours(self) -> bool:
        """Whether the file that is there is one that we wrote."""
        present = self.present() or ""
        return _is_unchanged(present) if self.is_users else present.startswith(MARK)

    def present(self) -> str | None:
        """What the file holds; None when there is none."""
        try:
            return self.path.read_text(encoding="utf-8")
        except FileNotFoundError:
            return None
        except (OSError, UnicodeDecodeError) as error:
            raise UserError(f"{self.path} cannot be read: {error}") from None


def sealed(text: str) -> str:
    """The text below a line that tells whether it was changed; for files of comments by `#`."""
    return f"{_SEAL}{hashlib.sha256(text.encode()).hexdigest()}\n{text}"


def _is_unchanged(text: str) -> bool:
    return text == sealed(text.partition("\n")[2])


def write(files: list[UnitFile]) -> None:
    """Writes files; raises UserError when one cannot be, or is somebody else's."""
    for file in files:
        if file.present() is not None and not file.is_ours():
            raise UserError(f"{file.path} is there and not of `deixis install-units`: move it away")
        require_folder(file.path.parent, "folder")
    for file in files:
        write_text(file.path, file.text, "folder")


def remove(files: list[UnitFile]) -> list[Path]:
    """Removes those that are ours; returns those that were left."""
    left = []
    for file in files:
        if not file.is_ours():
            left.append(file.path)
            continue
        try:
            file.path.unlink()
        except OSError as error:
            raise UserError(f"{file.path} cannot be removed: {error.strerror}") from None
    return left


def systemctl(arguments: list[str], *, is_user: bool) -> bool:
    """Runs systemctl; says what went wrong. Where there is none, there is nothing to go wrong."""
    command = ["systemctl", *(["--user"] if is_user else []), *arguments]
    if shutil.which("systemctl") is None:
        print(f"deixis: no systemctl here: `{' '.join(command)}` was not run", file=sys.stderr)
        return True
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        said = (done.stderr.strip().splitlines() or ["it gave no reason"])[-1]
        print(f"deixis: `{' '.join(command)}` failed: {said}", file=sys.stderr)
    return done.returncode == 0
