"""Stands in for a stereo camera: sends recorded pairs at a rate, whoever keeps up with it.

A camera does not wait: a pair whose time has passed before it could be sent is left out. The recording is played to
and fro, so that nobody jumps where it ends.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from deixis_frontend.bus import open_bus
from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.layout import Layout, find
from deixis_frontend.lcm_url import LcmUrl, parse
from deixis_frontend.programs import run_program

CHANNEL = "STEREO_PAIR"


def write_pairs(layout: Layout, settings: Iterable[str], folder: Path) -> Path:
    """A log with the pairs of a recording, by the stereo driver; `settings` are its own, with videos in a loop."""
    log = folder / "pairs.lcmlog"
    said = [*(s for s in settings if s != "source.loop=true"), "publishes_pairs=true", "pace=as_fast_as_possible"]
    run_program(layout, "deixis-stereo-driver", "--lcm-url", f"file://{log}?mode=w",
                *(word for setting in said for word in ("--set", setting)))
    return log


def start(layout: Layout, pairs: Path, url: LcmUrl, rate_hz: float) -> subprocess.Popen[bytes]:
    """A process of its own that sends the pairs until it is ended."""
    return subprocess.Popen([sys.executable, "-m", __name__, str(pairs), str(url), str(rate_hz)],
                            env=layout.environment(), preexec_fn=end_with_parent(signal.SIGTERM))


def to_and_fro(count: int) -> Iterator[int]:
    """0 1 ... n-1 n-2 ... 1 0 1 ..., for ever."""
    while True:
        yield from range(count)
        yield from range(count - 2, 0, -1)


def send(pairs: list[Any], publish: Any, rate_hz: float) -> None:
    """For ever: each pair at its time, which is its capture time; what is late by more than a period is left out."""
    begin, period_s = time.time(), 1.0 / rate_hz
    for number, place in enumerate(to_and_fro(len(pairs))):
        due = begin + number * period_s
        if time.time() > due + period_s:
            continue
        time.sleep(max(0.0, due - time.time()))
        publish(stamped(pairs[place], int(due * 1e6)).encode())


def stamped(pair: Any, utime: int) -> Any:
    """The same pair, taken at another time."""
    pair.utime = utime
    for image in pair.images:
        image.utime = utime
    return pair


def main(log: str, url: str, rate_hz: str) -> None:
    """Sends a log's pairs."""
    find().use_types()
    from deixis_lcm import logs

    pairs = [message for _, _, message in logs.read(Path(log), {CHANNEL})]
    bus = open_bus(parse(url))
    send(pairs, lambda data: bus.publish(CHANNEL, data), float(rate_hz))


if __name__ == "__main__":
    main(*sys.argv[1:])
