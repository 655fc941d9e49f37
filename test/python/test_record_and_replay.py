"""Recording, replaying and working on logs, on a bus of their own."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import lcm
import pytest


def deixis(url: str, *arguments: object, prefix: tuple[str, ...] = (),
           **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs a command of the front end to its end."""
    command = [*prefix, sys.executable, "-m", "deixis_frontend", *map(str, arguments)]
    path = os.pathsep.join(sys.path)
    return subprocess.run(command, env={**os.environ, "LCM_DEFAULT_URL": url, "PYTHONPATH": path,
                                        **environment},
                          capture_output=True, text=True, check=False, timeout=30)


@contextmanager
def talking(url: str) -> Iterator[None]:
    """Messages on A and B, 50 a second each, while the block runs."""
    bus, over = lcm.LCM(url), threading.Event()

    def talk() -> None:
        while not over.wait(0.02):
            bus.publish("A", b"a" * 1000)
            bus.publish("B", b"b" * 1000)

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    over.set()
    thread.join()


def channels(log: Path) -> set[str]:
    return {event.channel for event in lcm.EventLog(str(log), "r")}


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """A log of 20 messages on A, 10 ms apart."""
    path = tmp_path / "in.lcmlog"
    file = lcm.EventLog(str(path), "w", overwrite=True)
    for number in range(20):
        file.write_event(10_000 * number, "A", b"%d" % number)
    file.close()
    return path


def test_records_all_channels(url: str, tmp_path: Path) -> None:
    output = tmp_path / "new folder" / "x.lcmlog"
    with talking(url):
        result = deixis(url, "record", "--seconds", 0.5, "--output", output)
    assert result.returncode == 0, result.stderr
    assert channels(output) == {"A", "B"}


def test_records_the_channels_that_are_named(url: str, tmp_path: Path) -> None:
    output = tmp_path / "x.lcmlog"
    with talking(url):
        deixis(url, "record", "B", "C.*", "--seconds", 0.5, "--output", output)
    assert channels(output) == {"B"}


def test_does_not_write_over_a_recording(url: str, log: Path) -> None:
    before = log.read_bytes()
    result = deixis(url, "record", "--seconds", 0.2, "--output", log)
    assert result.returncode == 1
    assert "is there already: name another --output, or give --force" in result.stderr
    assert log.read_bytes() == before


def test_says_when_nothing_came(url: str, tmp_path: Path) -> None:
    result = deixis(url, "record", "--seconds", 0.3, "--output", tmp_path / "x.lcmlog")
    assert result.returncode == 1
    assert "nothing was recorded" in result.stderr
    assert not (tmp_path / "x.lcmlog").exists()


def test_says_when_the_folder_cannot_be_written(url: str) -> None:
    result = deixis(url, "record", "--seconds", 0.3, "--output", "/proc/x.lcmlog")
    assert result.returncode == 1
    assert "/proc/x.lcmlog cannot be written" in result.stderr


def test_says_when_the_disk_is_full(url: str, tmp_path: Path) -> None:
    (tmp_path / "full").symlink_to("/dev/full")
    with talking(url):
        result = deixis(url, "record", "--force", "--seconds", 5, "--output", tmp_path / "full")
    assert result.returncode == 1
    assert "the disk is full" in result.stderr


def test_replays_what_was_recorded(url: str, log: Path) -> None:
    bus, heard = lcm.LCM(url), []
    bus.subscribe("A", lambda _, data: heard.append(data))
    result = deixis(url, "replay", log, "--speed", 2)
    assert result.returncode == 0, result.stderr
    end = time.monotonic() + 5
    while len(heard) < 20 and time.monotonic() < end:
        bus.handle_timeout(100)
    assert heard == [b"%d" % number for number in range(20)]


@pytest.mark.parametrize("command", ["replay", "run-offline"])
@pytest.mark.parametrize(("content", "fault"), [
    (None, "No such file or directory"), (b"", "is empty"), (b"hello world", "is no LCM log")])
def test_says_what_is_wrong_with_a_log(url: str, tmp_path: Path, command: str,
                                       content: bytes | None, fault: str) -> None:
    path = tmp_path / "x.lcmlog"
    if content is not None:
        path.write_bytes(content)
    more = [tmp_path / "out"] if command == "run-offline" else []
    result = deixis(url, command, path, *more)
    assert result.returncode == 1
    assert fault in result.stderr and "Traceback" not in result.stderr


def test_offline_run_is_handed_over_as_it_is(url: str, log: Path, tmp_path: Path) -> None:
    program = tmp_path / "bin" / "deixis-offline"
    program.parent.mkdir()
    program.write_text("#!/bin/sh\necho \"$@\"; exit 7\n", encoding="ascii")
    program.chmod(0o755)
    result = deixis(url, "run-offline", log, "out", "--services", "a,b", "--set", "a.x=1", "--set",
                    "b.y=2", "--config", "a=f.yaml", DEIXIS_BUILD_DIR=str(tmp_path))
    assert result.returncode == 7
    assert result.stdout.split() == [str(log), "out", *"--services a,b --set a.x=1 --set b.y=2"
                                     " --config a=f.yaml".split()]


def test_without_multicast_the_cure_is_named(url: str, log: Path,
                                             without_multicast: list[str]) -> None:
    for arguments in (["record", "--seconds", 1], ["replay", log]):
        result = deixis(url, *arguments, prefix=tuple(without_multicast))
        assert result.returncode == 1
        assert "ip route add 224.0.0.0/4 dev lo" in result.stderr
