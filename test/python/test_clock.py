"""The wall clock is set back by an hour while everything runs: everything goes on."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from bench import Bench, becomes_true
from listener import Listener

_HOUR_US = 3_600_000_000


@pytest.fixture
def clock(build: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The file whose appearance sets back the clock of every program that the test starts."""
    file = tmp_path / "set-back"
    monkeypatch.setenv("LD_PRELOAD", str(build / "test/robustness/set_clock.so"))
    monkeypatch.setenv("DEIXIS_CLOCK_SET_BACK", str(file))
    yield file


def test_a_camera_goes_on_with_pictures_and_status(url: str, build: Path, repository: Path,
                                                   clock: Path) -> None:
    from bot_core import image_t
    from deixis import service_status_t
    listener = Listener(url, CAMERA=image_t, SERVICE_STATUS=service_status_t)
    clip = repository / "test/data/clips/spread_01/left.mp4"
    camera = subprocess.Popen([build / "bin/deixis-camera-driver", "-l", url, "--set",
                               "source.kind=video", "--set", f"source.path={clip}"])
    try:
        assert listener.hears("SERVICE_STATUS", 2) and listener.hears("CAMERA", 5)
        before = listener.heard["SERVICE_STATUS"][-1].utime
        clock.touch()
        assert listener.hears("SERVICE_STATUS", 3, 8.0)
        assert listener.heard["SERVICE_STATUS"][-1].utime < before - _HOUR_US / 2
        assert listener.hears("CAMERA", 5, 5.0)
        pictures = [picture.utime for picture in listener.heard["CAMERA"]]
        assert pictures == sorted(pictures), "a recording that is played keeps its pace"
    finally:
        camera.kill()
        camera.wait()


def test_the_supervisor_takes_no_service_for_dead(clock: Path, bench: Bench) -> None:
    bench.write({name: {"restart_when_silent_s": 2} for name in "ab"})
    assert bench.deixis("start").returncode == 0
    before = bench.status()
    clock.touch()
    states = set()

    def has_gone_on() -> bool:
        status = bench.status()
        states.update(service["state"] for service in status["services"])
        return bool(status["uptime_s"] > before["uptime_s"] + 6.0)

    assert becomes_true(has_gone_on, 30.0)
    assert states == {"running"}
    assert [s["pid"] for s in bench.status()["services"]] == [
        s["pid"] for s in before["services"]]
