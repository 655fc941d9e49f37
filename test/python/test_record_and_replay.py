"""Recording, replaying and working on logs, on a bus of their own."""

from __future__ import annotations

import os
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import lcm
import pytest
from bench import becomes_true, heed_interrupts
from front_end import deixis, speaking


@contextmanager
def talking(url: str) -> Iterator[None]:
    """Messages on A and B, 50 a second each, while the block runs."""
    with speaking(url, lambda _: ("A", b"a" * 1000), lambda _: ("B", b"b" * 1000)):
        yield


@contextmanager
def recording(url: str, output: Path) -> Iterator[subprocess.Popen[str]]:
    """`deixis record` beside the test; nothing of it is left behind."""
    command = [sys.executable, "-m", "deixis_frontend", "record", "-l", url, "-o", str(output)]
    process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
                               text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               preexec_fn=heed_interrupts)
    try:
        yield process
    finally:
        process.kill()
        process.wait()
        for pid in loggers_of(output):
            os.kill(pid, signal.SIGKILL)


def loggers_of(output: Path) -> list[int]:
    """The lcm-loggers that write to a file, or to what is to become it."""
    pids = [int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit()]
    return [pid for pid in pids if (words := command_line(pid)) and "lcm-logger" in words[0]
            and words[-1].startswith(str(output))]


def command_line(pid: int) -> list[str]:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")[:-1]
    except OSError:
        return []  # Gone.


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
    assert f"created the folder {output.parent}" in result.stdout


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_recording_and_the_logger(url: str, tmp_path: Path,
                                                    number: signal.Signals) -> None:
    output = tmp_path / "x.lcmlog"
    with talking(url), recording(url, output) as record:
        assert becomes_true(lambda: any(part.stat().st_size > 5000
                                        for part in tmp_path.glob("x.lcmlog.*.part")))
        record.send_signal(number)
        said, _ = record.communicate(timeout=10)
    assert record.returncode == 0, said
    assert "recorded" in said and "created" not in said
    assert not loggers_of(output)
    assert channels(output) == {"A", "B"}
    assert list(tmp_path.iterdir()) == [output]


def test_records_the_channels_that_are_named(url: str, tmp_path: Path) -> None:
    output = tmp_path / "x.lcmlog"
    with talking(url):
        deixis(url, "record", "B", "C.*", "--seconds", 0.5, "--output", output)
    assert channels(output) == {"B"}


def test_a_name_is_the_whole_name_among_several_too(url: str, tmp_path: Path) -> None:
    output = tmp_path / "x.lcmlog"
    with speaking(url, *(lambda n, name=name: (name, b"data") for name in ("A", "AX", "XB", "B"))):
        deixis(url, "record", "A", "B", "--seconds", 0.5, "--output", output)
    assert channels(output) == {"A", "B"}


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
    assert not list(tmp_path.iterdir())


def test_an_old_recording_is_kept_when_nothing_came(url: str, log: Path) -> None:
    before = log.read_bytes()
    result = deixis(url, "record", "--force", "--seconds", 0.3, "--output", log)
    assert result.returncode == 1
    assert log.read_bytes() == before
    assert list(log.parent.iterdir()) == [log]


def test_an_old_recording_is_replaced_when_asked_for(url: str, log: Path) -> None:
    with talking(url):
        result = deixis(url, "record", "--force", "--seconds", 0.5, "--output", log)
    assert result.returncode == 0, result.stderr
    assert channels(log) == {"A", "B"}


def test_of_two_recordings_to_one_name_at_once_none_is_lost(url: str, tmp_path: Path) -> None:
    output = tmp_path / "x.lcmlog"
    with talking(url), recording(url, output) as one, recording(url, output) as other:
        assert becomes_true(lambda: sum(part.stat().st_size > 5000
                                        for part in tmp_path.glob("x.lcmlog.*.part")) == 2)
        for record in (one, other):
            record.send_signal(signal.SIGINT)
        said = {record: record.communicate(timeout=10)[0] for record in (one, other)}
    loser, winner = sorted((one, other), key=lambda record: -record.returncode)
    assert (loser.returncode, winner.returncode) == (1, 0), said
    [part] = tmp_path.glob("x.lcmlog.*.part")
    assert f"{output} has come meanwhile" in said[loser] and f"kept in {part}" in said[loser]
    assert "recorded" not in said[loser] and "recorded" in said[winner]
    assert channels(output) >= {"A", "B"} and channels(part) >= {"A", "B"}


