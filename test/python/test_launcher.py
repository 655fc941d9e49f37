"""scripts/deixis: when it sets up and builds before it runs the front end."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.fixture
def launcher(tmp_path: Path, repository: Path) -> Path:
    """The launcher among stand-ins that say their names."""
    package = tmp_path / "python" / "deixis_frontend"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    (package / "__main__.py").write_text("print('front end')\n", encoding="ascii")
    for name in ("setup", "build"):
        (tmp_path / name).write_text(f"#!/bin/sh\necho {name}\n", encoding="ascii")
        (tmp_path / name).chmod(0o755)
    return Path(shutil.copy(repository / "scripts" / "deixis", tmp_path))


def steps(launcher: Path, *arguments: str) -> list[str]:
    """What was run, in order."""
    environment = {**os.environ, "DEIXIS_PYTHON": sys.executable, "PYTHONPATH": ""}
    return subprocess.run([launcher, *arguments], env=environment, check=True, timeout=30,
                          capture_output=True, text=True).stdout.splitlines()


@pytest.mark.parametrize("arguments", [["demo"], ["demo", "--seconds", "3"]])
def test_the_demonstration_is_built_first(launcher: Path, arguments: list[str]) -> None:
    assert steps(launcher, *arguments) == ["setup", "build", "front end"]


@pytest.mark.parametrize("arguments", [
    [], ["record", "demo"], ["log", "-f", "demo"], ["demo", "--help"], ["-h", "demo"],
    ["demo", "--no-build"]])
def test_nothing_is_built_for_anything_else(launcher: Path, arguments: list[str]) -> None:
    assert steps(launcher, *arguments) == ["front end"]


def test_a_python_that_is_none_is_named(launcher: Path) -> None:
    environment = {**os.environ, "DEIXIS_PYTHON": "/bin/false"}
    done = subprocess.run([launcher, "status"], env=environment, check=False, timeout=30,
                          capture_output=True, text=True)
    assert done.returncode == 1
    assert "DEIXIS_PYTHON=/bin/false is no Python" in done.stderr


def test_an_interrupt_waits_until_the_front_end_can_take_it(launcher: Path) -> None:
    (launcher.parent / "python" / "deixis_frontend" / "__main__.py").write_text(
        "import signal\nprint(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))\n",
        encoding="ascii")
    assert steps(launcher, "status") == ["True"]
