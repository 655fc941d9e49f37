"""Every service against a peer that sends as fast as it can: counted, bounded, obedient, back."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import lcm
import pytest
from bench import becomes_true
from rig_files import HEIGHT, WIDTH, write_rig

_SECONDS = float(os.environ.get("DEIXIS_FLOOD_SECONDS") or 3) / 3  # for each kind of message
_MOST_GROWTH_MB = 250
_LEAST_SHARE = 0.5  # of the numbered messages that are accounted for
_MOST_LOG_BYTES = 20_000


@dataclass(frozen=True)
class Target:
    """A service, what it is flooded with, and how to ask whether it still works."""

    floods: tuple[tuple[str, str], ...]  # channel and kind
    ask: str
    answer: str


TARGETS = {
    "object_detector": Target((("CAMERA", "garbage"), ("CAMERA", "picture")), "CAMERA", "OBJECTS"),
    "hand_tracker": Target((("CAMERA", "garbage"), ("OBJECTS", "objects"), ("CAMERA", "picture")),
                           "CAMERA", "HAND_TRACKS"),
    "gesture_recogniser": Target((("OBJECTS", "garbage"), ("OBJECTS", "objects"),
                                  ("HAND_TRACKS", "hands")), "HAND_TRACKS", "GESTURE_STATE"),
    "viewer": Target((("HAND_TRACKS", "garbage"), ("HAND_TRACKS", "hands"),
                      ("CAMERA", "picture")), "HAND_TRACKS", "SERVICE_STATUS"),
    "stereo_driver": Target((("STEREO_PAIR", "garbage"), ("STEREO_PAIR", "pair")),
                            "STEREO_PAIR", "STEREO"),
}


def settings_of(service: str, folder: Path) -> list[str]:
    """What a service needs to be told so that it writes nowhere else, and listens."""
    if service == "viewer":
        return [f"save_folder={folder}"]
    if service == "stereo_driver":
        return [*write_rig(folder), "source.kind=pair_channel"]
    return []


class Victim:
    """A running service and what it says on the bus."""

    def __init__(self, name: str, url: str, build: Path, folder: Path) -> None:
        self.name, self._url, self._build = name, url, build
        self._log = folder / "log"
        program = build / "bin" / f"deixis-{name.replace('_', '-')}"
        settings = [word for setting in settings_of(name, folder) for word in ("--set", setting)]
        with self._log.open("w", encoding="utf-8") as log:
            self.process = subprocess.Popen([program, "-l", url, *settings], stderr=log)
        self._bus = lcm.LCM(url + "&recv_buf_size=4194304")
        self._bus.subscribe("SERVICE_STATUS", self._hear)
        self.heard: list[Any] = []
        self.answered: list[int] = []

    def expect_answers(self, channel: str, decode: Callable[[bytes], Any]) -> None:
        """Notes the times of the messages on `channel`."""
        self._bus.subscribe(channel, lambda _, data: self.answered.append(decode(data).utime))

    def _hear(self, _channel: str, data: bytes) -> None:
        from deixis import service_status_t
        self.heard.append(service_status_t.decode(data))

    def spin(self) -> None:
        """Takes in what has been said."""
        while self._bus.handle_timeout(1) > 0:
            continue

    def comes(self, condition: Callable[[], bool], seconds: float = 15.0) -> bool:
        """True as soon as the condition holds of what is heard."""
        def holds() -> bool:
            self.spin()
            return condition()
        return becomes_true(holds, seconds)

    def next_status(self) -> Any:
        """The next status that it sends."""
        count = len(self.heard)
        assert self.comes(lambda: len(self.heard) > count), self.log()
        return self.heard[-1]

    def begin_flood(self, channel: str, kind: str, seconds: float) -> subprocess.Popen[str]:
        """Begins to flood a channel of it."""
        command = [self._build / "test/robustness/flood", self._url, channel, kind, str(seconds)]
        return subprocess.Popen(command, text=True, stdout=subprocess.PIPE)

    def publish(self, channel: str, data: bytes) -> None:
        """Sends it a message."""
        self._bus.publish(channel, data)

    def memory_mb(self, kind: str) -> float:
        """VmRSS, or VmHWM: the most so far."""
        text = Path(f"/proc/{self.process.pid}/status").read_text(encoding="ascii")
        return int(text.split(f"{kind}:")[1].split()[0]) / 1e3

    def log(self) -> str:
        """What it wrote."""
        return self._log.read_text(encoding="utf-8")

    def end(self) -> None:
        """Leaves nothing running."""
        self.process.kill()
        self.process.wait()


@pytest.fixture
def victim(request: pytest.FixtureRequest, url: str, build: Path,
           tmp_path: Path) -> Iterator[Victim]:
    """The service that the test is parametrised with, when it has spoken."""
    victim = Victim(request.param, url, build, tmp_path)
    try:
        victim.next_status()
        yield victim
    finally:
        victim.end()


@pytest.mark.parametrize("victim", TARGETS, indirect=True)
def test_a_service_survives_a_flood(victim: Victim) -> None:
    target = TARGETS[victim.name]
    before_mb = victim.memory_mb("VmRSS")
    for channel, kind in target.floods:
        first, began = victim.next_status(), time.monotonic()
        sent = flood_to_its_end(victim, channel, kind)
        last, elapsed_s = victim.next_status(), time.monotonic() - began
        print(f"{victim.name}: {kind} on {channel}: {sent / _SECONDS:.0f} per s sent,"
              f" {describe(last)}, statuses {last.sequence - first.sequence}")
        assert last.sequence - first.sequence >= 0.5 * elapsed_s, "it speaks once per second"
        assert_accounts_for(sent, counted(first, last), is_numbered=kind != "garbage")
    print(f"{victim.name}: answers after {seconds_to_answer(victim, target):.2f} s")
    growth_mb = victim.memory_mb("VmHWM") - before_mb
    print(f"{victim.name}: grew by {growth_mb:.0f} MB, wrote {len(victim.log())} bytes")
    assert growth_mb < _MOST_GROWTH_MB
    assert len(victim.log()) < _MOST_LOG_BYTES
    assert_obeys_during_a_flood(victim, *target.floods[-1])


def flood_to_its_end(victim: Victim, channel: str, kind: str) -> int:
    """Floods; returns how many messages were sent."""
    flood = victim.begin_flood(channel, kind, _SECONDS)
    sent = int(flood.communicate(timeout=60)[0])
    victim.heard.clear()
    victim.spin()
    return sent


def assert_accounts_for(sent: int, counts: dict[str, int], *, is_numbered: bool) -> None:
    """What was sent is counted once; where numbers show gaps, nearly all of it.

    What is lost behind the last one that is taken in leaves no gap. The kernel counts datagrams, of
    which a picture needs many.
    """
    in_datagrams = counts.pop("kernel_buffer_full", 0)
    of_messages = sum(counts.values())
    assert of_messages <= sent, counts
    assert of_messages + in_datagrams >= (_LEAST_SHARE * sent if is_numbered else 1), counts


def counted(first: Any, last: Any) -> dict[str, int]:
    """What a service says that it took in or lost between two statuses, by reason."""
    before = lost(first)
    return {reason: count - before.get(reason, 0) for reason, count in lost(last).items()}


def lost(status: Any) -> dict[str, int]:
    """What a service says that it took in or lost since its start, by reason."""
    counts: dict[str, int] = {}
    for channel in status.channels:
        if channel.direction == channel.IN:
            parts = {"accepted": channel.messages, "gaps": channel.gaps, "skipped": channel.skipped,
                     **{drop.reason: drop.count for drop in channel.drops}}
            for reason, count in parts.items():
                counts[reason] = counts.get(reason, 0) + count
    return counts


def describe(status: Any) -> str:
    """The same for people."""
    return ", ".join(f"{count} {reason}" for reason, count in lost(status).items())


def seconds_to_answer(victim: Victim, target: Target) -> float:
    """How long the service takes to work again; what it is asked may wait behind the flood."""
    import bot_core
    import deixis
    types = {"OBJECTS": deixis.objects_t, "HAND_TRACKS": deixis.hand_tracks_t,
             "GESTURE_STATE": deixis.gesture_state_t, "SERVICE_STATUS": deixis.service_status_t,
             "STEREO": bot_core.images_t}
    questions = {"CAMERA": picture, "HAND_TRACKS": no_hands, "STEREO_PAIR": pair}
    victim.expect_answers(target.answer, types[target.answer].decode)
    began = time.monotonic()
    question = questions[target.ask](5)

    def is_answered() -> bool:
        victim.publish(target.ask, question)
        victim.spin()
        return 5 in victim.answered or bool(target.answer == "SERVICE_STATUS" and victim.answered)

    assert becomes_true(is_answered, 5.0), victim.log()
    return time.monotonic() - began


def picture(time_us: int) -> bytes:
    """A small grey one."""
    return bytes(grey_image(time_us, 64, 48).encode())


def pair(time_us: int) -> bytes:
    """Two grey pictures of the rig's size."""
    from bot_core import images_t
    message = images_t()
    message.utime, message.n_images = time_us, 2
    message.image_types = [images_t.LEFT, images_t.RIGHT]
    message.images = [grey_image(time_us, WIDTH, HEIGHT)] * 2
    return bytes(message.encode())


def grey_image(time_us: int, width: int, height: int) -> Any:
    from bot_core import image_t
    message = image_t()
    message.utime, message.width, message.height, message.row_stride = time_us, width, height, width
    message.pixelformat, message.data = image_t.PIXEL_FORMAT_GRAY, bytes(width * height)
    message.size = len(message.data)
    return message


def no_hands(time_us: int) -> bytes:
    """Hand tracks of nobody."""
    from deixis import hand_tracks_t
    message = hand_tracks_t()
    message.utime, message.camera = time_us, "CAMERA"
    return bytes(message.encode())


def assert_obeys_during_a_flood(victim: Victim, channel: str, kind: str) -> None:
    flood = victim.begin_flood(channel, kind, 10.0)
    try:
        count = len(victim.heard)
        assert victim.comes(lambda: len(victim.heard) > count), victim.log()
        victim.process.send_signal(signal.SIGTERM)
        assert victim.process.wait(timeout=10) == 0
    finally:
        flood.kill()
        flood.communicate()
