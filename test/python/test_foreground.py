"""`deixis start --foreground`: the supervisor as systemd and containers want it."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from bench import Bench, becomes_true, is_alive

from deixis_frontend.supervision.echoed_log import EchoedLog
from deixis_frontend.supervision.foreground import Foreground
from deixis_frontend.supervision.rotating_log import RotatingLog

_SECONDS = 30.0


@contextmanager
def foreground(bench: Bench) -> Iterator[subprocess.Popen[str]]:
    """The supervisor in the foreground; it speaks to what the fixture `notices` gives."""
    process = bench.begin("start", "--foreground", NOTIFY_SOCKET=str(bench.folder / "notify"))
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@pytest.fixture
def notices(bench: Bench) -> Iterator[socket.socket]:
    """What NOTIFY_SOCKET names."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as receiver:
        receiver.bind(str(bench.folder / "notify"))
        receiver.settimeout(_SECONDS)
        yield receiver


def await_ready(notices: socket.socket) -> None:
    """Returns when the supervisor has said that its services are ready."""
    assert notices.recv(4096).startswith(b"READY=1\n")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_it_says_when_all_are_ready_and_a_signal_ends_it(
        bench: Bench, notices: socket.socket, number: signal.Signals) -> None:
    bench.write({"a": {"set": {"ready_after_s": 0.3}}, "b": {"after": ["a"]}})
    with foreground(bench) as process:
        assert notices.recv(4096).decode().startswith("READY=1\nSTATUS=2 services")
        pids = [bench.service(name)["pid"] for name in "ab"]
        assert bench.status()["supervisor_pid"] == process.pid
        process.send_signal(number)
        said, _ = process.communicate(timeout=_SECONDS)
    assert process.returncode == 0, said
    assert not any(is_alive(pid) for pid in pids)
    assert bench.deixis("status").returncode == 3


def test_it_shows_what_the_services_write(bench: Bench, notices: socket.socket) -> None:
    bench.write({"a": {"set": {"say": "hello"}}, "b": {}})
    with foreground(bench) as process:
        await_ready(notices)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=_SECONDS)
    assert "a | hello\n" in said and "b | -- " in said
    assert "hello" in bench.log("a")


def test_the_other_commands_work_on_it(bench: Bench, notices: socket.socket) -> None:
    bench.write({"a": {}, "b": {}}, start=["a"])
    with foreground(bench) as process:
        await_ready(notices)
        started = bench.deixis("start", "b")
        assert started.returncode == 0, started.stderr
        assert bench.deixis("restart", "a").returncode == 0
        refused = bench.deixis("restart")
        assert refused.returncode == 1 and "is in the foreground" in refused.stderr
        assert bench.deixis("stop").returncode == 0
        said, _ = process.communicate(timeout=_SECONDS)
    assert process.returncode == 0, said


def test_one_that_is_given_up_ends_it_with_an_error(bench: Bench, notices: socket.socket) -> None:
    bench.write({"a": {}, "b": {"set": {"say": "no camera", "exit_after_s": 0, "exit_code": 1},
                                "give_up_after": 2}})
    with foreground(bench) as process:
        assert notices.recv(4096).decode() == "STATUS=given up: b: all is stopped"
        said, _ = process.communicate(timeout=_SECONDS)
    assert process.returncode == 1
    assert "deixis: given up: b: all is stopped" in said and "b | no camera" in said
    assert bench.deixis("status").returncode == 3


def test_one_that_was_not_asked_for_may_be_given_up(bench: Bench,
                                                    notices: socket.socket) -> None:
    bench.write({"a": {}, "b": {"set": {"exit_after_s": 0, "exit_code": 2}}}, start=["a"])
    with foreground(bench) as process:
        await_ready(notices)
        assert bench.deixis("start", "b").returncode == 1
        assert bench.service("b")["state"] == "failed"
        assert process.poll() is None and bench.service("a")["state"] == "running"