def test_records_to_regular_files_only(url: str, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    result = deixis(url, "record", "--force", "--seconds", 0.3, "--output", pipe)
    assert result.returncode == 1
    assert "is no regular file" in result.stderr
    assert pipe.is_fifo()


def test_says_when_the_folder_cannot_be_written(url: str) -> None:
    result = deixis(url, "record", "--seconds", 0.3, "--output", "/proc/x.lcmlog")
    assert result.returncode == 1
    assert "/proc/x.lcmlog cannot be written" in result.stderr


def test_the_logger_ends_when_the_recording_is_killed(url: str, tmp_path: Path) -> None:
    output = tmp_path / "x.lcmlog"
    with talking(url), recording(url, output) as record:
        assert becomes_true(lambda: bool(loggers_of(output)))
        record.kill()
        assert becomes_true(lambda: not loggers_of(output))


def with_logger(folder: Path, script: str) -> dict[str, str]:
    """The environment with a stand-in for lcm-logger, which writes to its file, then does this."""
    logger = folder / "bin" / "lcm-logger"
    logger.parent.mkdir()
    logger.write_text(f'#!/bin/sh\nfor last; do :; done\necho some >"$last"\n{script}\n',
                      encoding="ascii")
    logger.chmod(0o755)
    return {"PATH": f"{logger.parent}:{os.environ['PATH']}"}


def test_says_how_many_messages_a_slow_disk_has_cost(url: str, tmp_path: Path) -> None:
    said = "Can't write to log fast enough.  Dropped"  # As lcm-logger does, unless it is --quiet.
    environment = with_logger(tmp_path, f"""case "$*" in *--quiet*) exec >/dev/null;; esac
        for _ in $(seq 2000); do echo "Summary: log ti:   1sec Events: 42 (  0 MB )"; done
        echo "{said} 30 packets"; echo "{said} 1 packet\"""")
    output = tmp_path / "x.lcmlog"
    result = deixis(url, "record", "--seconds", 5, "--output", output, **environment)
    assert result.returncode == 0 and output.exists()
    assert "at least 31 messages were not recorded" in result.stderr


def test_says_when_the_disk_is_full_and_keeps_what_there_was_before(url: str, log: Path) -> None:
    environment = with_logger(log.parent, 'echo "write: No space left on device" >&2; exit 1')
    before = log.read_bytes()
    result = deixis(url, "record", "--force", "--seconds", 5, "--output", log, **environment)
    assert result.returncode == 1
    assert "the disk is full" in result.stderr
    [part] = log.parent.glob("in.lcmlog.*.part")
    assert f"is kept in {part}" in result.stderr and part.read_text(encoding="ascii") == "some\n"
    assert log.read_bytes() == before


@pytest.mark.parametrize("command", ["record", "replay"])
def test_a_tcp_server_that_is_not_there_is_named(url: str, log: Path, command: str) -> None:
    more = [log] if command == "replay" else []
    result = deixis(url, command, *more, "-l", "tcpq://localhost:1")
    assert result.returncode == 1
    assert "nobody listens on 'tcpq://localhost:1'" in result.stderr


def test_replays_what_was_recorded(url: str, log: Path) -> None:
    bus, heard = lcm.LCM(url), []
    bus.subscribe("A", lambda _, data: heard.append(data))
    result = deixis(url, "replay", log, "--speed", 2)
    assert result.returncode == 0, result.stderr
    end = time.monotonic() + 5
    while len(heard) < 20 and time.monotonic() < end:
        bus.handle_timeout(100)
    assert heard == [b"%d" % number for number in range(20)]
    assert "published 20 messages" in result.stdout


def test_replay_of_no_channel_is_no_success(url: str, log: Path) -> None:
    result = deixis(url, "replay", log, "--channels", "NOPE")
    assert result.returncode == 1
    assert "no channel is 'NOPE'" in result.stderr and "has A" in result.stderr


def test_replay_of_a_cut_off_log_says_how_much_there_was(url: str, log: Path) -> None:
    log.write_bytes(log.read_bytes()[:-1])
    result = deixis(url, "replay", log)
    assert result.returncode == 0, result.stderr
    assert "it ends in the middle of a message" in result.stderr
    assert "published 19 messages" in result.stdout


def test_replay_goes_on_behind_damage(url: str, log: Path) -> None:
    data = log.read_bytes()  # 10 messages of 30 bytes, then 10 of 31
    log.write_bytes(data[:90] + b"noise" * 100 + data[180:])
    result = deixis(url, "replay", log)
    assert result.returncode == 0, result.stderr
    assert "530 bytes are damaged and were passed over" in result.stderr
    assert "published 16 messages" in result.stdout  # That before the noise may hold some.


@pytest.mark.parametrize("channel", ["a\0b", "a" * 64, "\xe9" * 32])
def test_replay_passes_over_channels_that_lcm_does_not_carry(url: str, log: Path,
                                                             channel: str) -> None:
    alien = log.with_name("alien")
    name = channel.encode()
    alien.write_bytes(struct.pack(">IqqII", 0xEDA1DA01, 0, 0, len(name), 4) + name + b"data")
    both = log.with_name("both")
    both.write_bytes(alien.read_bytes() + log.read_bytes())
    result = deixis(url, "replay", both)
    assert result.returncode == 0, result.stderr
    assert "1 messages were passed over: LCM carries channels of 1 to 63 bytes" in result.stderr
    assert "published 20 messages" in result.stdout
    result = deixis(url, "replay", alien)
    assert result.returncode == 1 and "nothing was published" in result.stderr


def test_replay_does_not_wait_for_a_clock_that_jumped(url: str, log: Path) -> None:
    data = log.read_bytes()
    far = data[:12] + (2**62).to_bytes(8, "big") + data[20:30]
    log.write_bytes(far + data)
    result = deixis(url, "replay", log)
    assert result.returncode == 0, result.stderr
    assert "published 21 messages" in result.stdout


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


Offline = Callable[[str], dict[str, str]]


@pytest.fixture
def offline(tmp_path: Path) -> Offline:
    """Makes a stand-in for deixis-offline of shell commands; returns the environment with it."""
    def make(script: str) -> dict[str, str]:
        program = tmp_path / "build" / "bin" / "deixis-offline"
        program.parent.mkdir(parents=True)
        program.write_text(f"#!/bin/sh\n{script}\n", encoding="ascii")
        program.chmod(0o755)
        return {"DEIXIS_BUILD_DIR": str(tmp_path / "build")}

    return make


def test_offline_run_is_handed_over_as_it_is(url: str, log: Path, offline: Offline) -> None:
    result = deixis(url, "run-offline", log, log.with_name("out"), "--services", "a,b", "--set",
                    "a.x=1", "--set", "b.y=2", "--config", "a=f.yaml", "--results-only",
                    **offline('echo "$@"; exit 7'))
    assert result.returncode == 7
    source, target, *options = result.stdout.split()
    assert source == str(log) and target.startswith(str(log.with_name("out")))
    assert options == ("--services a,b --set a.x=1 --set b.y=2 --config a=f.yaml"
                       " --results-only").split()
    assert not list(log.parent.glob("out*"))


def test_offline_run_writes_over_a_log_only_when_asked_for(url: str, log: Path,
                                                           offline: Offline) -> None:
    output = log.with_name("out")
    output.write_text("old", encoding="ascii")
    environment = offline('printf new >"$2"')
    refused = deixis(url, "run-offline", log, output, **environment)
    assert refused.returncode == 1
    assert "is there already" in refused.stderr and "--force" in refused.stderr
    assert output.read_text(encoding="ascii") == "old"
    assert deixis(url, "run-offline", log, output, "--force", **environment).returncode == 0
    assert output.read_text(encoding="ascii") == "new"


def test_an_offline_run_writes_over_nothing_that_came_meanwhile(url: str, log: Path,
                                                                offline: Offline) -> None:
    output = log.with_name("out")
    environment = offline(f'printf new >"$2"; printf old >"{output}"')
    result = deixis(url, "run-offline", log, output, **environment)
    [part] = log.parent.glob("out.*.part")
    assert result.returncode == 1 and f"kept in {part}" in result.stderr
    assert output.read_text(encoding="ascii") == "old"
    assert part.read_text(encoding="ascii") == "new"


def test_an_interrupted_offline_run_leaves_nothing_behind_and_says_so(
        url: str, log: Path, offline: Offline) -> None:
    command = [sys.executable, "-m", "deixis_frontend", "run-offline", str(log),
               str(log.with_name("out"))]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path),
                   **offline('echo some >"$2"; exec sleep 60')}
    with subprocess.Popen(command, env=environment, text=True, stderr=subprocess.PIPE,
                          preexec_fn=heed_interrupts) as process:
        assert becomes_true(lambda: any(part.stat().st_size for part in log.parent.glob("out.*")))
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=10)
    assert process.returncode == 130
    assert "interrupted" in said and "was not written" in said
    assert not list(log.parent.glob("out*"))


