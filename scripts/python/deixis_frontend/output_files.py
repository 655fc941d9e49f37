"""Files that a command writes: looked at before the work, written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from deixis_frontend.errors import UserError


def require_file(path: Path, option: str) -> None:
    """Raises UserError when no file can be written at `path`; makes the folder that it lies in."""
    if _exists(path, option) and path.is_dir():
        raise UserError(f"{option} {path} is a folder: name a file")
    if path.resolve().is_fifo():  # Opening it waits for a reader, for ever if need be.
        raise UserError(f"{option} {path} is a pipe: name a file")
    _require_writable(path.parent, path, option)


def require_outputs(outputs: dict[str, Path], inputs: dict[str, Path], *, may_replace: bool) -> None:
    """Raises UserError unless each of `outputs`, by its option, can be written without harm.

    None may be an input or another output, no regular file, or, unless `may_replace`, there already.
    """
    taken = {path.resolve(): option for option, path in inputs.items()}
    for option, path in outputs.items():
        require_file(path, option)
        final = path.resolve()
        other = next((name for file, name in taken.items() if _are_same(file, final)), None)
        if other is not None:
            raise UserError(f"{option} and {other} are the same file {path}: name another {option}")
        _require_replaceable(path, option, may_replace=may_replace)
        taken[final] = option


def _are_same(one: Path, other: Path) -> bool:
    """Also of two hard links."""
    return one == other or (one.exists() and other.exists() and one.samefile(other))


def _require_replaceable(target: Path, option: str, *, may_replace: bool) -> None:
    is_there = _exists(target, option)
    if is_there and not target.resolve().is_file():
        raise UserError(f"{option} {target} is no regular file: name another one")
    if is_there and not may_replace:
        raise UserError(f"{target} is there already: name another {option}, or give --force")


def require_folder(path: Path, option: str) -> None:
    """Raises UserError when `path` cannot be a folder to write to; makes it."""
    if _exists(path, option) and not path.is_dir():
        raise UserError(f"{option} {path} is no folder: name one, or a new one")
    _require_writable(path, path, option)


class UnfinishedFile:
    """A file that gets its name when it is complete; till then it is <name>.<pid>.part beside it.

    A context manager: at its end what was not kept is taken away, unless only its name was lacking.
    """

    def __init__(self, target: Path, option: str, *, may_replace: bool) -> None:
        """Makes the file; raises UserError when that fails or `target` must not be replaced."""
        self.target = target
        final = target.resolve()
        _require_replaceable(target, option, may_replace=may_replace)
        self._final = final
        self._may_replace = may_replace
        self._is_wanted = False  # complete, but without a name
        self.path = final.with_name(f"{final.name}.{os.getpid()}.part")
        try:
            self.path.open("wb").close()
        except OSError as error:
            raise _refusal(target, option, error) from None

    @property
    def size(self) -> int:
        """Bytes so far."""
        return self.path.stat().st_size

    def __enter__(self) -> UnfinishedFile:
        return self

    def __exit__(self, *_: object) -> None:
        self.discard()

    def keep(self) -> None:
        """Gives the file its name, in the place of one that has it if that may be replaced.

        Raises UserError when it may not, or when that fails; the file stays where it is then.
        """
        self._is_wanted = True
        try:
            if not self._may_replace:
                self._take_free_name()
            else:
                self.path.replace(self._final)
        except FileExistsError:
            raise self._nameless(f"{self.target} has come meanwhile",
                                 "`mv` it to a free name") from None
        except OSError as error:
            raise self._nameless(f"{self.target} cannot be written: {error.strerror}",
                                 "`mv` it to another folder") from None

    def discard(self) -> None:
        """Takes the file away unless it was kept, or is complete and only lacks its name."""
        if not self._is_wanted:
            self.path.unlink(missing_ok=True)

    def _take_free_name(self) -> None:
        """Raises FileExistsError when another one has the name: of several at once one gets it."""
        try:
            os.link(self.path, self._final)
        except FileExistsError:
            raise
        except OSError:  # No hard links here, as on FAT: an empty file holds the name meanwhile.
            self._final.open("xb").close()
            try:
                self.path.replace(self._final)
            except OSError:
                self._final.unlink()
                raise
        else:
            self.path.unlink()

    def _nameless(self, fault: str, cure: str) -> UserError:
        return UserError(f"{fault}: what was written is kept in {self.path}: {cure}")


def write_text(path: Path, text: str, option: str) -> None:
    """Writes a file, or leaves the old one as it is and raises UserError."""
    if _exists(path, option) and not path.resolve().is_file():
        _write(path, text, path, option)  # /dev/stdout, say
        return
    with UnfinishedFile(path, option, may_replace=True) as file:
        _write(file.path, text, path, option)
        file.keep()


def _write(path: Path, text: str, named: Path, option: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise _refusal(named, option, error) from None


def _exists(path: Path, option: str) -> bool:
    """Whether there is anything of that name; raises UserError when there can be nothing."""
    try:
        return path.resolve().exists()
    except OSError as error:
        raise _refusal(path, option, error) from None


def _require_writable(folder: Path, path: Path, option: str) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # By trying: what the mode bits say holds neither for root nor for /proc.
        with tempfile.TemporaryFile(dir=folder):
            return
    except OSError as error:
        raise _refusal(path, option, error) from None


def _refusal(path: Path, option: str, error: OSError) -> UserError:
    return UserError(f"{path} cannot be written: {error.strerror}: name another {option}")
