"""Learning what hands look like: the fit, the labels, and that the tracker takes what is learned."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml

from deixis_frontend import layout
from deixis_frontend.cli import main
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.hand_recordings import HandRecording
from deixis_frontend.evaluation.hand_scores import TrueHand
from deixis_frontend.evaluation.offline_chain import write_pictures
from deixis_frontend.programs import run_program
from deixis_frontend.training.hands import Examples, fit


def test_the_fit_finds_the_weights_that_made_the_data() -> None:
    random = np.random.default_rng(1)
    looks = np.column_stack([np.ones(40000), random.normal(2.0, 3.0, 40000), random.random(40000)])
    weights = np.array([-1.0, 0.5, 2.0])
    is_hand = random.random(40000) < 1.0 / (1.0 + np.exp(-looks @ weights))
    assert fit(looks, is_hand.astype(float)) == pytest.approx(weights, abs=0.1)


def recording(way_px: float) -> HandRecording:
    """30 images, 15 per second, of one hand that goes `way_px` per image."""
    truth = [[TrueHand("right", (100.0 + way_px * i, 50.0), True)] for i in range(30)]
    return HandRecording("made", Path("none.mp4"), truth, [25.0] * 30, [[] for _ in truth])


def rows(way_px: float) -> list[list[float]]:
    """A candidate on the hand, one beside it and one far away, hands 40 px long."""
    listed = []
    for i in range(30):
        u = 100.0 + way_px * i
        listed.append([float(i), i / 15.0])
        listed += [[float(i), i / 15.0, 40.0, u + shift, 50.0, 1.0, shift] for shift in (2, 24, 200)]
    return listed


@pytest.mark.parametrize(("way_px", "kind"), [(1.0, "resting"), (20.0, "moving")])
def test_candidates_are_labelled_by_place_and_speed(way_px: float, kind: str) -> None:
    examples = Examples()
    examples.add(recording(way_px), ["constant", "shift"], rows(way_px))
    assert set(examples.kinds) == {kind, "other"}
    assert examples.kinds.count(kind) == examples.kinds.count("other") == examples.images
    assert examples.hands[kind] == examples.images


def test_what_lies_on_a_bystanders_hand_is_not_said_to_be_none() -> None:
    made = recording(1.0)
    far = [[(300.0 + i, 50.0)] for i in range(30)]
    examples = Examples()
    examples.add(HandRecording(made.name, made.video, made.truth, made.gates_px, far),
                 ["constant", "shift"], rows(1.0))
    assert "other" not in examples.kinds
    with pytest.raises(UserError, match="nothing to learn from"):
        examples.weights("resting")


def test_the_tracker_lists_exactly_what_its_configuration_weighs(tmp_path: Path) -> None:
    where = layout.find()
    clip = Path(__file__).resolve().parents[1] / "data" / "clips" / "spread_01" / "left.mp4"
    pictures, faces = tmp_path / "pictures.lcmlog", tmp_path / "faces.lcmlog"
    write_pictures(where, clip, pictures)
    run_program(where, "deixis-offline", str(pictures), str(faces), "--services", "object_detector")
    heading, *listed = run_program(where, "deixis-list-hand-candidates", str(faces)).splitlines()
    shipped = yaml.safe_load((where.config / "hand_tracker.yaml").read_text("utf-8"))
    likelihood = shipped["tracker"]["tracks"]["paths"]["likelihood"]
    names = heading.split(",")[5:]
    assert names == list(likelihood["resting"]) == list(likelihood["moving"])
    widths = {len(line.split(",")) for line in listed}
    assert widths == {2, 5 + len(names)}


def test_without_labelled_videos_nothing_is_learned(tmp_path: Path,
                                                    capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "weights.yaml"
    assert main(["train-hands", "--data", str(tmp_path), "--output", str(output)]) == 1
    assert "labelled" in capsys.readouterr().err
    assert not output.exists()
