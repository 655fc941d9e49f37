"""`deixis hz`, `delay` and `topics`: figures of known messages, and what does not fit."""

from __future__ import annotations

import json
import signal
import statistics
import struct
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from deixis import hand_tracks_t, objects_t
from front_end import deixis, deixis_beside, speaking, status, write_log

from deixis_frontend import layout, lcm_url
from deixis_frontend.listening.ages import KEPT, ChannelAge
from deixis_frontend.listening.decoder import Decoder
from deixis_frontend.listening.meter import Meter
from deixis_frontend.listening.rates import (
    HEADER, LARGEST_GAP, MOST_PUBLISHERS, ChannelRate, Intervals, Loss)
from deixis_frontend.listening.source import Arrival
from deixis_frontend.listening.traffic import Traffic
from deixis_frontend.listening.udp_senders import MOST_SENDERS, Senders, channel_of

NOWHERE = "memq://"  # a log is read without a bus


def hands(sequence: int, utime: int = 0) -> bytes:
    message = hand_tracks_t()
    message.utime, message.sequence = utime, sequence
    return message.encode()


def row_of(output: str, channel: str) -> dict[str, str]:
    """The last line of a table on a channel, by the names in its first line."""
    lines = output.splitlines()
    header = next(line for line in lines if line.startswith("channel ")).split("  ")
    row = next(line for line in reversed(lines) if line.startswith(channel + " "))
    return dict(zip([word.strip() for word in header if word.strip()],
                    [word.strip() for word in row.split("  ") if word.strip()], strict=True))


def test_intervals_are_those_of_the_textbook() -> None:
    values = [10, 40, 25, 25, 70]
    intervals = Intervals()
    for value in values:
        intervals.add(value)
    assert intervals.mean_us == pytest.approx(statistics.mean(values))
    assert intervals.deviation_us == pytest.approx(statistics.pstdev(values))
    assert (intervals.shortest_us, intervals.longest_us) == (10, 70)


@pytest.mark.parametrize(("numbers", "lost", "steps_back"), [
    ([0, 1, 2], 0, 0), ([5, 6, 9], 2, 0), ([7, 8, 0, 1], 0, 1), ([3, 3], 0, 1),
    ([100, 0, 101, 1, 102, 2], 200, 3), ([0, LARGEST_GAP + 2], 0, 0),
    ([0, LARGEST_GAP + 1], LARGEST_GAP, 0), ([None, None], 0, 0)])
def test_loss_is_told_by_the_numbers(numbers: list[int | None], lost: int,
                                     steps_back: int) -> None:
    loss = Loss()
    for number in numbers:
        loss.add(number, "")
    assert (loss.lost, loss.steps_back) == (lost, steps_back)
    assert loss.is_known == (numbers[0] is not None)


def test_each_publisher_counts_its_own() -> None:
    loss = Loss()
    for number in range(3):
        loss.add(number, "one")
        loss.add(100 + 2 * number, "other")
    assert (loss.lost, loss.steps_back) == (2, 0)


def test_the_window_forgets_and_shows_silence() -> None:
    rate = ChannelRate("A", window_s=1.0)
    for time_us in range(0, 2_000_001, 100_000):
        rate.add(time_us, 1000)
    channel, hertz, mean, *_ = rate.recent_row(2_000_000)
    assert (channel, hertz, mean) == ("A", "10.00", "100.00")
    assert rate.recent_row(2_500_000)[1] == "5.00"  # Half of the second before was silent.
    assert rate.recent_row(9_000_000)[1] == "0.00"


def test_no_more_than_the_window_is_kept() -> None:
    rate = ChannelRate("A", window_s=1.0)
    for number in range(1000):
        rate.add(number * 100_000, 1)
    assert len(rate._recent) == 11


