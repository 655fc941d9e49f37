"""The programs together: from the clip to the gestures, offline and live."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from deixis_frontend import layout, lcm_url
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.offline_chain import results_of_video
from deixis_lcm import decoding, logs

CLIP_FPS = 15.0
# A recognition counts from the gesture's start to half a second after its hold.
GRACE_S = 0.5


@pytest.fixture(scope="module")
def clip(repository: Path) -> Path:
    return repository / "test" / "data" / "clips" / "spread_01"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("chain")


def camera_log(build: Path, clip: Path, log: Path) -> Path:
    """The clip as a log of pictures."""
    subprocess.run([build / "bin/deixis-camera-driver", "--set", "source.kind=video",
                    "--set", f"source.path={clip / 'left.mp4'}",
                    "--set", f"calibration.file={clip / 'intrinsics.yml'}",
                    "--set", "pace=as_fast_as_possible", "--lcm-url", f"file://{log}?mode=w"],
                   check=True, timeout=60)
    return log


def offline(build: Path, clip: Path, pictures: Path, results: Path, *options: str) -> Path:
    """The results of the whole chain on a log of pictures."""
    subprocess.run([build / "bin/deixis-offline", pictures, results, "--results-only",
                    "--set", f"object_detector.places.file={clip / 'places.yaml'}", *options],
                   check=True, timeout=120)
    return results


@pytest.fixture(scope="module")
def pictures(build: Path, clip: Path, folder: Path) -> Path:
    return camera_log(build, clip, folder / "pictures.lcmlog")


@pytest.fixture(scope="module")
def results(build: Path, clip: Path, folder: Path, pictures: Path) -> Path:
    return offline(build, clip, pictures, folder / "results.lcmlog")


def labelled(clip: Path) -> list[tuple[float, float, int]]:
    """Start, latest recognition (seconds) and object of every gesture of the clip."""
    with (clip / "gestures.csv").open(newline="") as file:
        return [(int(row["start_frame"]) / CLIP_FPS, int(row["end_frame"]) / CLIP_FPS + GRACE_S,
                 int(row["object_id"])) for row in csv.DictReader(file)]


def test_the_camera_driver_logs_every_picture_with_the_time_of_the_file(pictures: Path) -> None:
    times = [message.utime for _, channel, message in logs.read(pictures) if channel == "CAMERA"]
    assert len(times) == 373
    assert all(abs((b - a) * 1e-6 - 1 / CLIP_FPS) < 0.002 for a, b in zip(times, times[1:]))


def test_the_calibration_comes_before_the_first_picture_and_then_once_per_second(
        pictures: Path) -> None:
    channels = [channel for _, channel, _ in logs.read(pictures)]
    assert channels[0] == "CAMERA_CALIBRATION"
    seconds = 373 / CLIP_FPS
    assert seconds - 2 <= channels.count("CAMERA_CALIBRATION") <= seconds + 2


def test_every_picture_has_objects_hands_and_a_gesture_state(results: Path) -> None:
    channels = [channel for _, channel, _ in logs.read(results)]
    for channel in ("OBJECTS", "HAND_TRACKS", "GESTURE_STATE"):
        assert channels.count(channel) == 373, channel


def test_results_carry_the_capture_times_of_the_pictures(pictures: Path, results: Path) -> None:
    taken = [message.utime for _, channel, message in logs.read(pictures) if channel == "CAMERA"]
    states = [message.utime for _, channel, message in logs.read(results)
              if channel == "GESTURE_STATE"]
    assert states == taken


def test_most_gestures_of_the_clip_are_named_right_and_few_are_made_up(
        clip: Path, results: Path) -> None:
    # An event may be told again when its end is known: the last word counts.
    events = {message.event_id: message for _, channel, message in logs.read(results)
              if channel == "GESTURES"}.values()
    gestures = labelled(clip)
    right = {index for event in events if event.outcome == event.OBJECT
             for index, (start, end, object_id) in enumerate(gestures)
             if start <= event.utime * 1e-6 <= end and event.object_id == object_id}
    assert len(right) >= 4, [(event.utime * 1e-6, event.object_label) for event in events]
    assert len(events) - len(right) <= 2


def test_the_same_clip_gives_the_same_bytes_with_any_number_of_threads(
        build: Path, clip: Path, folder: Path, pictures: Path, results: Path) -> None:
    again = camera_log(build, clip, folder / "again.lcmlog")
    assert again.read_bytes() == pictures.read_bytes()
    for threads in ("1", "2", "5"):
        other = offline(build, clip, pictures, folder / f"threads{threads}.lcmlog",
                        "--threads", threads)
        assert other.read_bytes() == results.read_bytes(), f"{threads} threads"


def test_a_video_becomes_the_results_of_the_services_that_are_named(
        build: Path, clip: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DEIXIS_BUILD_DIR", str(build))
    results = results_of_video(layout.find(), clip / "left.mp4", ("object_detector",), {"OBJECTS"})
    assert [channel for channel, _ in results] == ["OBJECTS"] * 373
    with pytest.raises(UserError, match="deixis-offline failed: .*no_such_key"):
        results_of_video(layout.find(), clip / "left.mp4", ("object_detector",), {"OBJECTS"},
                         ["object_detector.no_such_key=1"])


@contextmanager
def running(build: Path, url: str, name: str, *settings: str) -> Iterator[subprocess.Popen[str]]:
    """A service program beside the test."""
    command = [str(build / "bin" / f"deixis-{name}"), "--lcm-url", url]
    for setting in settings:
        command += ["--set", setting]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def collect(url: str, seconds: float, enough) -> dict[str, list]:
    """Decoded messages by channel, until there are enough of them or the time is over."""
    import lcm

    heard: dict[str, list] = {}
    types = decoding.types_by_fingerprint()
    bus = lcm.LCM(str(lcm_url.parse(url).with_receive_buffer()))
    bus.subscribe(".*", lambda channel, data: heard.setdefault(channel, []).append(
        decoding.decode(data, types)))
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline and not enough(heard):
        bus.handle_timeout(100)
        while bus.handle_timeout(0) > 0:  # A full queue would drop the newest, a status maybe.
            continue
    return heard


def status_of(heard: dict[str, list], service: str):
    return next((m for m in reversed(heard.get("SERVICE_STATUS", [])) if m.service == service), None)


def test_the_live_chain_works_says_how_it_is_and_stops_within_a_second(
        build: Path, clip: Path, url: str) -> None:
    with ExitStack() as stack:
        services = {name: stack.enter_context(running(build, url, name)) for name in
                    ("object-detector", "hand-tracker", "gesture-recogniser")}
        services["camera-driver"] = stack.enter_context(
            running(build, url, "camera-driver", "source.kind=video", "source.loop=true",
                    f"source.path={clip / 'left.mp4'}"))
        heard = collect(url, 20.0, lambda h: len(h.get("GESTURE_STATE", [])) >= 30 and
                        status_of(h, "gesture_recogniser") is not None)
        assert len(heard.get("GESTURE_STATE", [])) >= 30
        status = status_of(heard, "hand_tracker")
        assert status.receive_buffer_bytes > 100_000
        assert any(channel.name == "CAMERA" and channel.messages > 0 for channel in status.channels)
        start = time.monotonic()
        for process in services.values():
            process.send_signal(signal.SIGTERM)
        assert [process.wait(5.0) for process in services.values()] == [0, 0, 0, 0]
        assert time.monotonic() - start < 1.5


def test_a_service_goes_on_after_messages_of_another_type_and_garbage(
        build: Path, url: str) -> None:
    import lcm

    with running(build, url, "hand-tracker") as process:
        bus = lcm.LCM(url)

        def feed(heard: dict[str, list]) -> bool:
            bus.publish("CAMERA", os.urandom(200))
            bus.publish("OBJECTS", b"")
            status = status_of(heard, "hand_tracker")
            return status is not None and sum(
                drop.count for channel in status.channels for drop in channel.drops) >= 2

        heard = collect(url, 10.0, feed)
        assert feed(heard), "drops are not counted"
        assert process.poll() is None


def test_a_service_names_a_wrong_key_and_ends_with_one(build: Path) -> None:
    done = subprocess.run([build / "bin/deixis-hand-tracker", "--set", "no_such_key=1",
                           "--lcm-url", "memq://"], capture_output=True, text=True, timeout=10)
    assert done.returncode == 1
    assert "no_such_key" in done.stderr
