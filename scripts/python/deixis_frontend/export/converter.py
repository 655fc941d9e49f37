"""Which of our messages becomes what in Foxglove."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

import bot_core
import deixis
import kinect
import sensor_msgs
import tf2_msgs
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

from deixis_frontend.export import (
    annotations, cameras, kinect_pictures, pictures, robot_frames, robot_pictures, sayings, scenes,
    skeletons)
from deixis_lcm import images

_POSE_CHANNEL = "CAMERA_POSE"  # behind any prefix
_DEFAULT_CAMERA = "CAMERA"
_DEFAULT_PARENT = "parent"
Converted = Iterator[tuple[str, Any]]  # topic, or what stands in it behind the channel; message


class Converter:
    """Turns messages into Foxglove's, one after the other in the order of the log.

    `left_out` counts what there is no counterpart for, by words for people.
    """

    def __init__(self) -> None:
        self.left_out: Counter[str] = Counter()
        self._camera = _DEFAULT_CAMERA  # of the last calibration: CAMERA_POSE names none
        self._parent = _DEFAULT_PARENT
        self._posed: set[str] = set()  # cameras whose CAMERA_POSE has come
        self._in_tree: set[str] = set()  # frames that a robot's transforms have placed
        self._published: set[str] = set()  # channels that services say are theirs
        self._filled: set[str] = set()  # channels whose scene is not empty
        self._states: dict[tuple[Any, ...], tuple[int, str]] = {}
        self._by_type = self._converters()

    def _converters(self) -> dict[type, Callable[[str, Any], Converted]]:
        return {
            bot_core.image_t: self._image,
            bot_core.images_t: self._images,
            bot_core.rigid_transform_t: self._camera_pose,
            deixis.camera_calibration_t: self._calibration,
            deixis.stereo_calibration_t: self._stereo_calibration,
            deixis.hand_tracks_t: self._hands,
            deixis.objects_t: self._objects,
            deixis.gesture_state_t: self._gesture_state,
            deixis.gesture_t: self._gesture,
            deixis.keypoints_t: self._keypoints,
            deixis.body_poses_t: self._bodies,
            deixis.verified_poses_t: self._verified,
            deixis.service_status_t: self._status,
            kinect.skeleton_msg_t: self._skeleton,
            kinect.frame_msg_t: self._kinect_frame,
            sensor_msgs.Image: self._robot_image,
            sensor_msgs.CompressedImage: self._robot_file,
            sensor_msgs.CameraInfo: self._robot_lens,
            tf2_msgs.TFMessage: self._robot_transforms,
        }

    def convert(self, channel: str, message: Any) -> Converted:
        """Topics and messages that follow from one.

        ValueError where its numbers make no sense, behind what could be converted before.
        """
        converted = self._by_type.get(type(message))
        if converted is None:
            self._leave_out(channel, message)
            return
        topic = channel if channel.startswith("/") else f"/{channel}"
        for what, made in converted(channel, message):
            yield f"{topic}/{what}", made

    def _leave_out(self, channel: str, message: Any) -> None:
        kind = "an unknown type" if message is None else type(message).__name__
        self.left_out[f"{kind} on {channel}"] += 1

    def _image(self, channel: str, message: Any) -> Converted:
        yield "image", pictures.picture(message, images.camera_of(message) or channel)

    def _images(self, channel: str, message: Any) -> Converted:
        frame = self._camera_of_bundle(channel, message)
        for kind, image in zip(message.image_types, message.images):
            if kind in pictures.SIDES:
                yield pictures.SIDES[kind], pictures.picture(image, frame)
            elif not pictures.is_depth(kind):
                self.left_out[f"images of role {kind} on {channel}"] += 1
        if any(map(pictures.is_depth, message.image_types)):
            yield "depth", pictures.depth(message, frame)

    def _camera_of_bundle(self, channel: str, message: Any) -> str:
        names = [name for image in message.images if (name := images.camera_of(image))]
        return names[0] if names else channel

    def _camera_pose(self, channel: str, message: Any) -> Converted:
        if not (channel.endswith(_POSE_CHANNEL) or channel in self._published):
            self._leave_out(channel, message)
            return
        if self._camera in self._in_tree:
            self.left_out[f"poses on {channel} of a camera that transforms place"] += 1
            return
        self._posed.add(self._camera)
        yield "transform", cameras.camera_pose(message, self._parent, self._camera)

    def _calibration(self, channel: str, message: Any) -> Converted:
        yield from self._camera_facts(message, message.camera or channel, message.utime)

    def _stereo_calibration(self, channel: str, message: Any) -> Converted:
        camera = message.camera or message.rectified.camera or channel
        yield from self._camera_facts(message.rectified, camera, message.utime)

    def _camera_facts(self, message: Any, camera: str, utime: int) -> Converted:
        self._camera, self._parent = camera, message.parent_frame or _DEFAULT_PARENT
        yield "calibration", cameras.calibration(message, camera, utime)
        if message.has_mount and camera not in self._posed | self._in_tree:
            yield "transform", cameras.mount(message, self._parent, camera, utime)

    def _hands(self, channel: str, message: Any) -> Converted:
        yield "annotations", annotations.of_hands(message)
        yield from self._scene(channel, message, scenes.hands(message, _frame(channel, message)))

    def _objects(self, channel: str, message: Any) -> Converted:
        yield "annotations", annotations.of_objects(message)
        yield from self._scene(channel, message, scenes.things(message, _frame(channel, message)))

    def _gesture_state(self, _: str, message: Any) -> Converted:
        yield "annotations", annotations.of_hypotheses(message)

    def _keypoints(self, _: str, message: Any) -> Converted:
        yield "annotations", annotations.of_keypoints(message)

    def _bodies(self, channel: str, message: Any) -> Converted:
        frame = _frame(channel, message)
        yield from self._scene(channel, message, scenes.bodies(message, message.bodies, frame))

    def _verified(self, channel: str, message: Any) -> Converted:
        poses = [body.pose for body in message.bodies]
        frame = _frame(channel, message)
        yield from self._scene(channel, message, scenes.bodies(message, poses, frame))

    def _skeleton(self, _: str, message: Any) -> Converted:
        yield "scene", SceneUpdate(entities=[skeletons.skeleton(message, self._camera)])

    def _kinect_frame(self, channel: str, message: Any) -> Converted:
        for words in kinect_pictures.unread(message):
            self.left_out[f"{words} on {channel}"] += 1
        if kinect_pictures.has_colour(message):
            yield "image", kinect_pictures.colour(message)
        if kinect_pictures.has_depth(message):
            yield "depth", kinect_pictures.depth(message)

    def _robot_image(self, channel: str, message: Any) -> Converted:
        what = "depth" if robot_pictures.is_depth(message) else "image"
        yield what, robot_pictures.picture(message, message.header.frame_id or channel)

    def _robot_file(self, channel: str, message: Any) -> Converted:
        yield "image", robot_pictures.compressed(message, message.header.frame_id or channel)

    def _robot_lens(self, channel: str, message: Any) -> Converted:
        yield "calibration", robot_frames.lens(message, message.header.frame_id or channel)

    def _robot_transforms(self, channel: str, message: Any) -> Converted:
        if not message.transforms:
            self.left_out[f"TFMessage without transforms on {channel}"] += 1
            return
        transforms = robot_frames.transforms(message)
        self._in_tree.update(part.child_frame_id for part in message.transforms)
        yield "transforms", transforms

    def _scene(self, channel: str, message: Any, entities: list[Any]) -> Converted:
        """The scene, and once more when it has become empty."""
        if entities or channel in self._filled:
            yield "scene", scenes.replace_all(message.utime, entities)
        if entities:
            self._filled.add(channel)
        else:
            self._filled.discard(channel)

    def _gesture(self, _: str, message: Any) -> Converted:
        yield "log", sayings.gesture(message)
        if message.has_ray:
            yield "scene", scenes.ray(message, message.frame or self._camera)

    def _status(self, _: str, message: Any) -> Converted:
        self._published.update(channel.name for channel in message.channels
                               if channel.direction == deixis.channel_status_t.OUT)
        who = (message.service, message.instance, message.host, message.pid)
        if self._states.get(who) != (message.state, message.text):
            self._states[who] = (message.state, message.text)
            yield "log", sayings.status(message)


def _frame(channel: str, message: Any) -> str:
    """The frame of positions; empty is the optical frame of the camera."""
    return str(message.frame or message.camera or channel)