def test_an_interrupt_that_comes_while_the_child_is_started_is_heeded(
        url: str, log: Path, offline: Offline) -> None:
    command = [sys.executable, "-m", "deixis_frontend", "run-offline", str(log),
               str(log.with_name("out"))]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path),
                   **offline('kill -INT $PPID; echo some >"$2"; exec sleep 60')}
    for _ in range(3):
        done = subprocess.run(command, env=environment, text=True, capture_output=True, check=False,
                              timeout=20, preexec_fn=heed_interrupts)
        assert done.returncode == 130
        assert "was not written" in done.stderr
        assert not list(log.parent.glob("out*"))


def test_without_multicast_the_cure_is_named(url: str, log: Path,
                                             without_multicast: list[str]) -> None:
    for arguments in (["record", "--seconds", 1], ["replay", log]):
        result = deixis(url, *arguments, prefix=tuple(without_multicast))
        assert result.returncode == 1
        assert "ip route add 224.0.0.0/4 dev lo" in result.stderr


def test_a_logger_that_complains_without_end_goes_on_recording(url: str, tmp_path: Path) -> None:
    logger = tmp_path / "lcm-logger"
    logger.write_text(f"#!{sys.executable}\n"
                      "import signal, sys\n"
                      "signal.signal(signal.SIGINT, signal.SIG_DFL)\n"
                      "sys.stderr.write('too slow\\n' * 100000)\n"
                      "with open(sys.argv[-1], 'w') as log:\n"
                      "    log.write('recorded')\n"
                      "signal.pause()\n", encoding="ascii")
    logger.chmod(0o755)
    result = deixis(url, "record", "--seconds", "2", "-o", tmp_path / "x.lcmlog",
                    PATH=f"{tmp_path}:{os.environ['PATH']}")
    assert (tmp_path / "x.lcmlog").read_text(encoding="ascii") == "recorded", result.stderr