def test_it_is_refused_where_one_runs_already(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    refused = bench.deixis("start", "--foreground")
    assert refused.returncode == 1 and "is looked after by process" in refused.stderr
    assert bench.service("a")["state"] == "running"


def test_nothing_is_left_when_it_is_killed(bench: Bench, notices: socket.socket) -> None:
    bench.write({"a": {}})
    with foreground(bench) as process:
        await_ready(notices)
        pid = bench.service("a")["pid"]
        process.kill()
        process.wait()
        assert becomes_true(lambda: not is_alive(pid), _SECONDS)


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("after", [0.5, 0.0])
def test_it_goes_on_when_nobody_reads_what_it_shows(bench: Bench, notices: socket.socket,
                                                    after: float, unbuffered: str) -> None:
    bench.write({"a": {"set": {"ready_after_s": after, "say": "hello"}}})
    reader, writer = os.pipe()
    process = bench.begin("start", "--foreground", output=writer, PYTHONUNBUFFERED=unbuffered,
                          NOTIFY_SOCKET=str(bench.folder / "notify"))
    try:
        os.close(writer)
        if after:
            os.close(reader)  # Before any service is ready; else when all are.
        await_ready(notices)
        if not after:
            os.close(reader)
        assert bench.deixis("restart", "a").returncode == 0
        assert process.poll() is None and bench.service("a")["state"] == "running"
        process.send_signal(signal.SIGTERM)
        assert process.wait(_SECONDS) == 0
    finally:
        process.kill()
        process.wait()


def test_an_error_of_its_own_ends_it(capfd: pytest.CaptureFixture[str]) -> None:
    class Broken:
        def all_for(self, _: list[str]) -> list[str]:
            raise RuntimeError("broken")

    async def run(foreground: Foreground) -> None:
        end = asyncio.Event()
        foreground.begin(Broken(), end)  # type: ignore[arg-type]
        await asyncio.wait_for(end.wait(), _SECONDS)

    foreground = Foreground([], print)
    asyncio.run(run(foreground))
    assert foreground.exit_code == 1
    assert "error in the supervisor itself: RuntimeError('broken')" in capfd.readouterr().err


class _Closed:
    """A stream that nobody reads."""

    def write(self, _: bytes) -> None:
        raise BrokenPipeError

    def flush(self) -> None:
        raise AssertionError("never written to")


def test_a_log_goes_on_when_nobody_looks_on(tmp_path: Path) -> None:
    log = EchoedLog(RotatingLog(tmp_path / "x.log", 1000, 1), "x", _Closed())  # type: ignore
    log.write(b"one\ntwo")
    log.write(b"\nthree\n")
    log.close()
    assert (tmp_path / "x.log").read_bytes() == b"one\ntwo\nthree\n"


def test_lines_that_steer_a_terminal_are_shown_as_escapes(tmp_path: Path) -> None:
    shown = (tmp_path / "shown").open("w+b")
    log = EchoedLog(RotatingLog(tmp_path / "x.log", 10**6, 1), "x", shown)
    log.write(b"a\t\x1b[2Jb\r\nc\xff\n")
    log.close()
    assert (tmp_path / "shown").read_text("utf-8") == "x | a\t\\x1b[2Jb\nx | c\ufffd\n"
    assert (tmp_path / "x.log").read_bytes() == b"a\t\x1b[2Jb\r\nc\xff\n"


def test_lines_are_shown_whole_with_their_name(tmp_path: Path) -> None:
    shown = (tmp_path / "shown").open("w+b")
    log = EchoedLog(RotatingLog(tmp_path / "x.log", 10**6, 1), "x", shown)
    for piece in (b"on", b"e\ntw", b"o\n", b"y" * 20000, b"end"):
        log.write(piece)
    log.close()
    assert (tmp_path / "shown").read_bytes().split(b"\n") == [
        b"x | one", b"x | two", b"x | " + b"y" * 20000, b"x | end", b""]
