"""Disks that are full or cannot be written: said with a cure, and the rest goes on."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import lcm
import pytest
from bench import Bench, becomes_true
from front_end import deixis, run, speaking

_MOUNT = 'mount -t tmpfs -o "$2" tmpfs "$1" || exit 97; shift 2; exec "$@"'
_MOUNT_AND_LIST = _MOUNT.replace('exec "$@"', '"$@"; code=$?; ls "$folder"; exit $code').replace(
    'mount', 'folder=$1; mount', 1)
Disk = Callable[..., list[str]]


@pytest.fixture
def disk(tmp_path: Path) -> Disk:
    """Beginnings of command lines that see a disk of their own, of 200 kB, on a folder."""
    own = ["unshare", "--mount"] if os.getuid() == 0 else ["unshare", "--map-root-user", "--mount"]
    if subprocess.run([*own, "true"], check=False, capture_output=True).returncode:
        pytest.skip("this machine allows no mounts of one's own")

    def prefix(folder: Path, options: str = "size=200k", script: str = _MOUNT) -> list[str]:
        folder.mkdir(exist_ok=True)
        return [*own, "sh", "-c", script, "sh", str(folder), options]

    return prefix


@contextmanager
def pictures_of_noise(url: str) -> Iterator[None]:
    """Raw pictures on CAMERA, ten a second, of which a PNG needs 900 kB."""
    from bot_core import image_t
    message = image_t()
    message.width, message.height, message.row_stride = 640, 480, 1920
    message.pixelformat, message.data = image_t.PIXEL_FORMAT_BGR, os.urandom(1920 * 480)
    message.size = len(message.data)

    def picture(number: int) -> tuple[str, bytes]:
        message.utime = 100_000 * (number + 1)
        return "CAMERA", message.encode()

    with speaking(url, picture, period_s=0.1):
        yield


def test_a_recording_that_fills_the_disk_says_so_and_keeps_what_came_before(
        url: str, disk: Disk, tmp_path: Path) -> None:
    folder = tmp_path / "small"
    with pictures_of_noise(url):
        done = deixis(url, "record", "--seconds", 20, "-o", folder / "x.lcmlog",
                      prefix=disk(folder, script=_MOUNT_AND_LIST))
    assert done.returncode == 1, done.stderr
    [line] = done.stderr.splitlines()
    assert "the disk is full" in line and ".part" in line
    assert [name.endswith(".part") for name in done.stdout.splitlines()[1:]] == [True]


def test_a_recording_on_a_disk_that_cannot_be_written_is_refused(
        url: str, disk: Disk, tmp_path: Path) -> None:
    done = deixis(url, "record", "--seconds", 1, "-o", tmp_path / "fixed" / "x.lcmlog",
                  prefix=disk(tmp_path / "fixed", "ro"))
    assert done.returncode == 1
    assert "Read-only file system: name another --output" in done.stderr


def test_offline_results_that_fill_the_disk_are_told_and_taken_away(
        url: str, disk: Disk, tmp_path: Path) -> None:
    log, folder = tmp_path / "in.lcmlog", tmp_path / "small"
    file = lcm.EventLog(str(log), "w", overwrite=True)
    for number in range(100):
        file.write_event(number, "A", bytes(10_000))
    file.close()
    done = deixis(url, "run-offline", log, folder / "out.lcmlog",
                  prefix=disk(folder, script=_MOUNT_AND_LIST))
    assert done.returncode == 1
    assert "No space left on device; free some space" in done.stderr
    assert done.stdout == ""


def test_a_camera_whose_log_fills_the_disk_ends_and_says_so(
        url: str, build: Path, repository: Path, disk: Disk, tmp_path: Path) -> None:
    folder = tmp_path / "small"
    clip = repository / "test/data/clips/spread_01/left.mp4"
    done = run(url, [*disk(folder), build / "bin/deixis-camera-driver",
                     "-l", f"file://{folder}/x.lcmlog?mode=w", "--set", "source.kind=video",
                     "--set", f"source.path={clip}", "--set", "pace=as_fast_as_possible"])
    assert done.returncode == 1, done.stderr
    assert "No space left on device; free some space" in done.stderr.splitlines()[-1]


def test_a_viewer_on_a_full_disk_goes_on_degraded(
        url: str, build: Path, disk: Disk, tmp_path: Path) -> None:
    from deixis import service_status_t
    bus, heard = lcm.LCM(url), []
    bus.subscribe("SERVICE_STATUS", lambda _, data: heard.append(service_status_t.decode(data)))
    viewer = subprocess.Popen([*disk(tmp_path / "small"), str(build / "bin/deixis-viewer"),
                               "-l", url, "--set", f"save_folder={tmp_path / 'small'}"])

    def says(word: str, state: int) -> bool:
        bus.handle_timeout(100)
        return bool(heard) and word in heard[-1].text and heard[-1].state == state

    try:
        with pictures_of_noise(url):
            assert becomes_true(lambda: says("latest.png", service_status_t.DEGRADED), 20.0)
        viewer.send_signal(signal.SIGTERM)
        assert viewer.wait(timeout=10) == 0
    finally:
        viewer.kill()
        viewer.wait()


def test_services_go_on_when_their_logs_fill_the_disk(bench: Bench, disk: Disk) -> None:
    bench.write({"a": {"set": {"spam": 5000}}, "b": {}})
    started = bench.deixis_below(disk(bench.logs), "start")
    assert started.returncode == 0, started.stderr
    assert becomes_true(lambda: bench.service("a")["log_bytes_lost"] > 0)
    assert "bytes of its log are lost" in bench.deixis("status").stdout
    pid = bench.service("a")["pid"]
    os.kill(pid, signal.SIGKILL)
    assert becomes_true(lambda: bench.service("a")["state"] == "running"
                        and bench.service("a")["pid"] != pid)
    assert bench.deixis("stop").returncode == 0


def test_logs_on_a_disk_that_cannot_be_written_are_refused_with_the_cure(
        bench: Bench, disk: Disk) -> None:
    bench.write({"a": {}})
    started = bench.deixis_below(disk(bench.logs, "ro"), "start")
    assert started.returncode == 1
    [line] = started.stderr.splitlines()
    assert "Read-only file system" in line and "log.folder" in line
