"""Turns sequences into recordings with the hands and faces that the shipped programs see in the video."""

from __future__ import annotations

import math
from collections import defaultdict
from pathlib import Path
from typing import Any, Iterable

from deixis_frontend import layout
from deixis_frontend.evaluation.offline_chain import results_of_video
from deixis_frontend.evaluation.sequences import Sequence
from deixis_frontend.training.recordings import gesture_lines, header

_SIDES = {0: "unknown", 1: "left", 2: "right"}


def write_tracked_recordings(
    where: layout.Layout, sequences: Iterable[Sequence], folder: Path
) -> list[str]:
    """One file per sequence: tracked hands and detected faces, true object boxes. Returns remarks."""
    folder.mkdir(parents=True, exist_ok=True)
    remarks = []
    for sequence in sequences:
        hands, faces = _track(where, sequence.video)
        if not hands:
            remarks.append(f"{sequence.name}: the hand tracker published nothing")
            continue
        lines = header(sequence.name, sequence.person_id, sequence.objects)
        lines += gesture_lines(sequence) + frame_lines(hands, faces)
        (folder / f"{sequence.name}.recording").write_text("\n".join(lines) + "\n")
    return remarks


def _track(where: layout.Layout, video: Path) -> tuple[list[Any], dict[int, Any]]:
    """Hand messages in order, and the faces of each capture time."""
    hands: list[Any] = []
    faces: dict[int, Any] = defaultdict(list)
    for channel, message in results_of_video(where, video, ("object_detector", "hand_tracker"),
                                             {"HAND_TRACKS", "OBJECTS"}):
        if channel == "HAND_TRACKS":
            hands.append(message)
        else:
            faces[message.utime] += [o for o in message.objects if o.kind == o.FACE and o.has_box]
    return hands, faces


def frame_lines(hands: list[Any], faces: dict[int, Any]) -> list[str]:
    """The lines of all frames, from messages of hands and the faces of each capture time."""
    begin = hands[0].utime
    lines = []
    for message in hands:
        lines.append(f"frame {(message.utime - begin) / 1e6:.6f}")
        boxes = [face.box_px for face in faces.get(message.utime, [])]
        if boxes:
            largest = max(boxes, key=lambda box: box[2] * box[3])
            lines.append("face " + " ".join(f"{value:.1f}" for value in largest))
        lines += [_hand(hand) for hand in message.hands]
    return lines


def _hand(hand: Any) -> str:
    # Lower triangle row by row over u, v and their velocities: entries 0 and 2 are the variances.
    sigma = math.sqrt(max(0.25, 0.5 * (hand.covariance[0] + hand.covariance[2])))
    measured = int(hand.state == hand.MEASURED)
    return (f"hand {hand.id} {_SIDES[hand.side]} {hand.centre_px[0]:.2f} {hand.centre_px[1]:.2f}"
            f" {sigma:.2f} {measured} {int(hand.is_acting)}")
