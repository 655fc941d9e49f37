"""What has a position in metres, as things in Foxglove's three-dimensional scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from deixis import body_pose_t, hand_t, limb_pose_t
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneEntityDeletion_pb2 import SceneEntityDeletion
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.SpherePrimitive_pb2 import SpherePrimitive
from foxglove_schemas_protobuf.TextPrimitive_pb2 import TextPrimitive

from deixis_frontend.export import names
from deixis_frontend.export.drawing import (
    BLUE, GREEN, GREY, ORANGE, YELLOW, point, pose, stamp, vector)

_HAND_M = 0.09  # diameters
_OBJECT_M = 0.08
_JOINT_M = 0.04
_LINE_M = 0.02
_FONT_M = 0.06
_RAY_M = 5.0  # length of a pointing ray
_LIMB_COLOURS = {limb_pose_t.MEASURED: GREEN, limb_pose_t.INFERRED: YELLOW,
                 limb_pose_t.HIDDEN: ORANGE}


def replace_all(utime: int, entities: Iterable[SceneEntity]) -> SceneUpdate:
    """All there is at a time: what the topic had before goes."""
    everything = SceneEntityDeletion(timestamp=stamp(utime), type=SceneEntityDeletion.ALL)
    return SceneUpdate(deletions=[everything], entities=entities)


def hands(message: Any, frame: str) -> list[SceneEntity]:
    """The hands of a hand_tracks_t whose position is known."""
    return [_hand(message, hand, frame) for hand in message.hands if hand.has_position]


def things(message: Any, frame: str) -> list[SceneEntity]:
    """The objects of an objects_t whose position is known."""
    return [_thing(message, thing, frame) for thing in message.objects if thing.has_position]


def bodies(message: Any, poses: Iterable[Any], frame: str) -> list[SceneEntity]:
    """People, as lines from each limb's proximal joint to its distal end."""
    return [_body(message, body, frame) for body in poses]


def ray(message: Any, frame: str) -> SceneUpdate:
    """The pointing ray of a gesture_t, till the same event comes with its end."""
    entity_id = f"gesture {message.event_id}"
    if message.end_utime:
        return SceneUpdate(deletions=[SceneEntityDeletion(
            timestamp=stamp(message.utime), type=SceneEntityDeletion.MATCHING_ID, id=entity_id)])
    begin = message.ray_origin_m
    end = [b + _RAY_M * d for b, d in zip(begin, message.ray_direction)]
    entity = _entity(message, frame, entity_id)
    entity.lines.append(_line([begin, end], YELLOW))
    entity.texts.append(_text(names.gesture(message), begin, YELLOW))
    return SceneUpdate(entities=[entity])


def _entity(message: Any, frame: str, entity_id: str) -> SceneEntity:
    return SceneEntity(timestamp=stamp(message.utime), frame_id=frame, id=entity_id,
                       frame_locked=True)


def _hand(message: Any, hand: Any, frame: str) -> SceneEntity:
    colour = YELLOW if hand.state == hand_t.MEASURED else GREY
    entity = _entity(message, frame, f"hand {hand.id}")
    entity.spheres.append(_sphere(hand.position_m, _HAND_M, colour))
    entity.texts.append(_text(names.hand(hand), hand.position_m, colour))
    return entity


def _thing(message: Any, thing: Any, frame: str) -> SceneEntity:
    colour = BLUE if names.is_there(thing) else GREY
    entity = _entity(message, frame, f"object {thing.id}")
    if any(thing.extent_m):
        entity.cubes.append(CubePrimitive(pose=pose(thing.position_m), color=colour,
                                          size=vector(thing.extent_m)))
    else:
        entity.spheres.append(_sphere(thing.position_m, _OBJECT_M, colour))
    entity.texts.append(_text(names.thing(thing), thing.position_m, colour))
    return entity


def _body(message: Any, body: Any, frame: str) -> SceneEntity:
    entity = _entity(message, frame, f"person {body.person_id}")
    is_lost = body.state == body_pose_t.LOST
    for limb in body.limbs:
        colour = GREY if is_lost else _LIMB_COLOURS.get(limb.state, GREY)
        entity.lines.append(_line([limb.proximal_m, limb.distal_m], colour))
        entity.spheres.append(_sphere(limb.proximal_m, _JOINT_M, colour))
    entity.texts.append(_text(f"person {body.person_id}", body.root_in_frame.translation_m,
                              GREY if is_lost else GREEN))
    return entity


def _line(points_m: Sequence[Sequence[float]], colour: Color) -> LinePrimitive:
    return LinePrimitive(type=LinePrimitive.LINE_STRIP, pose=pose((0.0, 0.0, 0.0)),
                         thickness=_LINE_M, points=[point(p) for p in points_m], color=colour)


def _sphere(position_m: Sequence[float], diameter_m: float, colour: Color) -> SpherePrimitive:
    return SpherePrimitive(pose=pose(position_m), size=vector([diameter_m] * 3), color=colour)


def _text(text: str, position_m: Sequence[float], colour: Color) -> TextPrimitive:
    return TextPrimitive(pose=pose(position_m), billboard=True, font_size=_FONT_M, text=text,
                         color=colour)
