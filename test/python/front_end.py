"""The front end as its users run it, and buses and logs to run it on."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import lcm
from bench import heed_interrupts, killed_after
from deixis import channel_status_t, drop_count_t, service_status_t

Event = tuple[int, str, bytes]  # time in microseconds, channel, data


def deixis(url: str, *arguments: object, prefix: Sequence[str] = (), stdin: str = "",
           seconds: float = 60.0, **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs a command of the front end to its end."""
    return run(url, [*prefix, sys.executable, "-m", "deixis_frontend", *arguments], stdin=stdin,
               seconds=seconds, **environment)


def run(url: str, command: Sequence[object], *, stdin: str = "", seconds: float = 60.0,
        **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs any program to its end, on the bus `url`."""
    return subprocess.run(list(map(str, command)), env=_environment(url) | environment, input=stdin,
                          capture_output=True, text=True, check=False, timeout=seconds)


@contextmanager
def deixis_beside(url: str, *arguments: object,
                  seconds: float = 60.0) -> Iterator[subprocess.Popen[str]]:
    """Runs a command beside the test; nothing of it is left behind, nor after so many seconds."""
    command = [sys.executable, "-m", "deixis_frontend", *map(str, arguments)]
    with subprocess.Popen(command, env=_environment(url), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, preexec_fn=heed_interrupts) as process:
        try:
            with killed_after(seconds, process):
                yield process
        finally:
            process.kill()


def _environment(url: str) -> dict[str, str]:
    return {**os.environ, "LCM_DEFAULT_URL": url, "PYTHONPATH": os.pathsep.join(sys.path)}


@contextmanager
def speaking(url: str, *speakers: Callable[[int], tuple[str, bytes]],
             period_s: float = 0.02) -> Iterator[None]:
    """While the block runs, each speaker (number -> channel, data) publishes on a bus of its own."""
    over = threading.Event()
    buses = [lcm.LCM(url) for _ in speakers]

    def speak() -> None:
        number = 0
        while not over.wait(period_s):
            for bus, speaker in zip(buses, speakers, strict=True):
                bus.publish(*speaker(number))
            number += 1

    thread = threading.Thread(target=speak)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


def write_log(path: Path, events: list[Event]) -> Path:
    """A log of these events."""
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for event in events:
        log.write_event(*event)
    log.close()
    return path


def status(service: str, inputs: tuple[str, ...] = (), outputs: tuple[str, ...] = (), *,
           wrong: int = 0, **values: object) -> service_status_t:
    """What a running service says; it refused `wrong` messages on each input for their type."""
    message = service_status_t()
    message.service, message.host, message.pid = service, "host", 1
    message.version, message.state = "0.1.0", service_status_t.RUNNING
    message.channels = [*(_channel(name, channel_status_t.IN, wrong) for name in inputs),
                        *(_channel(name, channel_status_t.OUT, 0) for name in outputs)]
    message.n_channels = len(message.channels)
    for name, value in values.items():
        setattr(message, name, value)
    return message


def _channel(name: str, direction: int, wrong: int) -> channel_status_t:
    channel = channel_status_t()
    channel.name, channel.direction = name, direction
    if wrong:
        drop = drop_count_t()
        drop.reason, drop.count = "wrong_type", wrong
        channel.drops, channel.n_drops = [drop], 1
    return channel
