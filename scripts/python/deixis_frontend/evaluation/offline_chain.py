"""What the shipped services make of a video: camera driver (video to log), then offline (log to log)."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from deixis_frontend.layout import Layout
from deixis_frontend.programs import run_program


def results_of_video(layout: Layout, video: Path, services: Sequence[str], channels: set[str],
                     settings: Sequence[str] = ()) -> list[tuple[str, Any]]:
    """Channel and message of all results on `channels`, in order.

    `settings` are service.key=value; raises UserError when a program fails.
    """
    layout.use_types()
    from deixis_lcm import logs

    with tempfile.TemporaryDirectory() as folder:
        pictures, results = Path(folder) / "pictures.lcmlog", Path(folder) / "results.lcmlog"
        write_pictures(layout, video, pictures)
        run_program(layout, "deixis-offline", str(pictures), str(results), "--results-only",
                    "--services", ",".join(services),
                    *(word for setting in settings for word in ("--set", setting)))
        return [(channel, message) for _, channel, message in logs.read(results, channels)]


def write_pictures(layout: Layout, video: Path, log: Path) -> None:
    """Writes a log of the video's pictures as the camera driver publishes them."""
    run_program(layout, "deixis-camera-driver", "--set", "source.kind=video",
                "--set", f"source.path={video.resolve()}", "--set", "pace=as_fast_as_possible",
                "--lcm-url", f"file://{log}?mode=w")
