"""`deixis export` of what robots send: a Kinect's frames; dimos' pictures, lenses and frames."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bot_core
import deixis
import geometry_msgs
import kinect
import numpy as np
import pytest
import sensor_msgs
import std_msgs
import tf2_msgs
from mcap_messages import Opened, log_of, make, xyz

from deixis_frontend.cli import main

SECONDS, NANOSECONDS = 1_700_000_000, 123_456_789
UTIME = 1_700_000_000_123_456  # of the above, to the microsecond below
JPEG = b"\xff\xd8 a picture \xff\xd9"
PNG = b"\x89PNG\r\n\x1a\n and the rest"
DEPTH = np.arange(12, dtype="<u2").reshape(3, 4) * 500
COLOUR = "/color_image#sensor_msgs.Image"
IDENTITY = [1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0]
K = [500.0, 0, 319.5, 0, 510.0, 239.5, 0, 0, 1.0]
Export = Callable[..., Opened]
Refuse = Callable[[str, Any], str]


@pytest.fixture
def export(tmp_path: Path) -> Export:
    """Exports pairs of channel and message."""
    def run(*pairs: tuple[str, Any]) -> Opened:
        output = tmp_path / "out.mcap"
        log = log_of(tmp_path / "in.lcmlog", *pairs)
        assert main(["export", str(log), "--mcap", str(output)]) == 0
        return Opened(output)

    return run


@pytest.fixture
def refuse(export: Export, capsys: pytest.CaptureFixture[str]) -> Refuse:
    """Exports one message that is to be passed over, a good one behind it; what is said of it."""
    def run(channel: str, message: Any) -> str:
        opened = export((channel, message), ("GOOD", image("mono8", np.zeros((1, 1), "u1"))))
        assert set(opened.messages) == {"/GOOD/image"}
        said = capsys.readouterr().err
        assert "1 messages were passed over, the last: " + channel in said
        return said

    return run


def header(frame: str = "camera_optical", seconds: int = SECONDS) -> Any:
    return make(std_msgs.Header, frame_id=frame,
                stamp=make(std_msgs.Time, sec=seconds, nsec=NANOSECONDS))


def image(encoding: str, pixels: np.ndarray, **fields: Any) -> Any:
    data = fields.pop("data", pixels.tobytes())
    return make(sensor_msgs.Image, **{
        "header": header(), "height": pixels.shape[0], "width": pixels.shape[1],
        "encoding": encoding, "step": pixels.strides[0], "data": data, "data_length": len(data),
        **fields})


def file(name: str, data: bytes) -> Any:
    return make(sensor_msgs.CompressedImage, header=header(), format=name, data=data,
                data_length=len(data))


def lens(**fields: Any) -> Any:
    message = make(sensor_msgs.CameraInfo, **{
        "header": header(), "height": 480, "width": 640, "distortion_model": "plumb_bob",
        "D": [0.1, 0.2, 0.3, 0.4, 0.5], "K": K, "R": IDENTITY, "P": [0.0] * 12, **fields})
    message.D_length = len(message.D)
    return message


def placed(child: str = "head", parent: str = "base_link", **fields: Any) -> Any:
    rotation = {"w": 0.5, "x": 0.5, "y": -0.5, "z": 0.5, **fields}
    place = make(geometry_msgs.Vector3, x=rotation.pop("tx", 1.0), y=2.0, z=3.0)
    return make(geometry_msgs.TransformStamped, header=header(parent), child_frame_id=child,
                transform=make(geometry_msgs.Transform, translation=place,
                               rotation=make(geometry_msgs.Quaternion, **rotation)))


def tree(*transforms: Any) -> Any:
    return make(tf2_msgs.TFMessage, transforms=list(transforms), transforms_length=len(transforms))


def frame(colour: dict[str, Any] | None = None, depth: dict[str, Any] | None = None,
          timestamp: int = UTIME) -> Any:
    """A frame_msg_t, with no picture that is not given."""
    return make(kinect.frame_msg_t, timestamp=timestamp,
                image=kinect_colour(**(colour or {})), depth=kinect_depth(**(depth or {})))


def kinect_colour(pixels: np.ndarray | None = None, **fields: Any) -> Any:
    if pixels is None:
        return make(kinect.image_msg_t, image_data_format=kinect.image_msg_t.VIDEO_NONE, **fields)
    data = pixels.tobytes()
    return make(kinect.image_msg_t, **{
        "timestamp": UTIME + 1, "width": pixels.shape[1], "height": pixels.shape[0],
        "image_data": data, "image_data_nbytes": len(data), **fields})


def kinect_depth(data: bytes | None = None, **fields: Any) -> Any:
    if data is None:
        return make(kinect.depth_msg_t, depth_data_format=kinect.depth_msg_t.DEPTH_NONE, **fields)
    return make(kinect.depth_msg_t, **{
        "timestamp": UTIME + 2, "width": 4, "height": 3, "depth_data": data,
        "depth_data_nbytes": len(data), "depth_data_format": kinect.depth_msg_t.DEPTH_REGISTERED,
        **fields})


def packed(pixels: np.ndarray = DEPTH, **fields: Any) -> dict[str, Any]:
    return {"data": zlib.compress(pixels.tobytes()),
            "compression": kinect.depth_msg_t.COMPRESSION_ZLIB, **fields}


RGB = np.arange(36, dtype="u1").reshape(3, 4, 3)


def test_a_kinects_frame_becomes_a_picture_and_depth(export: Export) -> None:
    opened = export(("KINECT_FRAME", frame({"pixels": RGB}, packed())))
    picture, depth = (opened.only(f"/KINECT_FRAME/{what}") for what in ("image", "depth"))
    assert (picture.width, picture.height, picture.step, picture.encoding) == (4, 3, 12, "rgb8")
    assert (picture.data, picture.frame_id) == (RGB.tobytes(), "kinect")
    assert picture.timestamp.ToMicroseconds() == UTIME + 1
    assert (depth.width, depth.height, depth.step, depth.encoding) == (4, 3, 8, "16UC1")
    assert (depth.data, depth.frame_id) == (DEPTH.tobytes(), "kinect")
    assert depth.timestamp.ToMicroseconds() == UTIME + 2
    assert opened.times["/KINECT_FRAME/depth"][1] == UTIME * 1000


@pytest.mark.parametrize(("number", "shape", "element", "encoding"), [
    (kinect.image_msg_t.VIDEO_BAYER, (4, 4), "u1", "bayer_grbg8"),
    (kinect.image_msg_t.VIDEO_IR_8BIT, (3, 4), "u1", "mono8"),
    (kinect.image_msg_t.VIDEO_IR_10BIT, (3, 4), "<u2", "mono16"),
    (kinect.image_msg_t.VIDEO_YUV_RAW, (3, 4, 2), "u1", "uyvy")])
def test_a_kinects_pixels_stay_as_they_are(export: Export, number: int, shape: tuple[int, ...],
                                           element: str, encoding: str) -> None:
    pixels = np.arange(np.prod(shape)).reshape(shape).astype(element)
    opened = export(("K", frame({"pixels": pixels, "image_data_format": number})))
    picture = opened.only("/K/image")
    assert (picture.encoding, picture.data) == (encoding, pixels.tobytes())
    assert picture.step == pixels.strides[0] and "/K/depth" not in opened.messages


def test_a_kinects_jpeg_stays_as_it_is(export: Export) -> None:
    picture = export(("K", frame({"pixels": np.frombuffer(JPEG, "u1").reshape(1, -1),
                                  "image_data_format": 100}))).only("/K/image")
    assert (picture.format, picture.data, picture.frame_id) == ("jpeg", JPEG, "kinect")


def test_a_kinects_pictures_without_a_time_have_that_of_the_frame(export: Export) -> None:
    opened = export(("K", frame({"pixels": RGB, "timestamp": 0}, packed(timestamp=0))))
    for what in ("image", "depth"):
        assert opened.only(f"/K/{what}").timestamp.ToMicroseconds() == UTIME


def test_a_kinects_frame_without_a_time_has_that_of_its_picture(export: Export) -> None:
    opened = export(("K", frame({"pixels": RGB}, timestamp=0)))
    assert opened.times["/K/image"][1] == (UTIME + 1) * 1000


def test_depth_that_is_not_registered_is_in_a_frame_of_its_own(export: Export) -> None:
    depth = export(("K", frame(depth={"data": DEPTH.tobytes(), "depth_data_format":
                                      kinect.depth_msg_t.DEPTH_MM}))).only("/K/depth")
    assert (depth.data, depth.frame_id) == (DEPTH.tobytes(), "kinect_depth")


def test_a_kinects_own_11_bits_become_millimetres(export: Export) -> None:
    readings = np.array([[0, 600, 1000, 1084], [1092, 2046, 2047, 65535]], "<u2")
    depth = export(("K", frame(depth=packed(
        readings, height=2, depth_data_format=kinect.depth_msg_t.DEPTH_11BIT)))).only("/K/depth")
    # 0.1236 m * tan(raw / 2842.5 + 1.1863); 0 where 16 bits do not hold it, and behind the pole.
    assert np.frombuffer(depth.data, "<u2").tolist() == [305, 706, 3779, 39339, 0, 0, 0, 0]


def test_formats_of_a_kinect_that_nobody_reads_are_counted_and_the_rest_is_there(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    opened = export(("K", frame({"pixels": RGB, "image_data_format": 4}, packed())),
                    ("K", frame({"pixels": RGB}, packed(depth_data_format=3))),
                    ("K", frame()))
    assert len(opened.messages["/K/image"]) == len(opened.messages["/K/depth"]) == 1
    said = capsys.readouterr().out
    for words in ("colour images of format 4", "depth images of format 3",
                  "frame_msg_t without pictures"):
        assert f"left out: 1 of {words} on K" in said


@pytest.mark.parametrize(("message", "fault"), [
    (frame({"pixels": RGB, "height": 4}), "data have 36 bytes, 4 x 4 needs 48"),
    (frame({"pixels": RGB, "width": -4}), "size -4 x 3 is none"),
    (frame({"pixels": RGB, "image_data_format": 100}), "do not begin like a jpeg file"),
    (frame({"pixels": RGB, "timestamp": -1}), "time -1 us is before 1970"),
    (frame({"pixels": RGB}, timestamp=-1), "utime -1 us fits into no MCAP file"),
    (frame(depth=packed(height=2)), "does not unzip to the 16 bytes"),
    (frame(depth=packed(np.zeros((3000, 3000), "<u2"))), "does not unzip to the 24 bytes"),
    (frame(depth=packed(width=32767, height=32767)), "2147352578 bytes is larger"),
    (frame(depth=packed(width=-4, height=-3)), "size -4 x -3 is not positive"),
    (frame(depth=packed(width=0)), "are not positive"),
    (frame(depth=packed(compression=7)), "compression 7 of depth is not known"),
    (frame(depth={"data": b"no zip", "compression": 1}), "depth does not unzip"),
    (frame(depth={"data": DEPTH.tobytes()[1:]}), "data have 23 bytes")])
def test_a_kinects_frame_that_makes_no_sense_is_passed_over(refuse: Refuse, message: Any,
                                                            fault: str) -> None:
    assert fault in refuse("K", message)


@pytest.mark.parametrize(("encoding", "shape", "element"), [
    ("rgb8", (3, 4, 3), "u1"), ("bgr8", (3, 4, 3), "u1"), ("rgba8", (3, 4, 4), "u1"),
    ("mono8", (3, 4), "u1"), ("yuv422", (3, 4, 2), "u1"), ("mono16", (3, 4), "<u2")])
def test_a_robots_pixels_stay_as_they_are(export: Export, encoding: str, shape: tuple[int, ...],
                                          element: str) -> None:
    pixels = np.arange(np.prod(shape)).reshape(shape).astype(element)
    opened = export((COLOUR, image(encoding, pixels)))
    picture = opened.only(f"{COLOUR}/image")
    assert opened.schemas[f"{COLOUR}/image"] == "foxglove.RawImage"
    assert (picture.width, picture.height, picture.encoding) == (4, 3, encoding)
    assert (picture.data, picture.step) == (pixels.tobytes(), pixels.strides[0])
    assert picture.frame_id == "camera_optical"
    assert picture.timestamp.ToMicroseconds() == UTIME
    assert opened.times[f"{COLOUR}/image"][1] == UTIME * 1000


@pytest.mark.parametrize(("encoding", "element"), [("16UC1", "u2"), ("32FC1", "f4")])
@pytest.mark.parametrize("order", "<>")
def test_a_robots_depth_has_its_low_byte_first(export: Export, encoding: str, element: str,
                                               order: str) -> None:
    pixels = (np.arange(12).reshape(3, 4) * 300).astype(order + element)
    rows = np.zeros((3, pixels.strides[0] + 3), "u1")  # three bytes more than a row needs
    rows[:, :-3] = pixels.view("u1").reshape(3, -1)
    depth = export(("DEPTH", image(encoding, pixels, data=rows.tobytes(), step=rows.shape[1],
                                   is_bigendian=int(order == ">")))).only("/DEPTH/depth")
    read = np.ndarray((3, 4), "<" + element, depth.data, strides=(depth.step, pixels.itemsize))
    assert (depth.encoding, depth.step) == (encoding, rows.shape[1])
    assert read.tolist() == pixels.tolist()


def test_what_a_robot_names_no_frame_of_has_that_of_its_channel(export: Export) -> None:
    picture = export(("C", image("mono8", DEPTH.view("u1"), header=header("")))).only("/C/image")
    assert picture.frame_id == "C"


def test_a_step_of_zero_is_that_of_the_width(export: Export) -> None:
    assert export(("C", image("rgb8", RGB, step=0))).only("/C/image").step == 12


@pytest.mark.parametrize(("message", "kind", "data"), [
    (image("jpeg", RGB, data=JPEG), "jpeg", JPEG), (file("jpeg", JPEG), "jpeg", JPEG),
    (file("rgb8; jpeg compressed bgr8", JPEG), "jpeg", JPEG), (file("png", PNG), "png", PNG)])
def test_a_robots_files_stay_as_they_are(export: Export, message: Any, kind: str,
                                         data: bytes) -> None:
    opened = export(("C", message))
    picture = opened.only("/C/image")
    assert opened.schemas["/C/image"] == "foxglove.CompressedImage"
    assert (picture.format, picture.data, picture.frame_id) == (kind, data, "camera_optical")
    assert picture.timestamp.ToMicroseconds() == UTIME


@pytest.mark.parametrize(("message", "fault"), [
    (image("rgb8", RGB, height=4), "data have 36 bytes, 4 x 4 needs 48"),
    (image("rgb8", RGB, step=11), "step 11 is less than 4 pixels of 3 bytes"),
    (image("rgb8", RGB, step=-12), "step -12 is less"),
    (image("rgb8", RGB, width=0), "size 0 x 3 is none"),
    (image("rgb8", RGB, height=-1), "size 4 x -1 is none"),
    (image("rgb8", RGB, width=2**31 - 1, height=2**31 - 1, step=0), "bytes, 2147483647 x"),
    (image("uyvy", RGB, width=3), "size 3 x 3 is none of a picture of uyvy"),
    (image("x" * 1000, RGB), f"encoding '{'x' * 40}' is not known"),
    (image("jpeg", RGB), "do not begin like a jpeg file"),
    (image("32FC1", DEPTH, is_bigendian=1, step=0), "data have 24 bytes"),
    (image("rgb8", RGB, header=header(seconds=-1)), "-1 s and 123456789 ns are no time"),
    (file("jpeg", PNG), "do not begin like a jpeg file"), (file("png", b""), "like a png file"),
    (file("tiff", JPEG), "format 'tiff' is neither JPEG nor PNG")])
def test_a_robots_picture_that_makes_no_sense_is_passed_over(refuse: Refuse, message: Any,
                                                             fault: str) -> None:
    assert fault in refuse("C", message)


def test_a_robots_lens_is_a_calibration(export: Export) -> None:
    projection = [400.0, 0, 300, 0, 0, 410, 200, 0, 0, 0, 1, 0]
    opened = export(("C", lens(P=projection)))
    seen = opened.only("/C/calibration")
    assert opened.schemas["/C/calibration"] == "foxglove.CameraCalibration"
    assert (seen.width, seen.height, seen.frame_id) == (640, 480, "camera_optical")
    assert (seen.distortion_model, list(seen.D)) == ("plumb_bob", [0.1, 0.2, 0.3, 0.4, 0.5])
    assert (list(seen.K), list(seen.R), list(seen.P)) == (K, IDENTITY, projection)
    assert seen.timestamp.ToMicroseconds() == UTIME
    assert opened.times["/C/calibration"][1] == UTIME * 1000


def test_matrices_that_nobody_filled_in_follow_from_k(export: Export) -> None:
    seen = export(("C", lens(R=[0.0] * 9))).only("/C/calibration")
    assert list(seen.R) == IDENTITY
    assert list(seen.P) == [500, 0, 319.5, 0, 0, 510, 239.5, 0, 0, 0, 1, 0]


@pytest.mark.parametrize(("model", "coefficients", "name", "written"), [
    ("", [], "plumb_bob", [0.0] * 5), ("equidistant", [], "plumb_bob", [0.0] * 5),
    ("rational_polynomial", [0.5] * 8, "rational_polynomial", [0.5] * 8),
    ("equidistant", [0.5] * 4, "kannala_brandt", [0.5] * 4)])
def test_a_robots_distortion_has_foxgloves_names(
        export: Export, model: str, coefficients: list[float], name: str,
        written: list[float]) -> None:
    seen = export(("C", lens(distortion_model=model, D=coefficients))).only("/C/calibration")
    assert (seen.distortion_model, list(seen.D)) == (name, written)


@pytest.mark.parametrize(("fields", "fault"), [
    ({"width": -1}, "size -1 x 480 is not positive"),
    ({"distortion_model": "x" * 1000}, f"distortion model '{'x' * 40}' is not known"),
    ({"D": [0.0] * 100_000}, "'plumb_bob' has not 100000 coefficients"),
    ({"D": [float("nan")] * 5}, "D is not finite"),
    ({"K": [0.0] * 9}, "is none of a pinhole camera"),
    ({"K": [float("nan"), *K[1:]]}, "is none of a pinhole camera"),
    ({"K": [*K[:2], float("inf"), *K[3:]]}, "K, R or P is not finite"),
    ({"R": [float("nan")] * 9}, "K, R or P is not finite"),
    ({"binning_x": 2}, "that of another picture"),
    ({"roi": make(sensor_msgs.RegionOfInterest, x_offset=1)}, "that of another picture"),
    ({"header": header(seconds=-1)}, "are no time")])
def test_a_robots_lens_that_makes_no_sense_is_passed_over(refuse: Refuse, fields: dict[str, Any],
                                                          fault: str) -> None:
    assert fault in refuse("C", lens(**fields))


def test_a_robots_transforms_stay_together(export: Export) -> None:
    topic = "/tf#tf2_msgs.TFMessage"
    later = placed("camera_optical", "head")
    later.header.stamp.sec += 1
    opened = export((topic, tree(placed(), later)))
    assert opened.schemas[f"{topic}/transforms"] == "foxglove.FrameTransforms"
    head, camera = opened.only(f"{topic}/transforms").transforms
    assert (head.parent_frame_id, head.child_frame_id) == ("base_link", "head")
    assert (camera.parent_frame_id, camera.child_frame_id) == ("head", "camera_optical")
    assert xyz(head.translation) == (1, 2, 3)
    assert (head.rotation.w, *xyz(head.rotation)) == (0.5, 0.5, -0.5, 0.5)
    assert head.timestamp.ToMicroseconds() == UTIME
    assert camera.timestamp.ToMicroseconds() == UTIME + 1_000_000
    assert opened.times[f"{topic}/transforms"][1] == (UTIME + 1_000_000) * 1000


def test_no_transforms_are_counted(export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    export(("tf", tree()), ("tf", tree(placed())))
    assert "left out: 1 of TFMessage without transforms on tf" in capsys.readouterr().out


@pytest.mark.parametrize(("transform", "fault"), [
    (placed(child=""), "frame '' cannot be in frame 'base_link'"),
    (placed(parent=""), "cannot be in frame ''"),
    (placed(parent="x" * 99, child="x" * 99), f"frame '{'x' * 40}' cannot be"),
    (placed(w=0.6), "is no rotation"), (placed(w=float("nan")), "is no rotation"),
    (placed(tx=float("inf")), "a translation is not finite")])
def test_transforms_that_make_no_sense_are_passed_over(refuse: Refuse, transform: Any,
                                                       fault: str) -> None:
    assert fault in refuse("tf", tree(placed("other"), transform))


def test_more_transforms_than_a_robot_has_are_passed_over(refuse: Refuse) -> None:
    assert "1025 transforms are more than 1024" in refuse("tf", tree(*[placed()] * 1025))


def calibration() -> Any:
    mount = make(deixis.transform_t, rotation_wxyz=(1.0, 0.0, 0.0, 0.0))
    return make(deixis.camera_calibration_t, camera="front", distortion_model="none",
                parent_frame="base_link", has_mount=True, parent_from_camera=mount)


def pose() -> Any:
    return make(bot_core.rigid_transform_t, trans=(4.0, 5.0, 6.0), quat=(1.0, 0.0, 0.0, 0.0))


def status(channel: str, direction: int) -> Any:
    return make(deixis.service_status_t, service="camera_driver", channels=[
        make(deixis.channel_status_t, name=channel, direction=direction)])


def test_a_pose_channel_of_another_name_is_known_by_its_publisher(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    opened = export(("LENS", calibration()), ("ARM", pose()),
                    ("SERVICE_STATUS", status("EYE", deixis.channel_status_t.OUT)),
                    ("OTHER_STATUS", status("ARM", deixis.channel_status_t.IN)),
                    ("ARM", pose()), ("EYE", pose()))
    moved = opened.only("/EYE/transform")
    assert (moved.parent_frame_id, moved.child_frame_id) == ("base_link", "front")
    assert xyz(moved.translation) == (4, 5, 6)
    assert "left out: 2 of rigid_transform_t on ARM" in capsys.readouterr().out


def test_a_camera_in_the_robots_transforms_has_no_second_place(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    opened = export(("tf", tree(placed("front", "head"))), ("LENS", calibration()),
                    ("CAMERA_POSE", pose()))
    assert set(opened.messages) == {"/tf/transforms", "/LENS/calibration"}
    assert ("left out: 1 of poses on CAMERA_POSE of a camera that transforms place"
            in capsys.readouterr().out)
