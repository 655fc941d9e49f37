"""What `evaluate live` plays: a clip, or a stereo pair with its calibration; and who must live."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from front_end import status

from deixis_frontend import layout, lcm_url, service_facts
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import live
from deixis_frontend.evaluation.live import CONSUMERS, body_feed, camera_feed, stereo_feed

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
    assert feed.consumers["hand_tracker"] == ("image_channel=STEREO",)
    assert feed.last == "gesture_recogniser"


def test_bodies_are_fitted_to_pairs_that_a_camera_sends(tmp_path: Path) -> None:
    for part in PARTS:
        (tmp_path / part).touch()
    feed = body_feed(tmp_path, 30.0, tmp_path / "pairs.lcmlog")
    assert {"source.kind=pair_channel", "matcher.match_size=people",
            f"calibration.intrinsics={tmp_path / 'intrinsics.yml'}"} == set(feed.settings) - {
                f"calibration.extrinsics={tmp_path / 'extrinsics.yml'}"}
    assert (feed.last, feed.pairs, feed.rate_hz) == ("pose_fitter", tmp_path / "pairs.lcmlog", 30.0)


@pytest.mark.parametrize("missing", PARTS)
def test_what_a_folder_lacks_is_named(tmp_path: Path, missing: str) -> None:
    for part in PARTS:
        if part != missing:
            (tmp_path / part).touch()
    with pytest.raises(UserError, match=f"lacks {missing}"):
        stereo_feed(tmp_path, 30.0)


@pytest.mark.parametrize(("pictures", "is_behind"), [(502, True), (581, True), (582, False),
                                                     (603, False)])
def test_a_source_that_falls_behind_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str],
                                            pictures: int, is_behind: bool) -> None:
    facts = service_facts.as_facts(status("any"))
    services = {name: live._figures(facts, name, 50.0, None, pictures)
                for name in (*CONSUMERS, "camera_driver")}
    services["camera_driver"]["lost"] = 2
    clip = tmp_path / "clip.mp4"
    clip.touch()
    result = live._result(services, camera_feed(clip, 30.0), 30.0, 20.0)
    live._print(result | {"load_average": [0.5, 2.0], "bodies": None})
    assert (result["pictures_wanted"], result["source_fell_behind"]) == (600, is_behind)
    each_ms = result["summary"]["camera_driver"]["cpu_ms_per_result"]  # Half of a core for 20 s.
    assert each_ms == pytest.approx(10_000.0 / (pictures - 2))
    said = f"{pictures} of 600 pictures: the machine is too slow for 30 Hz; ages grow with it\n"
    assert (said in capsys.readouterr().out) == is_behind


def test_figures_of_a_service_that_has_died_are_none(url: str, tmp_path: Path) -> None:
    for name in (*CONSUMERS, "camera_driver"):
        program = tmp_path / f"deixis-{name.replace('_', '-')}"
        program.write_text(f"#!/bin/sh\nPYTHONPATH={os.pathsep.join(sys.path)} exec {sys.executable}"
                           f" {Path(__file__).with_name('fake_service.py')} --set service={name}"
                           f" --set say=mine \"$@\"\n", encoding="ascii")
        program.chmod(0o755)
    clip = tmp_path / "clip.mp4"
    clip.touch()
    chain = live._Chain(replace(layout.find(), programs=tmp_path), tmp_path, lcm_url.parse(url),
                        camera_feed(clip, 30.0))
    try:
        chain.start_consumers()
        chain.start_driver()
        chain._processes["hand_tracker"].kill()
        with pytest.raises(UserError, match="^hand_tracker has ended: mine$"):
            chain.measure(0.2)
    finally:
        chain.stop()
