"""Which point of which limb stands for which labelled joint, and the body parts that angles and lengths are of.

One table for all data: a joint is the proximal or the distal end of a limb of the body model, moved by a constant
offset in the limb's frame where the labels mean another point than the model does.
"""

from __future__ import annotations

from dataclasses import dataclass

SIDES = {"r_": "right_", "l_": "left_"}


@dataclass(frozen=True)
class JointPlace:
    """Where the labelled joint `name` is on the model."""

    name: str
    limb: str
    end: str = "proximal"
    # In the limb's frame (z towards its distal end), as fractions of the stature.
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def kind(self) -> str:
        """The joint's name without its side."""
        return kind_of(self.name)


def kind_of(joint: str) -> str:
    """`elbow` of `r_elbow`."""
    return joint[2:] if joint[:2] in SIDES else joint


def _both(joint: str, limb: str) -> list[JointPlace]:
    return [JointPlace(side + joint, name + limb) for side, name in SIDES.items()]


# The joints that are judged. The root's place (`PELVIS`) only tells people apart.
JOINTS: tuple[JointPlace, ...] = (
    JointPlace("neck", "neck"),
    JointPlace("head", "head"),
    *_both("shoulder", "upper_arm"),
    *_both("elbow", "lower_arm"),
    *_both("wrist", "hand"),
    *_both("hip", "thigh"),
    *_both("knee", "shank"),
    *_both("ankle", "foot"),
)
PELVIS = "pelvis"
NAMES = tuple(joint.name for joint in JOINTS)
KINDS = tuple(dict.fromkeys(joint.kind for joint in JOINTS))
INDEX = {name: index for index, name in enumerate(NAMES)}

# Joints whose angle is that between two bones: proximal, middle, distal.
HINGES = {"elbow": ("shoulder", "elbow", "wrist"), "knee": ("hip", "knee", "ankle")}
# Joints whose angle is that between the true and the estimated bone as the trunk sees it.
BALLS = {"shoulder": ("shoulder", "elbow"), "hip": ("hip", "knee")}
BONES = {"upper_arm": ("shoulder", "elbow"), "lower_arm": ("elbow", "wrist"),
         "thigh": ("hip", "knee"), "shank": ("knee", "ankle")}


def index(side: str, joint: str) -> int:
    """Index in `JOINTS` of a joint of one side (`r_`, `l_`)."""
    return INDEX[side + joint]
