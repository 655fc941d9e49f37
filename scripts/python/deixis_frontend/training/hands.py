"""`deixis train-hands`: the weights with which the hand tracker tells hands from other things.

Every candidate that the tracker finds in videos with labelled hands is a hand that rests, a hand that moves,
or something else; two logistic regressions over what is seen of it give the weights.
"""

from __future__ import annotations

import argparse
import csv
import io
import tempfile
from dataclasses import dataclass, field
from fnmatch import fnmatch
from pathlib import Path

import numpy as np

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.hand_recordings import HandRecording, read_recordings
from deixis_frontend.evaluation.offline_chain import write_pictures
from deixis_frontend.programs import run_program

FAST = 3.5  # hand lengths per second from which a hand counts as moving
_IS_HAND = 0.4  # hand lengths from a true hand within which a candidate shows it ...
_IS_OTHER = 0.8  # ... and beyond which it does not; between, nobody knows
_SETTLING_S = 0.5  # from a video's start, until the tracker knows its scene
_RIDGE = 1.0  # of the standardised weights
_COLUMNS = 5  # of the list before what is weighed: image, time_s, hand_length_px, u, v


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to learn from, and where the weights go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders, or of videos with labelled hands")
    parser.add_argument("--only", metavar="GLOB", help="names of recordings to use")
    parser.add_argument("--exclude", metavar="GLOB", help="names of recordings to leave out")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE",
                        help="YAML with resting and moving, as under"
                             " tracker.tracks.paths.likelihood in config/hand_tracker.yaml")


def run(arguments: argparse.Namespace) -> int:
    """0 when the weights are written; raises UserError when there is nothing to learn from."""
    where = layout.find()
    output_files.require_file(arguments.output, "--output")
    recordings, skipped = read_recordings(arguments.data, arguments.only)
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    recordings = [r for r in recordings
                  if not (arguments.exclude and fnmatch(r.name, arguments.exclude))]
    if not recordings:
        raise UserError(f"no labelled hands in {arguments.data}: nothing to learn from")
    examples = Examples()
    for recording in recordings:
        names, rows = _candidates(where, recording)
        examples.add(recording, names, rows)
        print(f"{recording.name}: {len(examples.looks)} candidates so far", flush=True)
    output_files.write_text(arguments.output, _as_yaml(examples), "--output")
    print(f"written: {arguments.output}")
    return 0


def _candidates(where: layout.Layout,
                recording: HandRecording) -> tuple[list[str], list[list[float]]]:
    """Names of what is weighed, and a row per image and per candidate."""
    with tempfile.TemporaryDirectory() as folder:
        pictures, faces = Path(folder) / "pictures.lcmlog", Path(folder) / "faces.lcmlog"
        write_pictures(where, recording.video, pictures)
        run_program(where, "deixis-offline", str(pictures), str(faces),
                    "--services", "object_detector")
        text = run_program(where, "deixis-list-hand-candidates", str(faces))
    heading, *rows = csv.reader(io.StringIO(text))
    return heading[_COLUMNS:], [[float(value) for value in row] for row in rows]


@dataclass
class Examples:
    """Candidates by what they are, and how often hands and images were there to be seen."""

    names: list[str] = field(default_factory=list)
    looks: list[list[float]] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)  # of each candidate: resting, moving, other
    hands: dict[str, int] = field(default_factory=lambda: {"resting": 0, "moving": 0})
    images: int = 0

    def add(self, recording: HandRecording, names: list[str], rows: list[list[float]]) -> None:
        """Labels the candidates of one recording."""
        self.names = names
        times = {int(row[0]): row[1] for row in rows}
        lengths = [row[2] for row in rows if len(row) > _COLUMNS]
        if not lengths:
            return
        length = float(np.median(lengths))
        for image, time_s in times.items():
            if time_s > _SETTLING_S and image < len(recording.truth):
                self.images += 1
                for hand in recording.truth[image]:
                    if hand.is_visible:
                        self.hands[_motion(recording, image, times, hand.name, length)] += 1
        for row in rows:
            image = int(row[0])
            if len(row) > _COLUMNS and row[1] > _SETTLING_S and image < len(recording.truth):
                self._add(recording, image, times, row)

    def _add(self, recording: HandRecording, image: int, times: dict[int, float],
             row: list[float]) -> None:
        length = row[2]
        place = np.array(row[3:5])
        nearest = min(((float(np.hypot(*(place - hand.centre_px))) / length, hand.name)
                       for hand in recording.truth[image]), default=(np.inf, ""))
        bystander = min((float(np.hypot(*(place - other))) / length
                         for other in recording.others[image]), default=np.inf)
        if nearest[0] <= _IS_HAND:
            kind = _motion(recording, image, times, nearest[1], length)
        elif min(nearest[0], bystander) > _IS_OTHER:
            kind = "other"
        else:
            return
        self.looks.append(row[_COLUMNS:])
        self.kinds.append(kind)

    def weights(self, motion: str) -> np.ndarray:
        """Of the log ratio between what is seen of a hand in `motion`, and per image of other things."""
        kinds = np.array(self.kinds)
        used = (kinds == motion) | (kinds == "other")
        if self.hands[motion] == 0 or not (kinds == motion).any() or not (kinds == "other").any():
            raise UserError(f"no {motion} hands, or nothing else, in the data: nothing to learn from")
        weights = fit(np.array(self.looks)[used], (kinds[used] == motion).astype(float))
        weights[0] += np.log(self.images / self.hands[motion])
        return weights


def fit(looks: np.ndarray, is_hand: np.ndarray) -> np.ndarray:
    """Logistic regression (Newton's method, ridge on standardised columns).

    looks: n x k, its first column 1; is_hand: n, 0 or 1. Returns k weights.
    """
    mean, spread = looks[:, 1:].mean(axis=0), looks[:, 1:].std(axis=0) + 1e-9
    design = np.column_stack([looks[:, 0], (looks[:, 1:] - mean) / spread])
    ridge = _RIDGE * np.diag([1e-3] + [1.0] * (design.shape[1] - 1))
    weights = np.zeros(design.shape[1])
    for _ in range(50):
        probability = 1.0 / (1.0 + np.exp(-np.clip(design @ weights, -30, 30)))
        slope = design.T @ (probability - is_hand) + ridge @ weights
        curvature = (design * (probability * (1 - probability))[:, None]).T @ design + ridge
        step = np.linalg.solve(curvature, slope)
        weights -= step
        if np.abs(step).max() < 1e-8:
            break
    scaled = weights[1:] / spread
    return np.concatenate([[weights[0] - scaled @ mean], scaled])


def _motion(recording: HandRecording, image: int, times: dict[int, float], name: str,
            length_px: float) -> str:
    """resting or moving, by the way of the hand `name` since the image before."""
    def place(at: int) -> np.ndarray | None:
        return next((np.array(h.centre_px) for h in recording.truth[at] if h.name == name), None)

    if image == 0:
        return "resting"
    before, now = place(image - 1), place(image)
    elapsed_s = times[image] - times[image - 1]
    if before is None or now is None or elapsed_s <= 0:
        return "resting"
    return "moving" if np.hypot(*(now - before)) / length_px / elapsed_s > FAST else "resting"


def _as_yaml(examples: Examples) -> str:
    lines = []
    for motion in ("resting", "moving"):
        lines.append(f"{motion}:")
        lines += [f"  {name}: {value:.2f}"
                  for name, value in zip(examples.names, examples.weights(motion))]
    return "\n".join(lines) + "\n"
