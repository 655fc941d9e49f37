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
    jars: Path
    own_config: Path | None = None  # of DEIXIS_CONFIG_DIR: goes before `config`

    def program(self, name: str) -> Path:
        """The path of the built program `name`; raises UserError when it is not there."""
        path = Path(name) if "/" in name else self.programs / name
        if not path.is_absolute():
            path = (self.repository or Path.cwd()) / path
        if os.access(path, os.X_OK) and path.is_file():
            return path
        cure = "run scripts/build" if self.repository else "install Deixis again"
        raise UserError(f"program {name} not found in {path.parent}: {cure}")

    @property
    def launcher(self) -> Path:
        """The `deixis` of this checkout or installation."""
        return (self.repository / "scripts" if self.repository else self.programs) / "deixis"

    def jar(self, name: str) -> Path:
        """The path of a Java archive that the build makes; raises UserError without it."""
        path = self.jars / name
        if path.is_file():
            return path
        build = "run scripts/build" if self.repository else "build and install Deixis again"
        raise UserError(f"{name} not found in {self.jars}: {build}, where a JDK and lcm.jar are"
                        " (packages default-jdk-headless, liblcm-java)")

    def config_file(self, name: str, beside: Path) -> Path:
        """`name` in the folder `beside` when it is there, else in a configuration folder."""
        given = beside.absolute() / name  # An absolute name stays as it is.
        return given if Path(name).is_absolute() or given.exists() else self.find_config(name)

    def find_config(self, name: str) -> Path:
        """`name` in the user's configuration folder when it is there, else in that of Deixis."""
        own = self.own_config / name if self.own_config else None
        return own if own and own.exists() else self.config / name

    def environment(self) -> dict[str, str]:
        """The environment for the programs, with the configuration folder."""
        return {**os.environ, "DEIXIS_CONFIG_DIR": str(self.own_config or self.config)}

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
        jars=build / "java",
        own_config=_own_config(),
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
        jars=prefix / "share" / "java",
        own_config=_own_config(),
    )


def _own_config() -> Path | None:
    given = os.environ.get("DEIXIS_CONFIG_DIR")
    if not given:
        return None
    if not Path(given).is_dir():
        raise UserError(f"DEIXIS_CONFIG_DIR={given}: no such folder: make it, or unset the"
                        " variable")
    return Path(given).absolute()
