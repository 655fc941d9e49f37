"""A system of fake services with everything it needs in one folder."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from deixis_frontend.supervision.guard import stop_all

_HERE = Path(__file__).resolve().parent


class Bench:
    """Writes a system file, runs `deixis` on it, knows what should be left when it is over."""

    def __init__(self, folder: Path, types: Path, url: str) -> None:
        self.folder = folder
        self.url = url
        self.system_file = folder / "system.yaml"
        self.logs = folder / "logs"
        self._environment = {
            **os.environ,
            "DEIXIS_BUILD_DIR": str(folder),
            "DEIXIS_RUN_DIR": str(folder / "run"),
            "PYTHONPATH": os.pathsep.join([str(_HERE.parents[1] / "scripts/python"), str(types)]),
            "LCM_DEFAULT_URL": url,
        }
        (folder / "python").symlink_to(types)
        self._write_program()

    def write(self, services: dict[str, dict[str, Any]], **top: Any) -> None:
        """Writes the system file; each service is a fake one, its instance being its name."""
        for name, service in services.items():
            service.setdefault("service", "fake")
            service.setdefault("program", "deixis-fake")
            service.setdefault("instance", name)
        system = {"name": "bench", "log": {"folder": str(self.logs)}, "services": services, **top}
        self.system_file.write_text(json.dumps(system), encoding="utf-8")  # JSON is YAML.

    def deixis(self, command: str, *arguments: str,
               **environment: str) -> subprocess.CompletedProcess[str]:
        """Runs a command of the front end to its end."""
        return self._run(self.command(command, *arguments), environment)

    def deixis_bare(self, command: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """The same without an option that names the system file."""
        return self._run([sys.executable, "-m", "deixis_frontend", command], environment)

    def deixis_below(self, prefix: list[str],
                     command: str) -> subprocess.CompletedProcess[str]:
        """Runs a command of the front end by way of another program."""
        return self._run([*prefix, *self.command(command)], {})

    @contextmanager
    def stranger(self, instance: str) -> Iterator[None]:
        """A fake service beside the system, which the supervisor has not started."""
        process = subprocess.Popen([self.folder / "bin/deixis-fake", "--instance", instance,
                                    "--lcm-url", self.url], env=self._environment)
        try:
            yield
        finally:
            process.kill()
            process.wait()

    def command(self, command: str, *arguments: str) -> list[str]:
        """The command line of a command that deals with this system."""
        return [sys.executable, "-m", "deixis_frontend", command, "--system",
                str(self.system_file), *arguments]

    def begin(self, command: str, *arguments: str,
              output: IO[str] | int = subprocess.PIPE,
              **environment: str) -> subprocess.Popen[str]:
        """Runs a command of the front end beside the test."""
        return subprocess.Popen(self.command(command, *arguments),
                                env={**self._environment, **environment}, text=True,
                                stdout=output, stderr=subprocess.STDOUT, preexec_fn=heed_interrupts)

    def status(self) -> dict[str, Any]:
        """What `status --json` says."""
        return json.loads(self.deixis("status", "--json").stdout)

    def service(self, name: str) -> dict[str, Any]:
        """What `status --json` says of one service."""
        return next(s for s in self.status()["services"] if s["name"] == name)

    def log(self, name: str) -> str:
        """What one service wrote."""
        return (self.logs / f"{name}.log").read_text(encoding="utf-8")

    def end(self) -> None:
        """Leaves nothing running, whatever the test did."""
        locks = list((self.folder / "run").glob("*/lock"))
        for lock in locks:
            self._end_supervisor(lock.read_text(encoding="utf-8").splitlines())

    def _end_supervisor(self, facts: list[str]) -> None:
        if facts and is_alive(int(facts[0])):
            os.kill(int(facts[0]), signal.SIGTERM)
            becomes_true(lambda: not is_alive(int(facts[0])))
        stop_all(*facts[2:])

    def _run(self, command: list[str],
             environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, env={**self._environment, **environment}, text=True,
                              capture_output=True, check=False, timeout=60)

    def _write_program(self) -> None:
        program = self.folder / "bin" / "deixis-fake"
        program.parent.mkdir()
        program.write_text(f"#!/bin/sh\nexec {sys.executable} {_HERE / 'fake_service.py'} \"$@\"\n",
                           encoding="ascii")
        program.chmod(0o755)


def heed_interrupts() -> None:
    """A run in the background ignores SIGINT, one under nohup SIGHUP, and both hand that down."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


@contextmanager
def killed_after(seconds: float, process: subprocess.Popen[str]) -> Iterator[None]:
    """Kills the process when the block takes longer: who reads from it does not wait for ever."""
    timer = threading.Timer(seconds, process.kill)
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def becomes_true(condition: Callable[[], bool], seconds: float = 10.0) -> bool:
    """True as soon as the condition holds; false when it does not within the time."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def has_read(pid: int, path: Path) -> bool:
    """True when the process has the file open and has read it to its end."""
    for link in Path(f"/proc/{pid}/fd").iterdir():
        if link.exists() and link.samefile(path):
            [position] = [line.split()[1] for line in Path(
                f"/proc/{pid}/fdinfo/{link.name}").read_text(encoding="ascii").splitlines()
                if line.startswith("pos:")]
            return int(position) == path.stat().st_size
    return False


def is_alive(pid: int) -> bool:
    """True when the process is there and has not ended."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
    except OSError:
        return False
    return text.rpartition(")")[2].split()[0] != "Z"
