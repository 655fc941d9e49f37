"""Two programs on one channel: said, and told from one that is started again."""

from __future__ import annotations

import subprocess
from pathlib import Path

from bench import becomes_true
from listener import Listener


def test_two_cameras_on_one_channel_are_told_from_one_that_starts_again(
        url: str, build: Path, repository: Path) -> None:
    from deixis import service_status_t
    listener = Listener(url, SERVICE_STATUS=service_status_t)
    clip = repository / "test/data/clips/spread_01/left.mp4"

    def camera(instance: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen([build / "bin/deixis-camera-driver", "-l", url, "--instance",
                                 instance, "--set", "source.kind=video", "--set",
                                 f"source.path={clip}", "--set", "source.loop=true"])

    def viewer_says(words: str) -> bool:
        listener.hears("SERVICE_STATUS", 1, 5.0)
        viewers = [s for s in listener.heard["SERVICE_STATUS"] if s.service == "viewer"]
        return bool(viewers) and words in viewers[-1].text

    processes = [subprocess.Popen([build / "bin/deixis-viewer", "-l", url]), camera("one")]
    try:
        for _ in range(2):
            assert listener.hears("SERVICE_STATUS", 4)
            processes[-1].kill()
            processes.append(camera("one"))
        assert listener.hears("SERVICE_STATUS", 4)
        assert not any("two publishers" in status.text
                       for status in listener.heard["SERVICE_STATUS"])
        processes.append(camera("two"))
        assert becomes_true(lambda: viewer_says("two publishers send on CAMERA"), 20.0)
        [last] = [s for s in listener.heard["SERVICE_STATUS"] if s.service == "viewer"][-1:]
        assert last.state == last.DEGRADED
        assert all(channel.gaps < 50 for channel in last.channels)
    finally:
        for process in processes:
            process.kill()
            process.wait()
