"""A made-up person in a T pose as a BVH file, y up, centimetres; and forward kinematics of BVH in numpy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import bvh
import numpy as np

_SIDES = {"Left": 1, "Right": -1}
_MIDDLE = {"Hips": ("", (0, 95, 0)), "Spine": ("Hips", (0, 10, 0)), "Spine1": ("Spine", (0, 15, 0)),
           "Neck": ("Spine1", (0, 25, 0)), "Head": ("Neck", (0, 10, 0))}
_SIDED = {"Shoulder": ("Spine1", (3, 22, 0)), "Arm": ("Shoulder", (15, 0, 0)), "ForeArm": ("Arm", (29, 0, 0)),
          "Hand": ("ForeArm", (25, 0, 0)), "UpLeg": ("Hips", (9, -2, 0)), "Leg": ("UpLeg", (0, -42, 0)),
          "Foot": ("Leg", (0, -42, 0)), "ToeBase": ("Foot", (0, -7, 14))}
_ENDS = {"Head": (0, 18, 0), "Hand": (18, 0, 0), "ToeBase": (0, 0, 6)}
Turns = Mapping[str, tuple[float, float, float]]


def write_bvh(file: Path, frames: Sequence[Turns], rate_hz: float = 30.0) -> None:
    """Each frame turns joints about z, x and y, degrees; the others stay."""
    joints = _joints()
    lines = ["HIERARCHY", *_node("Hips", joints, ""), "MOTION", f"Frames: {len(frames)}",
             f"Frame Time: {1 / rate_hz:.9f}"]
    order = _depth_first("Hips", joints)
    for turns in frames:
        unknown = set(turns) - set(order)
        assert not unknown, unknown
        values = [0.0, 0.0, 0.0, *(value for name in order for value in turns.get(name, (0, 0, 0)))]
        lines.append(" ".join(f"{value:.6f}" for value in values))
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


def positions_m(file: Path, frame: int) -> dict[str, np.ndarray]:
    """Where each joint is, metres, as the package `bvh` reads the file (one that writes centimetres)."""
    motion = bvh.Bvh(file.read_text(encoding="ascii"))
    placed: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for name in motion.get_joints_names():
        parent = motion.joint_parent(name)
        turn, at = placed[parent.name] if parent is not None else (np.eye(3), np.zeros(3))
        moved = np.array(motion.joint_offset(name), dtype=float)
        own = np.eye(3)
        for channel in motion.joint_channels(name):
            value = motion.frame_joint_channel(frame, name, channel)
            axis = "XYZ".index(channel[0])
            if channel.endswith("position"):
                moved[axis] += value
            else:
                own = own @ _about(axis, np.radians(value))
        placed[name] = (turn @ own, at + turn @ moved)
    return {name: 0.01 * at for name, (_, at) in placed.items()}


def _joints() -> dict[str, tuple[str, tuple[float, ...]]]:
    joints: dict[str, tuple[str, tuple[float, ...]]] = dict(_MIDDLE)
    for side, sign in _SIDES.items():
        for name, (parent, offset) in _SIDED.items():
            joints[side + name] = (side + parent if parent in _SIDED else parent,
                                   (sign * offset[0], *offset[1:]))
    return joints


def _depth_first(name: str, joints: Mapping[str, tuple[str, tuple[float, ...]]]) -> list[str]:
    children = [child for child, (parent, _) in joints.items() if parent == name]
    return [name, *(below for child in children for below in _depth_first(child, joints))]


def _node(name: str, joints: Mapping[str, tuple[str, tuple[float, ...]]], indent: str) -> list[str]:
    parent, offset = joints[name]
    positions = "" if parent else "Xposition Yposition Zposition "
    lines = [f"{indent}{'JOINT' if parent else 'ROOT'} {name}", f"{indent}{{",
             f"{indent}  OFFSET {offset[0]} {offset[1]} {offset[2]}",
             f"{indent}  CHANNELS {3 if parent else 6} {positions}Zrotation Xrotation Yrotation"]
    for child, (of, _) in joints.items():
        if of == name:
            lines += _node(child, joints, indent + "  ")
    for part, end in _ENDS.items():
        if name.endswith(part):
            sign = _SIDES["Right"] if name.startswith("Right") else 1
            lines += [f"{indent}  End Site", f"{indent}  {{",
                      f"{indent}    OFFSET {sign * end[0]} {end[1]} {end[2]}", f"{indent}  }}"]
    return [*lines, f"{indent}}}"]


def _about(axis: int, angle: float) -> np.ndarray:
    turn = np.eye(3)
    one, two = (axis + 1) % 3, (axis + 2) % 3
    turn[one, one] = turn[two, two] = np.cos(angle)
    turn[two, one] = np.sin(angle)
    turn[one, two] = -turn[two, one]
    return turn
