"""Anyone may send anything to the bus: what the front end makes of it."""

from __future__ import annotations

import importlib
import json
import random
import struct
import subprocess
from pathlib import Path
from typing import Any

import pytest
from bench import becomes_true
from test_types import STRUCTS, Filler

from deixis_frontend.cli import main
from deixis_frontend.demo.clip import Clip
from deixis_frontend.demo.commentary import Commentary
from deixis_frontend.printable import printable
from deixis_frontend.process_facts import command_name
from deixis_frontend.received import ChannelDecoder, finite
from deixis_frontend.service_facts import as_facts
from deixis_lcm import logs

LIES = [struct.pack(">I", lie) for lie in
        (1, 0x20000001, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)]


def type_of(full_name: str) -> Any:
    """The generated class."""
    package, name = full_name.split(".")
    return getattr(importlib.import_module(package), name)


def good(full_name: str) -> bytes:
    """A whole message."""
    return Filler(type_of).message(full_name).encode()


@pytest.fixture(scope="module")
def status(build: Path) -> Any:  # pylint: disable=unused-argument
    """The type of SERVICE_STATUS."""
    return type_of("deixis.service_status_t")


@pytest.mark.parametrize("name", sorted(STRUCTS))
def test_lies_in_place_of_any_four_bytes_are_refused_or_understood(name: str, build: Path) -> None:
    # pylint: disable=unused-argument
    decode = ChannelDecoder(type_of(name), "ANY")
    whole = good(name)
    assert decode(whole) is not None
    for at in range(8, len(whole) - 3):
        for lie in LIES:
            lying = whole[:at] + lie + whole[at + 4:]
            message = decode(lying)
            assert message is None or message.encode() == lying


@pytest.mark.parametrize("name", ["deixis.service_status_t", "deixis.gesture_t"])
def test_every_truncation_is_refused(name: str, build: Path) -> None:
    # pylint: disable=unused-argument
    decode = ChannelDecoder(type_of(name), "ANY")
    whole = good(name)
    assert all(decode(whole[:size]) is None for size in range(len(whole)))


def test_noise_is_refused_or_understood(status: Any) -> None:
    numbers = random.Random(3)
    decode = ChannelDecoder(status, "SERVICE_STATUS")
    for _ in range(2000):
        decode(status._get_packed_fingerprint() + numbers.randbytes(numbers.randrange(300)))
    assert decode.refused > 1900


def test_what_is_refused_is_said_once(status: Any, capfd: pytest.CaptureFixture[str]) -> None:
    decode = ChannelDecoder(status, "SERVICE_STATUS")
    assert decode(b"") is None
    assert decode(good("deixis.gesture_t")) is None
    assert decode.refused == 2
    assert capfd.readouterr().err.count("does not decode") == 1


def test_logs_name_a_message_that_lies(status: Any) -> None:
    types = {status._get_packed_fingerprint(): status}
    with pytest.raises(ValueError, match="does not decode"):
        logs.decode(good("deixis.service_status_t")[:-1], types)


def test_status_that_is_no_number_is_still_json(status: Any) -> None:
    message = Filler(type_of).message("deixis.service_status_t")
    message.processing_ms_p50 = float("nan")
    message.age_ms_p99 = float("inf")
    message.channels[0].rate_hz = float("nan")
    message.text = "\x1b[2Jgone"
    facts = as_facts(status.decode(message.encode()))
    json.dumps(facts, allow_nan=False)
    assert facts["text"] == "\\x1b[2Jgone"


def test_the_demo_goes_on_after_bytes_that_are_no_gesture(
        build: Path, capfd: pytest.CaptureFixture[str]) -> None:
    # pylint: disable=unused-argument
    commentary = Commentary(Clip(Path("clip"), None, None, ()), type_of("deixis.gesture_t"))
    for data in (b"", b"short", good("deixis.hand_tracks_t"), good("deixis.gesture_t")[:-2]):
        commentary.hear_gesture(data)
        commentary.see_picture(data[:10])
    assert commentary.count == 0
    commentary.hear_gesture(good("deixis.gesture_t"))
    assert commentary.count == 1
    assert "Traceback" not in capfd.readouterr().err


def test_errors_with_what_came_from_elsewhere_are_shown_as_escapes(
        capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["replay", "a\x1b[2Jb"]) == 1
    assert "a\\x1b[2Jb" in capsys.readouterr().err


def test_names_of_processes_are_printable() -> None:
    with subprocess.Popen(["a\x1b[2Jb", "9"], executable="/bin/sleep") as process:
        try:
            becomes_true(lambda: not command_name(process.pid).startswith("a process"), 5.0)
            assert command_name(process.pid) == f"a\\x1b[2Jb pid {process.pid}"
        finally:
            process.kill()


def test_text_that_steers_a_terminal_is_shown_as_escapes() -> None:
    assert printable("caf\xe9 \x1b]0;") == r"caf\xe9 \x1b]0;"
    assert finite(float("-inf")) == 0.0
    assert finite(1.5) == 1.5
