"""A virtual display with `deixis spy` on it, and what is to be seen there."""

from __future__ import annotations

import os
import queue
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

import matplotlib.image
import numpy as np

SCREEN = "1500x1250x24"
_PATIENCE_S = 90.0
_LIBRARY = Path(__file__).resolve().parents[2] / "scripts" / "python"


@contextmanager
def virtual_display() -> Iterator[str]:
    """The name of a display that nobody sees; it has ended when the block has."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", SCREEN, "-nolisten", "tcp"],
        pass_fds=[write_end], stderr=subprocess.DEVNULL)
    os.close(write_end)
    try:
        with open(read_end, encoding="ascii") as pipe:
            number = pipe.readline().strip()
        assert number, f"Xvfb did not start (exit code {server.poll()})"
        yield f":{number}"
    finally:
        server.kill()
        server.wait()


def driven_java(folder: Path) -> None:
    """A `java` that starts the test's driver where lcm-spy with our windows was to be started."""
    real = shutil.which("java")
    assert real is not None
    program = folder / "java"
    program.write_text(
        "#!/bin/sh\nfor word; do shift\n"
        "  [ \"$word\" = deixis.spy.Main ] && word=deixis.spy.SpyDriver\n"
        f"  set -- \"$@\" \"$word\"\ndone\nexec {real} \"$@\"\n", encoding="utf-8")
    program.chmod(0o755)


def environment(**changes: str | None) -> dict[str, str]:
    """The environment for `deixis`; None takes a variable out."""
    all_of_them = {**os.environ, "PYTHONPATH": str(_LIBRARY), **changes}
    return {name: value for name, value in all_of_them.items() if value is not None}


def command(*arguments: str) -> list[str]:
    """The command line of `deixis spy`."""
    return [sys.executable, "-m", "deixis_frontend", "spy", *arguments]


class Spy:
    """`deixis spy` under the driver; asks the driver and reads its answers."""

    def __init__(self, url: str, variables: dict[str, str]) -> None:
        self.said: list[str] = []
        self._answers: queue.Queue[str | None] = queue.Queue()
        self.process = subprocess.Popen(
            command("-l", url), env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True)
        threading.Thread(target=self._read, args=(self.process.stdout,), daemon=True).start()

    def ask(self, question: str) -> str:
        """What the driver answers; AssertionError when it has ended, or takes too long."""
        assert self.process.stdin is not None
        try:
            self.process.stdin.write(question + "\n")
            self.process.stdin.flush()
            answer = self._answers.get(timeout=_PATIENCE_S)
        except (queue.Empty, BrokenPipeError):
            answer = None
        assert answer is not None, f"no answer to '{question}':\n" + "\n".join(self.said)
        return answer

    def screen(self, file: Path) -> np.ndarray:
        """The screen, (rows, columns, 3) uint8."""
        self.ask(f"shot {file}")
        return read_screen(file)

    def end(self) -> None:
        """The driver ends when there are no more commands."""
        assert self.process.stdin is not None
        try:
            with suppress(BrokenPipeError):
                self.process.stdin.close()
            self.process.wait(timeout=_PATIENCE_S)
        finally:
            self.process.kill()
            self.process.wait()

    def _read(self, output: IO[str]) -> None:
        for line in output:
            self.said.append(line.rstrip())
            if line.startswith("answer "):
                self._answers.put(line.removeprefix("answer ").strip())
        self._answers.put(None)


def read_screen(file: Path) -> np.ndarray:
    """A screenshot, (rows, columns, 3) uint8."""
    return (matplotlib.image.imread(file)[:, :, :3] * 255).astype(np.uint8)


def places(screen: np.ndarray, box: tuple[int, int, int, int], colour: tuple[int, int, int],
           tolerance: int = 40) -> np.ndarray:
    """(n, 2) rows and columns within the box (x, y, width, height) that have about that colour."""
    x, y, width, height = box
    part = screen[y:y + height, x:x + width].astype(int)
    return np.argwhere((np.abs(part - colour) <= tolerance).all(axis=2))