def test_ages_are_of_all_messages_however_many() -> None:
    ages = ChannelAge("A", 5.0)
    for age_us in (900_000, *(10_000,) * KEPT, 20_000, 1_000):
        ages.add(10**12, 10**12 - age_us)
    _, least, mean, p99, most, messages = ages.whole_row()
    assert (least, most, p99, messages) == ("1.00", "900.00", "10.00", "100003")
    assert mean == "10.01"
    assert ages.recent_row(10**12)[4] == "20.00"


def test_noise_does_not_fill_the_memory() -> None:
    loss, senders = Loss(), Senders()
    for number in range(10_000):
        loss.add(number, f"noise {number}")
        loss.add(number // 100 * 3 if number % 100 == 0 else None, "service")
        senders.add("A", ("h", number), 0.0)
    assert len(loss._last) == MOST_PUBLISHERS and loss.lost == 99 * 2
    assert len(senders.by_channel["A"]) == len(senders.at_once("A")) == MOST_SENDERS


def test_after_a_pause_there_is_one_table(monkeypatch: pytest.MonkeyPatch,
                                          capsys: pytest.CaptureFixture[str]) -> None:
    class Paused:
        """A message, then nothing, while a hundred seconds have passed."""

        url, name = lcm_url.parse(NOWHERE), NOWHERE

        def __iter__(self) -> Iterator[Arrival | None]:
            yield Arrival(1, "A", hands(0))
            later = time.monotonic() + 100.0
            monkeypatch.setattr(time, "monotonic", lambda: later)
            yield from [None] * 50

    def measure(channels: dict[str, ChannelRate], arrival: Arrival, _: object) -> None:
        channels[arrival.channel] = ChannelRate(arrival.channel, 5.0)

    Meter(Decoder(layout.find()), HEADER, measure).listen(Paused(), [])
    assert capsys.readouterr().out.count("channel ") == 1


def test_rates_of_a_log(tmp_path: Path) -> None:
    times = [0, 100_000, 200_000, 300_000, 500_000]
    events = [(t, "HANDS", hands(n)) for t, n in zip(times, (0, 1, 2, 3, 6))]
    log = write_log(tmp_path / "x.lcmlog", [*events, (600_000, "FOREIGN", b"abcdefgh"),
                                            (700_000, "FOREIGN", b"abcdefgh")])
    result = deixis(NOWHERE, "hz", "--log", log)
    assert result.returncode == 0, result.stderr
    row = row_of(result.stdout, "HANDS")
    assert (row["Hz"], row["mean ms"], row["min ms"], row["max ms"]) == (
        "8.00", "125.00", "100.00", "200.00")
    assert (row["jitter ms"], row["lost"], row["longest gap ms"]) == ("43.30", "2", "200.00")
    assert (row["kB/s"], row["messages"]) == (f"{4 * len(hands(0)) / 500:.1f}", "5")
    assert row_of(result.stdout, "FOREIGN")["lost"] == "-"
    assert "2 of unknown type on FOREIGN" in result.stdout


def test_a_clock_that_was_set_back_makes_no_interval(tmp_path: Path) -> None:
    log = write_log(tmp_path / "x.lcmlog", [(9_000_000, "HANDS", hands(0)),
                                            (1_000_000, "HANDS", hands(1)),
                                            (1_500_000, "HANDS", hands(2))])
    result = deixis(NOWHERE, "hz", "--log", log)
    assert row_of(result.stdout, "HANDS")["mean ms"] == "500.00"
    assert "HANDS: the clock went back 1 times" in result.stdout


def test_ages_of_a_log(tmp_path: Path) -> None:
    log = write_log(tmp_path / "x.lcmlog", [
        (1_000_000 + 1000 * n, "HANDS", hands(n, 1_000_000)) for n in range(101)])
    result = deixis(NOWHERE, "delay", "--log", log)
    assert result.returncode == 0, result.stderr
    assert row_of(result.stdout, "HANDS") == {
        "channel": "HANDS", "min ms": "0.00", "mean ms": "50.00", "p99 ms": "99.00",
        "max ms": "100.00", "messages": "101"}
    assert "of this clock" not in result.stdout


@pytest.mark.parametrize(("ages_s", "said"), [
    ([-0.1, -5], "no stamp is of this clock"), ([100, 10.1], "no stamp is of this clock"),
    ([0.1, 11], "1 of 2 stamps are not of this clock"), ([0, 10], "")])
def test_stamps_of_another_clock_are_told(ages_s: list[float], said: str) -> None:
    ages = ChannelAge("A", 5.0)
    for age_s in ages_s:
        ages.add(10**12, 10**12 - round(age_s * 1e6))
    assert said in "".join(ages.notes()) and bool(said) == bool(ages.notes())


def test_messages_without_a_time_have_no_age(tmp_path: Path) -> None:
    log = write_log(tmp_path / "x.lcmlog", [(5, "FOREIGN", b"abcdefgh")])
    assert deixis(NOWHERE, "delay", "--log", log).returncode == 1


@pytest.mark.parametrize("command", ["hz", "delay"])
def test_tables_come_live_and_one_at_the_end(url: str, command: str) -> None:
    with speaking(url, lambda n: ("HANDS", hands(n, time.time_ns() // 1000))):
        with deixis_beside(url, command, "HANDS", "--window", "2") as process:
            assert process.stdout
            live = [process.stdout.readline() for _ in range(2)]
            process.send_signal(signal.SIGINT)
            rest, said = process.communicate(timeout=10)
    assert process.returncode == 0, said
    assert live[0].startswith("channel ") and live[1].startswith("HANDS ")
    assert f"all of {url}:" in rest and row_of(rest, "HANDS")
    assert "of this clock" not in rest


@pytest.mark.parametrize("command", ["hz", "delay", "topics"])
def test_silence_is_no_success(url: str, command: str) -> None:
    result = deixis(url, command, "--seconds", 0.2)
    assert result.returncode == 1
    [line] = result.stderr.splitlines()
    assert f"no message from {url}" in line


def test_help_of_delay_explains_the_ages_of_gestures() -> None:
    said = " ".join(deixis(NOWHERE, "delay", "--help").stdout.split())
    assert "GESTURES is sent twice" in said and "with the utime of the decision" in said


def topics(log: Path) -> dict[str, dict[str, object]]:
    result = deixis(NOWHERE, "topics", "--log", log, "--json")
    assert result.returncode == 0, result.stderr
    return {channel["channel"]: channel for channel in json.loads(result.stdout)["channels"]}


def test_topics_of_a_log(tmp_path: Path) -> None:
    speaker = status("tracker", ("CAMERA",), ("HANDS",), wrong=3)
    log = write_log(tmp_path / "x.lcmlog", [
        (0, "HANDS", hands(0)), (500_000, "HANDS", hands(1)), (1_000_000, "HANDS", hands(2)),
        (1_000_000, "SERVICE_STATUS", speaker.encode()),
        (1_000_000, "MIXED", hands(0)), (1_000_000, "MIXED", objects_t().encode()),
        (1_000_000, "MIXED", b"abcdefgh"), (1_000_000, "MIXED", hands(0)[:-1])])
    found = topics(log)
    assert list(found) == ["CAMERA", "HANDS", "MIXED", "SERVICE_STATUS"]
    assert found["HANDS"]["types"] == ["deixis.hand_tracks_t"]
    assert (found["HANDS"]["rate_hz"], found["HANDS"]["messages"]) == (3.0, 3)
    assert (found["HANDS"]["publishers"], found["HANDS"]["lost"]) == (["tracker"], 0)
    assert found["CAMERA"]["subscribers"] == ["tracker"] and found["CAMERA"]["messages"] == 0
    assert found["CAMERA"]["wrong_type_refused_by"] == {"tracker": 3}
    assert found["MIXED"]["types"] == ["deixis.hand_tracks_t", "deixis.objects_t"]
    assert found["MIXED"]["unknown_fingerprints"] == ["6162636465666768"]
    assert found["MIXED"]["damaged"] == 1
    said = deixis(NOWHERE, "topics", "--log", log).stdout
    assert "CAMERA: tracker refused 3 messages of the wrong type" in said
    assert "MIXED: messages of several types" in said


def test_two_publishers_in_a_log_are_told_from_one_that_began_anew(tmp_path: Path) -> None:
    anew = [(n, "ANEW", hands(number)) for n, number in enumerate((7, 8, 0, 1))]
    two = [(n, "TWO", hands(number)) for n, number in enumerate((70, 0, 71, 1, 72, 2))]
    both = [(9, "SERVICE_STATUS", status(name, (), ("SHARED",)).encode()) for name in "ab"]
    found = topics(write_log(tmp_path / "x.lcmlog", [*anew, *two, *both]))
    assert found["ANEW"]["several_publishers"] == ""
    assert found["TWO"]["several_publishers"] == "several publishers: sequence numbers alternate"
    assert found["TWO"]["lost"] is None
    assert found["SHARED"]["several_publishers"] == "2 services publish: a, b"
    assert found["SERVICE_STATUS"]["several_publishers"] == ""


def test_a_service_that_stopped_publishes_no_more() -> None:
    traffic = Traffic(layout.find())
    for state in (1, 3):
        message = status("tracker", (), ("HANDS",), state=state)
        traffic.take(Arrival(1, "SERVICE_STATUS", message.encode()))
    assert [channel.name for channel in traffic.channels()] == ["SERVICE_STATUS"]


def test_two_processes_of_one_service_are_told_apart() -> None:
    traffic = Traffic(layout.find())
    for pid in (1, 2):
        message = status("tracker", (), ("HANDS",), pid=pid)
        traffic.take(Arrival(1, "SERVICE_STATUS", message.encode()))
    assert traffic.channels()[0].publishers == [
        "tracker (pid 1 on host)", "tracker (pid 2 on host)"]


def test_two_senders_on_one_channel_are_named(url: str) -> None:
    big = b"abcdefgh" + bytes(200_000)  # in fragments
    with speaking(url, lambda n: ("TWO", hands(n)), lambda n: ("TWO", hands(n)),
                  lambda n: ("ONE", big)):
        result = deixis(url, "topics", "--seconds", 1, "--json")
    found = {channel["channel"]: channel for channel in json.loads(result.stdout)["channels"]}
    assert "2 publishers at once: " in found["TWO"]["several_publishers"]
    assert found["TWO"]["several_publishers"].count("python") == 2
    assert found["ONE"]["several_publishers"] == "" and len(found["ONE"]["publishers"]) == 1
    seconds = json.loads(result.stdout)["seconds"]
    assert seconds >= 1.0
    assert found["ONE"]["rate_hz"] == found["ONE"]["messages"] / seconds


def test_channels_are_read_from_datagrams() -> None:
    first = b"LC03" + struct.pack(">IIIHH", 1, 9, 0, 0, 2) + b"BIG\0data"
    later = b"LC03" + struct.pack(">IIIHH", 1, 9, 5, 1, 2) + b"BIG\0data"
    assert channel_of(b"LC02\0\0\0\1SMALL\0data") == "SMALL"
    assert channel_of(first) == "BIG"
    for datagram in (later, b"", b"LC02", b"LC03", b"LC03abcdefghijk", b"LC02\0\0\0\1\0", b"hello",
                     b"LC02\0\0\0\1" + b"X" * 64 + b"\0"):
        assert channel_of(datagram) is None


def test_a_sender_after_another_is_no_second_one() -> None:
    senders = Senders()
    for address, now_s in ((("h", 1), 0.0), (("h", 1), 1.0), (("h", 2), 2.0), (("h", 2), 3.0)):
        senders.add("A", address, now_s)
    assert senders.at_once("A") == [] and senders.at_once("B") == []
    senders.add("A", ("h", 3), 2.5)
    assert senders.at_once("A") == [("h", 2), ("h", 3)]
