"""What has a place in the picture, drawn into it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from deixis import hand_t
from foxglove_schemas_protobuf.CircleAnnotation_pb2 import CircleAnnotation
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation
from foxglove_schemas_protobuf.TextAnnotation_pb2 import TextAnnotation

from deixis_frontend.export import names
from deixis_frontend.export.drawing import (
    BLUE, GREEN, GREY, ORANGE, SHADE, WHITE, YELLOW, pixel, pixels, stamp)

_LINE_PX = 2.0
_FONT_PX = 14.0
_DOT_PX = 6.0
_ARC_STEPS = 16
_POINTS, _LOOP = PointsAnnotation.POINTS, PointsAnnotation.LINE_LOOP


def of_hands(message: Any) -> ImageAnnotations:
    """Box, centre and fingertip of each hand of a hand_tracks_t."""
    drawn = ImageAnnotations(timestamp=stamp(message.utime))
    for hand in message.hands:
        measured = YELLOW if hand.is_acting else ORANGE
        colour = measured if hand.state == hand_t.MEASURED else GREY
        drawn.points.append(_box(hand.box_px, colour))
        drawn.circles.append(_dot(hand.centre_px, colour))
        if hand.has_fingertip:
            drawn.circles.append(_dot(hand.fingertip_px, WHITE))
        drawn.texts.append(_text(names.hand(hand), hand.box_px, colour))
    return drawn


def of_objects(message: Any) -> ImageAnnotations:
    """The box of each object of an objects_t that has one."""
    drawn = ImageAnnotations(timestamp=stamp(message.utime))
    for thing in message.objects:
        if thing.has_box:
            colour = BLUE if names.is_there(thing) else GREY
            drawn.points.append(_box(thing.box_px, colour))
            drawn.texts.append(_text(names.thing(thing), thing.box_px, colour))
    return drawn


def of_hypotheses(message: Any) -> ImageAnnotations:
    """The area in which each hypothesis of a gesture_state_t looks for objects."""
    drawn = ImageAnnotations(timestamp=stamp(message.utime))
    for hypothesis in message.hypotheses:
        if hypothesis.has_context:
            drawn.points.append(PointsAnnotation(
                type=_LOOP, points=pixels(_sector(hypothesis)), outline_color=GREEN,
                thickness=_LINE_PX))
            drawn.texts.append(_text(names.hypothesis(hypothesis),
                                     hypothesis.context_centre_px, GREEN))
    return drawn


def of_keypoints(message: Any) -> ImageAnnotations:
    """The landmarks of each person of a keypoints_t."""
    drawn = ImageAnnotations(timestamp=stamp(message.utime))
    for person in message.people:
        drawn.points.append(PointsAnnotation(
            type=_POINTS, points=pixels(found.point_px for found in person.points),
            outline_color=GREEN, fill_color=GREEN, thickness=_DOT_PX))
    return drawn


def _box(box_px: Sequence[float], colour: Color) -> PointsAnnotation:
    left, top, width, height = box_px
    corners = [(left, top), (left + width, top), (left + width, top + height),
               (left, top + height)]
    return PointsAnnotation(type=_LOOP, points=pixels(corners), outline_color=colour,
                            thickness=_LINE_PX)


def _dot(centre_px: Sequence[float], colour: Color) -> CircleAnnotation:
    return CircleAnnotation(position=pixel(centre_px), diameter=_DOT_PX, thickness=_LINE_PX,
                            fill_color=colour, outline_color=colour)


def _text(text: str, place_px: Sequence[float], colour: Color) -> TextAnnotation:
    return TextAnnotation(position=pixel(place_px), text=text, font_size=_FONT_PX,
                          text_color=colour, background_color=SHADE)


def _sector(hypothesis: Any) -> list[tuple[float, float]]:
    """From the centre along the arc and back; angles from x towards y, as in the picture."""
    x, y = hypothesis.context_centre_px
    begin, end = hypothesis.context_start_rad, hypothesis.context_end_rad
    angles = [begin + (end - begin) * step / _ARC_STEPS for step in range(_ARC_STEPS + 1)]
    radius = hypothesis.context_radius_px
    return [(x, y), *((x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles)]
