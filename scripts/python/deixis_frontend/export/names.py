"""How hands, objects and gestures are called and told apart in a picture or a scene."""

from __future__ import annotations

from typing import Any

from deixis import gesture_t, hand_t, object_t

_SIDES = {hand_t.LEFT: "left", hand_t.RIGHT: "right"}  # the person's own
_OUTCOMES = {gesture_t.NO_OBJECT: "no known object", gesture_t.AMBIGUOUS: "several objects"}


def side(number: int) -> str:
    """'left hand', 'right hand' or 'hand'."""
    return f"{_SIDES[number]} hand" if number in _SIDES else "hand"


def hand(message: Any) -> str:
    """Side and id of a hand_t."""
    return f"{side(message.side)} {message.id}"


def thing(message: Any) -> str:
    """Label and id of an object_t."""
    return f"{message.label or 'object'} {message.id}"


def is_there(message: Any) -> bool:
    """Whether an object_t is seen in this picture, or a place, which is always there."""
    return message.visibility == object_t.SEEN or message.kind == object_t.PLACE


def hypothesis(message: Any) -> str:
    """Model, phase and the most probable object of a gesture_hypothesis_t."""
    words = f"{message.model} {message.phase:.2f}"
    if not message.candidates:
        return words
    best = message.candidates[0]
    return f"{words}: {best.label or f'object {best.object_id}'} {best.probability:.2f}"


def meant(message: Any) -> str:
    """What a gesture_t refers to."""
    if message.outcome in _OUTCOMES:
        return _OUTCOMES[message.outcome]
    return f"{message.object_label or 'object'} {message.object_id}"


def gesture(message: Any) -> str:
    """Name of a gesture_t and what it refers to."""
    return f"{message.name} at {meant(message)}"
