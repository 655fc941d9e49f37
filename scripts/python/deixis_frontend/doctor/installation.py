"""What is installed: Python and its modules, message types, programs."""

from __future__ import annotations

import importlib.metadata
import platform
import re
import subprocess
import sys
from pathlib import Path

from deixis_frontend import __version__, lcm_tools
from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Finding
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.supervision.system_file import System

# Who needs which of the requirements; the rest of them is for tests and figures.
_FRONT_END = ("lcm", "numpy", "PyYAML")
_EXPORT = ("foxglove-schemas-protobuf", "mcap", "mcap-protobuf-support", "protobuf", "zstandard")
_ANSWERS_WITHIN_S = 10.0


def python(layout: Layout) -> list[Finding]:
    """This Python and the modules of the requirements, in the tested versions.

    Installed, those that only tests and figures need are not asked for.
    """
    if sys.version_info < (3, 11):
        return [Finding(PROBLEM, "python", f"{sys.executable} is {platform.python_version()}: 3.11"
                        " or later is needed", "export DEIXIS_PYTHON=/usr/bin/python3")]
    needed = {name: tested for name, tested in _requirements().items()
              if layout.repository or name in (*_FRONT_END, *_EXPORT)}
    faults = [fault for name, tested in needed.items()
              if (fault := _module_fault(name, tested, layout))]
    users = ", ".join(dict.fromkeys(map(_user, needed)))
    return faults or [Finding(OK, "python", f"{platform.python_version()} has what requirements.txt"
                              f" lists for: {users}")]


def _requirements() -> dict[str, str]:
    file = Path(__file__).resolve().parents[2] / "requirements.txt"
    lines = file.read_text(encoding="utf-8").split()
    return {name: version for name, _, version in (line.partition("==") for line in lines)}


def _user(name: str) -> str:
    if name in _FRONT_END:
        return "the front end"
    return "`deixis export`" if name in _EXPORT else "tests and figures"


def _module_fault(name: str, tested: str, layout: Layout) -> Finding | None:
    cure = ("scripts/setup" if layout.repository
            else f"{sys.executable} -m pip install {name}=={tested}")
    try:
        version = importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return Finding(PROBLEM if name in _FRONT_END else WARNING, "python",
                       f"the module {name}, for {_user(name)}, is missing", cure)
    if layout.repository and version != tested:
        return Finding(WARNING, "python", f"{name} is {version}, tested is {tested}", cure)
    return None


def programs(layout: Layout, system: System) -> list[Finding]:
    """The message types, and the program of every service, all of one version."""
    cure = "scripts/build" if layout.repository else ""
    layout.use_types()
    names = dict.fromkeys(entry.program for entry in system.services.values())
    findings = [fault for name in names if (fault := _program_fault(layout, name, cure))]
    return findings or [Finding(OK, "programs", f"{len(names)} programs of version {__version__}")]


def recorder() -> list[Finding]:
    """LCM's logger, which `deixis record` runs."""
    return [Finding(OK, "recorder", f"{lcm_tools.find_logger()} is there")]


def _program_fault(layout: Layout, name: str, cure: str) -> Finding | None:
    try:
        path = layout.program(name)
        done = subprocess.run([str(path), "--version"], capture_output=True, text=True,
                              errors="replace", check=False, timeout=_ANSWERS_WITHIN_S)
    except UserError as error:
        return Finding(PROBLEM, "programs", str(error), cure)
    except (OSError, subprocess.TimeoutExpired) as error:
        return Finding(PROBLEM, "programs", f"{name} --version does not run: {error}", cure)
    version = re.search(r"\d+\.\d+\.\d+", done.stdout)
    if version and version[0] == __version__:
        return None
    said = version[0] if version else "not told"
    return Finding(PROBLEM, "programs", f"version of {path} is {said}, of the front end"
                   f" {__version__}", cure)
