"""`deixis echo`: what is printed, what is left out, and that it is told."""

from __future__ import annotations

import argparse
import base64
import importlib
import json
import math
import signal
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import lcm
import pytest
import yaml
from deixis import hand_t, hand_tracks_t
from deixis_lcm import decoding, images
from front_end import deixis, deixis_beside, speaking, status, write_log
from test_types import STRUCTS, Filler

from deixis_frontend import lcm_url
from deixis_frontend.listening import fields, source, text_forms
from deixis_frontend.listening.source import Arrival

NOWHERE = "memq://"  # a log is read without a bus


def tracks(*ids: int, sequence: int = 0) -> hand_tracks_t:
    message = hand_tracks_t()
    message.utime, message.sequence, message.camera = 1000 + sequence, sequence, "CAMERA"
    message.hands = [hand(number) for number in ids]
    message.n_hands = len(ids)
    return message


def hand(number: int) -> hand_t:
    message = hand_t()
    message.id, message.centre_px = number, [number + 0.5, math.nan]
    return message


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Hands at 0, 1 and 2 s, a picture, a message of no known type twice, and damaged ones."""
    damaged = tracks(1).encode()
    return write_log(tmp_path / "x.lcmlog", [
        (0, "HANDS", tracks(4, 7).encode()),
        (1_000_000, "HANDS", tracks(sequence=1).encode()),
        (2_000_000, "HANDS", tracks(9, sequence=2).encode()),
        (2_000_000, "CAMERA", images.from_jpeg(b"\xff\xd8" + bytes(range(100)), 4, 3, 5).encode()),
        (2_000_000, "FOREIGN", b"abcdefgh and more"), (2_100_000, "FOREIGN", b"abcdefgh and less"),
        (2_000_000, "BAD", damaged[:-1]), (2_000_000, "BAD", damaged + b"x"),
        (2_000_000, "BAD", damaged.replace(b"\0\0\0\7CAMERA", b"\x7f\xff\xff\xffCAMERA")),
        (2_000_000, "BAD", b"short"),
    ])


def test_yaml_holds_every_field(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "HANDS")
    assert result.returncode == 0, result.stderr
    first, second, _ = yaml.safe_load_all(result.stdout)
    assert first["camera"] == "CAMERA" and [h["id"] for h in first["hands"]] == [4, 7]
    assert first["hands"][0]["centre_px"][0] == 4.5
    assert math.isnan(first["hands"][0]["centre_px"][1])
    assert second["hands"] == [] and set(second) == set(hand_tracks_t.__slots__)
    assert "# HANDS deixis.hand_tracks_t" in result.stdout


def test_json_is_one_object_per_line_and_has_no_nan(log: Path) -> None:
    def refuse(word: str) -> None:
        raise AssertionError(word)

    lines = deixis(NOWHERE, "echo", "--log", log, "HANDS", "--json").stdout.splitlines()
    first, *_ = [json.loads(line, parse_constant=refuse) for line in lines]
    assert len(lines) == 3
    assert first["channel"] == "HANDS" and first["type"] == "deixis.hand_tracks_t"
    assert first["arrived_us"] == 0
    assert first["message"]["hands"][1]["centre_px"] == [7.5, "NaN"]


def test_infinity_is_a_text_in_json() -> None:
    assert json.loads(text_forms.as_json([math.inf, -math.inf])) == ["Infinity", "-Infinity"]


def test_fields_are_those_that_are_asked_for(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "HANDS", "--json", "--field", "hands[*].id",
                    "--field", "hands[1].centre_px", "--field", "utime")
    got = [json.loads(line)["fields"] for line in result.stdout.splitlines()]
    assert [fields["hands[*].id"] for fields in got] == [[4, 7], [], [9]]
    assert [fields["hands[1].centre_px"] for fields in got] == [[7.5, "NaN"], None, None]
    assert [fields["utime"] for fields in got] == [1000, 1001, 1002]


def test_a_field_that_no_message_has_is_told_once(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "HANDS", "--field", "hand")
    assert result.returncode == 1 and not result.stdout
    [line] = result.stderr.splitlines()
    assert "deixis.hand_tracks_t has no field hand: there are utime, sequence" in line


@pytest.mark.parametrize("text", ["", "hands[x]", "hands[-1]", "[0]", "a..b", "a.", ".a", "a b"])
def test_what_is_no_path_is_refused(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError):
        fields.field_path(text)


@pytest.mark.parametrize(("path", "fault"), [
    ("hands.id", "is a list"), ("utime[0]", "element"), ("camera[*]", "element"),
    ("utime.x", "no field x"), ("hands[0].nope", "no field nope")])
def test_paths_that_do_not_fit_the_type_say_why(path: str, fault: str) -> None:
    with pytest.raises(fields.NoSuchField, match=fault):
        fields.select(tracks(1), fields.field_path(path))


def test_bytes_are_told_by_their_size_unless_wanted_in_full(log: Path) -> None:
    short = yaml.safe_load(deixis(NOWHERE, "echo", "--log", log, "CAMERA").stdout)
    assert short["data"] == "<102 bytes: ffd8000102030405...>"
    assert fields.plain(b"30", is_full=False) == '<2 bytes: "30">'
    assert fields.plain(b"", is_full=False) == "<0 bytes>"
    jpeg = b"\xff\xd8" + bytes(range(100))
    full = deixis(NOWHERE, "echo", "--log", log, "CAMERA", "--full")
    assert yaml.safe_load(full.stdout)["data"] == jpeg
    as_json = deixis(NOWHERE, "echo", "--log", log, "CAMERA", "--full", "--json")
    assert base64.b64decode(json.loads(as_json.stdout)["message"]["data"]) == jpeg


def test_an_unknown_type_is_said_once_and_counted(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "FOREIGN", "CAMERA")
    assert result.returncode == 0
    assert result.stderr.count("fingerprint 6162636465666768, 17 bytes") == 1
    assert "printed 1 messages; not printed: 2 of unknown type on FOREIGN" in result.stderr


@pytest.mark.parametrize("command", ["echo", "hz", "delay", "topics"])
def test_the_self_test_of_lcm_is_left_out_in_silence(tmp_path: Path, command: str) -> None:
    log = write_log(tmp_path / "x.lcmlog", [(0, "LCM_SELF_TEST", b"lcm self test"),
                                            (0, "HANDS", tracks().encode()),
                                            (1, "LCM_SELF_TEST", b"lcm self test")])
    result = deixis(NOWHERE, command, "--log", log)
    assert result.returncode == 0 and "HANDS" in result.stdout
    assert "SELF_TEST" not in result.stdout and not result.stderr


def test_other_bytes_on_the_channel_of_the_self_test_are_told(tmp_path: Path) -> None:
    log = write_log(tmp_path / "x.lcmlog", [(0, "LCM_SELF_TEST", b"of somebody else")])
    assert "LCM_SELF_TEST: type not known" in deixis(NOWHERE, "echo", "--log", log).stderr


def test_programs_that_start_are_not_heard(url: str) -> None:
    with deixis_beside(url, "echo", "--json", "--count", 1) as echo:
        with speaking(url, lambda n: ("LATER", tracks(n).encode()) if n > 50 else
                      ("LCM_SELF_TEST", b"lcm self test")):
            lcm.LCM(url)
            out, said = echo.communicate(timeout=30)
    assert json.loads(out)["channel"] == "LATER" and not said


def test_damaged_messages_are_counted_by_reason(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "BAD")
    assert result.returncode == 1 and not result.stdout
    assert "3 damaged on BAD (truncated), 1 damaged on BAD (trailing_bytes)" in result.stderr


def test_count_and_seconds_end_it(log: Path) -> None:
    counted = deixis(NOWHERE, "echo", "--log", log, "HANDS", "--count", 2, "--field", "sequence")
    timed = deixis(NOWHERE, "echo", "--log", log, "HANDS", "--seconds", 1, "--field", "sequence")
    for result in (counted, timed):
        assert [m["sequence"] for m in yaml.safe_load_all(result.stdout)] == [0, 1]


def test_names_cannot_move_the_cursor(tmp_path: Path) -> None:
    message = tracks()
    message.camera = "\x1b[2J\x9b2J"
    log = write_log(tmp_path / "x.lcmlog", [(0, "A\x1b[2J", message.encode()),
                                            (0, "B\x1b[2J", b"abcdefgh")])
    for form in ((), ("--json",)):
        result = deixis(NOWHERE, "echo", "--log", log, *form)
        assert "A\\x1b[2J" in result.stdout.replace("\\\\", "\\")
        assert "B\\x1b[2J: type not known" in result.stderr
        assert not any(c in result.stdout + result.stderr for c in "\x1b\x9b")


@pytest.mark.parametrize(("command", "channels", "code"), [
    (("export", "--force", "--mcap"), "nope", 1), (("export", "--force", "--mcap"), "G.*", 1),
    (("export", "--force", "--mcap"), ".*", 0), (("replay",), "nope", 1)])
def test_names_of_a_log_cannot_move_the_cursor_either(
        url: str, tmp_path: Path, command: tuple[str, ...], channels: str, code: int) -> None:
    log = write_log(tmp_path / "x.lcmlog", [
        (0, "G\x1b[2J", b"abcdefgh"), (0, "A", status("one").encode()),
        (0, "D\x1b[2J", status("one").encode()[:-1])])
    name, *output = command
    more = [*output, str(tmp_path / "out.mcap")] if output else []
    result = deixis(url, name, log, *more, "--channels", channels)
    assert result.returncode == code, result.stderr
    assert "\\x1b[2J" in result.stdout + result.stderr
    assert "\x1b" not in result.stdout + result.stderr


def test_noise_on_many_channels_is_told_in_few_words(tmp_path: Path) -> None:
    noise = [(0, f"N{number}", b"%8d" % number) for number in range(1500)]
    log = write_log(tmp_path / "x.lcmlog", noise)
    result = deixis(NOWHERE, "echo", "--log", log)
    *said, total = result.stderr.splitlines()
    assert result.returncode == 1 and len(said) == 20
    assert "1 of unknown type on N0" in total and total.endswith("and 981 kinds more")


def test_damage_of_the_log_is_told(log: Path) -> None:
    log.write_bytes(log.read_bytes()[:-1])
    assert "it ends in the middle of a message" in deixis(NOWHERE, "echo", "--log", log).stderr


def test_a_channel_that_is_not_there_is_told(log: Path) -> None:
    result = deixis(NOWHERE, "echo", "--log", log, "HAND")  # The whole name must fit.
    assert result.returncode == 1
    assert "no message on HAND" in result.stderr and "deixis topics --log" in result.stderr


@pytest.mark.parametrize("command", [("echo", "--count", 1), ("hz",), ("delay",)])
def test_a_silent_bus_is_told_once_while_it_waits(url: str, command: tuple[object, ...]) -> None:
    with deixis_beside(url, *command, "HANDS", "OBJECTS", "--seconds", 4.5) as waiting:
        assert waiting.stderr
        assert waiting.stderr.readline() == (f"deixis: no message on HANDS, OBJECTS from {url} yet:"
                                             " `deixis topics` lists what is spoken there\n")
        assert waiting.poll() is None
        _, said = waiting.communicate(timeout=30)
    assert said.count("no message") == 1 and "yet" not in said  # The last word of all.


def test_a_bus_that_speaks_late_is_told_and_heard(
        monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class Late:
        """A bus that is silent, speaks, and is silent again."""

        name, url = "bus", lcm_url.parse("udpm://")

        def __iter__(self) -> Iterator[Arrival | None]:
            yield from (None, None, Arrival(0, "A", b""), None, None)

    monkeypatch.setattr(source, "_SILENT_S", 0.0)
    assert sum(arrival is not None for arrival in source.telling_silence(Late(), [])) == 1
    assert capsys.readouterr().err.count("no message from bus yet") == 1


def test_live_messages_are_printed_as_they_come(url: str) -> None:
    with speaking(url, lambda n: ("HANDS", tracks(n, sequence=n).encode()),
                  lambda n: ("HANDS_TOO", b"not asked for")):
        result = deixis(url, "echo", "HANDS|NOPE", "--count", 3, "--json", "--field", "sequence")
    numbers = [json.loads(line)["fields"]["sequence"] for line in result.stdout.splitlines()]
    assert result.returncode == 0, result.stderr
    assert numbers == list(range(numbers[0], numbers[0] + 3))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_the_summary(url: str, number: signal.Signals) -> None:
    with speaking(url, lambda n: ("HANDS", tracks(n).encode()), lambda n: ("X", b"12345678")):
        with deixis_beside(url, "echo", "--json", "--field", "utime") as echo:
            assert echo.stdout and all(echo.stdout.readline() for _ in range(3))
            echo.send_signal(number)
            _, said = echo.communicate(timeout=10)
    assert echo.returncode == 0, said
    assert "Traceback" not in said and "of unknown type on X" in said


@pytest.mark.parametrize("heard_bytes", [0, 100])  # It ends before the subscription, or after.
def test_a_lost_connection_is_told(heard_bytes: int) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(30)

        def serve() -> None:
            for _ in range(2):  # A look whether it is there, then LCM itself.
                connection, _ = server.accept()
                with connection:
                    if connection.recv(8):
                        connection.sendall(bytes.fromhex("287617fa00000100"))
                        connection.recv(heard_bytes)

        thread = threading.Thread(target=serve)
        thread.start()
        url = f"tcpq://127.0.0.1:{server.getsockname()[1]}"
        result = deixis(url, "echo", "--seconds", 20)
        thread.join()
    assert result.returncode == 1
    assert f"the connection to '{url}' is lost" in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize("name", STRUCTS)
def test_every_type_can_be_printed(name: str) -> None:
    package, struct = name.split(".")
    filler = Filler(lambda full: getattr(importlib.import_module(full.split(".")[0]),
                                         full.split(".")[1]))
    message = decoding.decode_as(getattr(importlib.import_module(package), struct),
                                 filler.message(name).encode())
    plain = fields.plain(message, is_full=True)
    assert list(plain) == message.__slots__
    assert yaml.safe_load(text_forms.as_yaml(plain)) == plain
    assert list(json.loads(text_forms.as_json(plain))) == message.__slots__


def test_a_channel_that_lacks_the_field_ends_it(url: str) -> None:
    with speaking(url, lambda number: ("HANDS", tracks(number).encode())):
        result = deixis(url, "echo", "HANDS", "--field", "hands[*].nosuch", "--count", 1, seconds=20)
    assert result.returncode == 1
    assert "has no field nosuch" in result.stderr
