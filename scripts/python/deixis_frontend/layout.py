"""Where programs, configuration, types and logs are: in a repository or below a prefix."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.errors import UserError


@dataclass(frozen=True)
class Layout:
    """The folders that the front end works with."""

    repository: Path | None  # None when installed
    programs: Path
    config: Path
    types: Path  # generated Python message types
    state: Path  # logs and output are written below this
    clips: Path

    def program(self, name: str) -> Path:
        """The path of the built program `name`; raises UserError when it is not there."""
        path = Path(name) if "/" in name else self.programs / name
        if not path.is_absolute():
            path = (self.repository or Path.cwd()) / path
        if os.access(path, os.X_OK) and path.is_file():
            return path
        cure = "run scripts/build" if self.repository else "install Deixis again"
        raise UserError(f"program {name} not found in {path.parent}: {cure}")

    def config_file(self, name: str) -> Path:
        """`name` as given when it exists, else below the configuration folder."""
        given = Path(name)
        return given if given.is_absolute() or given.exists() else self.config / name

    def use_types(self) -> None:
        """Makes `import deixis` (the generated message types) work."""
        if not (self.types / "deixis").is_dir():
            cure = "run scripts/build" if self.repository else "install Deixis again"
            raise UserError(f"no Python message types in {self.types}: {cure}")
        if str(self.types) not in sys.path:
            sys.path.insert(0, str(self.types))


def find() -> Layout:
    """The layout that this file stands in."""
    package = Path(__file__).resolve().parent
    root = package.parents[2]
    if (root / "lcmtypes").is_dir() and (root / "CMakeLists.txt").exists():
        return _repository(root)
    return _installed(package.parents[3], package.parent)


def _repository(root: Path) -> Layout:
    build = Path(os.environ.get("DEIXIS_BUILD_DIR") or root / "build" / "release")
    build = build if build.is_absolute() else root / build
    return Layout(
        repository=root,
        programs=build / "bin",
        config=root / "config",
        types=build / "python",
        state=root,
        clips=root / "test" / "data" / "clips",
    )


def _installed(prefix: Path, python: Path) -> Layout:
    share = prefix / "share" / "deixis"
    state = os.environ.get("XDG_STATE_HOME") or str(Path.home() / ".local" / "state")
    return Layout(
        repository=None,
        programs=prefix / "bin",
        config=share / "config",
        types=python,
        state=Path(state) / "deixis",
        clips=share / "clips",
    )
