"""Runs the pointing chain, or that of bodies, live on a clip and measures what a robot would: loss, age, CPU, memory.

The services run as processes of their own on a private port of this machine, the clip in a loop at the
rate that is asked for. With --stereo the pictures are matched on the way, and the chain works on the
left one. With --bodies a process in the place of a camera sends pairs; they are matched at full size where people are,
and bodies fitted. The figures come from their SERVICE_STATUS and from /proc; how old depth and bodies are, from their
messages as they arrive here.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from deixis_frontend import layout, lcm_url
from deixis_frontend.bus import open_bus
from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import live_camera, report_options
from deixis_frontend.evaluation.live_arrivals import Arrivals, body_report, print_bodies
from deixis_frontend.number_options import above_zero
from deixis_frontend.process_facts import cpu_seconds, resident_bytes
from deixis_frontend.programs import last_words
from deixis_frontend.received import ChannelDecoder
from deixis_frontend.service_facts import CHANNEL, as_facts

CONSUMERS = ("object_detector", "hand_tracker", "gesture_recogniser")
START_UP_LIMIT_S = 20.0
# Time for the last picture's results and for the status that counts them (sent once per second).
SETTLING_S = 2.5
LEAST_SHARE = 0.97  # of the pictures that were asked for; with fewer the source fell behind


@dataclass(frozen=True)
class Feed:
    """What sends the pictures, where to, and how the others are told to look there."""

    driver: str
    channel: str
    settings: tuple[str, ...]
    name: str
    consumers: dict[str, tuple[str, ...]] = field(default_factory=dict)  # and their settings
    pairs: Path | None = None  # log of pairs that a camera sends to the driver; None: the driver plays videos
    rate_hz: float = 0.0  # of those pairs

    @property
    def last(self) -> str:
        """The service whose results are what the chain is there for."""
        return list(self.consumers)[-1]


def _pointing(channel: str) -> dict[str, tuple[str, ...]]:
    looks = (f"image_channel={channel}",)
    return {name: () if name == "gesture_recogniser" else looks for name in CONSUMERS}


def camera_feed(clip: Path, rate_hz: float) -> Feed:
    """One video in a loop."""
    if not clip.is_file():
        raise UserError(f"no clip {clip}: name one with --clip")
    settings = (*_video("source", clip, rate_hz), "source.loop=true")
    return Feed("camera_driver", "CAMERA", settings, clip.name, _pointing("CAMERA"))


def stereo_feed(folder: Path, rate_hz: float) -> Feed:
    """Two videos in a loop with their calibration."""
    for name in ("left.mp4", "right.mp4", "intrinsics.yml", "extrinsics.yml"):
        if not (folder / name).is_file():
            raise UserError(f"{folder} lacks {name}: --stereo and --bodies take a folder with left.mp4,"
                            " right.mp4, intrinsics.yml and extrinsics.yml")
    settings = (*_video("source.left", folder / "left.mp4", rate_hz),
                *_video("source.right", folder / "right.mp4", rate_hz), "source.loop=true",
                f"calibration.intrinsics={(folder / 'intrinsics.yml').resolve()}",
                f"calibration.extrinsics={(folder / 'extrinsics.yml').resolve()}")
    return Feed("stereo_driver", "STEREO", settings, folder.name, _pointing("STEREO"))


def body_feed(folder: Path, rate_hz: float, pairs: Path) -> Feed:
    """The same as pairs that are sent, matched at full size where people are; bodies are fitted as `start stereo` does."""
    stereo = stereo_feed(folder, rate_hz)
    calibration = tuple(s for s in stereo.settings if s.startswith("calibration."))
    return replace(stereo, settings=("source.kind=pair_channel", *calibration, "matcher.match_size=people"),
                   consumers={"pose_fitter": ()}, pairs=pairs, rate_hz=rate_hz)


def _video(key: str, clip: Path, rate_hz: float) -> tuple[str, ...]:
    return (f"{key}.kind=video", f"{key}.path={clip.resolve()}", f"{key}.rate_hz={rate_hz}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to play, at which rate, for how long, and where the figures go."""
    pictures = parser.add_mutually_exclusive_group()
    pictures.add_argument("--clip", type=Path, metavar="FILE",
                          help="video to play in a loop (default: the clip of the demo)")
    pictures.add_argument("--stereo", type=Path, metavar="DIR",
                          help="folder with left.mp4, right.mp4, intrinsics.yml, extrinsics.yml:"
                               " measure with the stereo driver")
    pictures.add_argument("--bodies", type=Path, metavar="DIR",
                          help="the same folder, sent pair by pair: measure stereo driver and pose fitter")
    parser.add_argument("--rate", type=above_zero, default=30.0, help="pictures per second (30)")
    parser.add_argument("--seconds", type=above_zero, default=60.0, help="how long to measure (60)")
    report_options.add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when a service does not get ready."""
    report_options.check(arguments)
    where = layout.find()
    with tempfile.TemporaryDirectory() as folder:
        feed = _feed(arguments, where, Path(folder))
        load = [os.getloadavg()[0]]
        chain = _Chain(where, Path(folder), lcm_url.with_free_port(), feed)
        try:
            chain.start_consumers()
            chain.start_driver()
            services = chain.measure(arguments.seconds)
        finally:
            chain.stop()
    load.append(os.getloadavg()[0])
    result = _result(services, feed, arguments.rate, arguments.seconds)
    result |= {"load_average": load, "bodies": body_report(chain.arrivals, result["pictures_wanted"]) if arguments.bodies else None}
    _print(result)
    report_options.write_json(arguments, result)
    return 0


def _feed(arguments: argparse.Namespace, where: layout.Layout, scratch: Path) -> Feed:
    if arguments.bodies:
        pairs = live_camera.write_pairs(where, stereo_feed(arguments.bodies, arguments.rate).settings, scratch)
        return body_feed(arguments.bodies, arguments.rate, pairs)
    if arguments.stereo:
        return stereo_feed(arguments.stereo, arguments.rate)
    return camera_feed(arguments.clip or where.clips / "spread_01" / "left.mp4", arguments.rate)


def _result(services: dict[str, dict[str, Any]], feed: Feed, rate_hz: float,
            seconds: float) -> dict[str, Any]:
    """The figures of all services, and whether as many pictures came as were asked for.

    CPU time per result says what a service costs also where others load the machine, and it gets less than it wants.
    """
    pictures, wanted = services[feed.driver]["pictures"], round(rate_hz * seconds)
    rows = {name: {**row, "cpu_ms_per_result": 10.0 * row["cpu_percent"] * seconds / max(1, row["pictures"] - row["lost"])}
            for name, row in services.items()}
    return {"summary": rows, "lost": services[feed.last]["lost"],
            "pictures": pictures, "pictures_wanted": wanted,
            "source_fell_behind": pictures < LEAST_SHARE * wanted, "rate_hz": rate_hz,
            "seconds": seconds, "clip": feed.name}


class _Chain:
    """The processes and what their messages say."""

    def __init__(self, where: layout.Layout, folder: Path, url: lcm_url.LcmUrl,
                 feed: Feed) -> None:
        where.use_types()
        from deixis import service_status_t

        self._where = where
        self._folder = folder
        self._url = url
        self._feed = feed
        self._decode = ChannelDecoder(service_status_t, CHANNEL)
        self._bus = open_bus(url)
        self._bus.subscribe(CHANNEL, self._on_status)
        self.arrivals = Arrivals()
        if "pose_fitter" in feed.consumers:
            self.arrivals.listen(self._bus)
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._camera: subprocess.Popen[bytes] | None = None
        self._facts: dict[str, dict[str, Any]] = {}

    def start_consumers(self) -> None:
        """Returns when all of them have spoken."""
        for service, settings in self._feed.consumers.items():
            self._start(service, *settings)
        self._wait_for(tuple(self._feed.consumers))

    def start_driver(self) -> None:
        """Plays the pictures in a loop, or starts the camera; returns when their driver has spoken."""
        self._start(self._feed.driver, *self._feed.settings, "pace=by_time")
        self._wait_for((self._feed.driver,))
        if self._feed.pairs:
            self._camera = live_camera.start(self._where, self._feed.pairs, self._url, self._feed.rate_hz)

    def measure(self, seconds: float) -> dict[str, dict[str, Any]]:
        """The figures of each service over so many seconds; stops the camera.

        UserError when a service has not lived through it: what it said last would be no figures.
        """
        before = self._cpu_seconds()
        start = time.monotonic()
        self._listen(seconds)
        elapsed = time.monotonic() - start
        load = {name: after - before[name] for name, after in self._cpu_seconds().items()}
        memory = {name: resident_bytes(p.pid) for name, p in self._processes.items()}
        self._stop_source()
        self._listen(SETTLING_S)
        self._require_all_alive(self._feed.consumers)
        pictures = _messages(self._facts[self._feed.driver], self._feed.channel, "out")
        return {name: _figures(self._facts[name], name, 100.0 * load[name] / elapsed, memory[name],
                               pictures)
                for name in self._processes}

    def stop(self) -> None:
        """Ends all processes."""
        for process in (*self._processes.values(), *([self._camera] if self._camera else [])):
            _end(process)

    def _cpu_seconds(self) -> dict[str, float]:
        """Of all processes, which are alive then."""
        used = {name: cpu_seconds(p.pid) for name, p in self._processes.items()}
        self._require_all_alive(self._processes)
        return {name: seconds for name, seconds in used.items() if seconds is not None}

    def _start(self, service: str, *settings: str) -> None:
        program = self._where.program("deixis-" + service.replace("_", "-"))
        command = [str(program), "--lcm-url", str(self._url)]
        for setting in settings:
            command += ["--set", setting]
        with (self._folder / f"{service}.log").open("wb") as log:
            self._processes[service] = subprocess.Popen(
                command, stderr=log, preexec_fn=end_with_parent(signal.SIGTERM))

    def _stop_source(self) -> None:
        """What the pictures come from; then no more come."""
        _end(self._camera or self._processes[self._feed.driver])

    def _wait_for(self, services: tuple[str, ...]) -> None:
        deadline = time.monotonic() + START_UP_LIMIT_S
        while not all(service in self._facts for service in services):
            self._listen(0.2)
            self._require_all_alive(services)
            if time.monotonic() > deadline:
                missing = [service for service in services if service not in self._facts]
                raise UserError(f"{', '.join(missing)} did not get ready in {START_UP_LIMIT_S:.0f} s")

    def _require_all_alive(self, services: Iterable[str]) -> None:
        for service in services:
            if self._processes[service].poll() is not None:
                said = last_words((self._folder / f"{service}.log").read_text(errors="replace"))
                raise UserError(f"{service} has ended: {said or 'without a word'}")

    def _listen(self, seconds: float) -> None:
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0:
            self._bus.handle_timeout(max(1, int(1000 * left)))

    def _on_status(self, _channel: str, data: bytes) -> None:
        message = self._decode(data)
        if message is not None:
            self._facts[message.service] = as_facts(message)


def _end(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    try:
        process.wait(5.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _messages(facts: dict[str, Any], channel: str, direction: str) -> int:
    return sum(c["messages"] for c in facts["channels"]
               if c["name"] == channel and c["direction"] == direction)


def _figures(facts: dict[str, Any], service: str, cpu_percent: float, memory: int | None,
             pictures: int) -> dict[str, Any]:
    """The keys of one service; `lost` counts pictures without a result of this service."""
    output = {"camera_driver": "CAMERA", "stereo_driver": "STEREO", "object_detector": "OBJECTS",
              "hand_tracker": "HAND_TRACKS", "gesture_recogniser": "GESTURE_STATE",
              "pose_fitter": "BODY_POSES"}[service]
    return {
        "pictures": pictures,
        "lost": pictures - _messages(facts, output, "out"),
        "gaps": sum(c["gaps"] for c in facts["channels"]),
        "skipped": sum(c["skipped"] for c in facts["channels"]),
        "age_p50_ms": facts["age_ms"]["p50"],
        "age_p99_ms": facts["age_ms"]["p99"],
        "processing_p50_ms": facts["processing_ms"]["p50"],
        "processing_p99_ms": facts["processing_ms"]["p99"],
        "cpu_percent": cpu_percent,
        "memory_mb": None if memory is None else memory / 1e6,
        "receive_buffer_bytes": facts["receive_buffer_bytes"],
    }


def _print(result: dict[str, Any]) -> None:
    print(f"{result['clip']} at {result['rate_hz']:g} Hz for {result['seconds']:g} s:"
          f" {result['pictures']} pictures, {result['lost']} without a result; load of the machine"
          f" {' to '.join(f'{load:.1f}' for load in result['load_average'])}")
    if result["source_fell_behind"]:
        print(f"{result['pictures']} of {result['pictures_wanted']} pictures: the machine is too slow"
              f" for {result['rate_hz']:g} Hz; ages grow with it")
    print(f"{'service':<20}{'lost':>6}{'skipped':>9}{'age p50':>9}{'p99 ms':>8}"
          f"{'work p50':>10}{'p99 ms':>8}{'CPU %':>7}{'ms each':>9}{'MB':>6}")
    for name, row in result["summary"].items():
        print(f"{name:<20}{row['lost']:>6}{row['skipped']:>9}{_number(row['age_p50_ms']):>9}"
              f"{_number(row['age_p99_ms']):>8}{_number(row['processing_p50_ms']):>10}"
              f"{_number(row['processing_p99_ms']):>8}{row['cpu_percent']:>7.1f}{row['cpu_ms_per_result']:>9.1f}"
              f"{_number(row['memory_mb']):>6}")
    if result["bodies"]:
        print_bodies(result["bodies"])


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.1f}"
