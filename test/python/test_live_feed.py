"""What `evaluate live` plays: a clip, or a stereo pair with its calibration."""

from __future__ import annotations

from pathlib import Path

import pytest

from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.live import camera_feed, stereo_feed

PARTS = ("left.mp4", "right.mp4", "intrinsics.yml", "extrinsics.yml")


def test_a_clip_goes_through_the_camera_driver(tmp_path: Path) -> None:
    clip = tmp_path / "clip.mp4"
    clip.touch()
    feed = camera_feed(clip, 30.0)
    assert (feed.driver, feed.channel) == ("camera_driver", "CAMERA")
    assert f"source.path={clip}" in feed.settings
    assert {"source.rate_hz=30.0", "source.loop=true"} <= set(feed.settings)


def test_a_pair_goes_through_the_stereo_driver(tmp_path: Path) -> None:
    for part in PARTS:
        (tmp_path / part).touch()
    feed = stereo_feed(tmp_path, 15.0)
    assert (feed.driver, feed.channel) == ("stereo_driver", "STEREO")
    assert f"source.right.path={tmp_path / 'right.mp4'}" in feed.settings
    assert "source.loop=true" in feed.settings
    assert f"calibration.extrinsics={tmp_path / 'extrinsics.yml'}" in feed.settings


@pytest.mark.parametrize("missing", PARTS)
def test_what_a_folder_lacks_is_named(tmp_path: Path, missing: str) -> None:
    for part in PARTS:
        if part != missing:
            (tmp_path / part).touch()
    with pytest.raises(UserError, match=f"lacks {missing}"):
        stereo_feed(tmp_path, 30.0)
