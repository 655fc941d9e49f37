"""`deixis export`: every type of our messages in a log, read again from the MCAP file."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bot_core
import deixis
import kinect
import lcm
import numpy as np
import pytest
from foxglove_schemas_protobuf.Log_pb2 import Log
from mcap_messages import LOG_TIME, UTIME, Opened, log_of, make, xyz

from deixis_frontend.cli import main
from deixis_frontend.export.mcap_file import McapFile
from deixis_lcm import images, logs

JPEG = b"\xff\xd8 a picture \xff\xd9"
DEPTH = np.arange(12, dtype=np.uint16).reshape(3, 4) * 500
Export = Callable[..., Opened]


@pytest.fixture
def export(tmp_path: Path) -> Export:
    """Exports pairs of channel and message; the messages come a millisecond after each other."""
    def run(*pairs: tuple[str, Any]) -> Opened:
        output = tmp_path / "out.mcap"
        assert main(["export", str(log_of(tmp_path / "in.lcmlog", *pairs)), "--mcap",
                     str(output)]) == 0
        assert set(tmp_path.iterdir()) == {tmp_path / "in.lcmlog", output}
        return Opened(output)

    return run


def transform(translation: tuple[float, float, float] = (1.0, 2.0, 3.0)) -> Any:
    return make(deixis.transform_t, translation_m=translation, rotation_wxyz=(0.5, 0.1, 0.2, 0.3))


def calibration(**fields: Any) -> Any:
    return make(deixis.camera_calibration_t, **{
        "camera": "front", "width_px": 640, "height_px": 480, "distortion_model": "plumb_bob",
        "distortion": [0.1, 0.2, 0.3, 0.4, 0.5], "focal_px": (500.0, 510.0),
        "principal_point_px": (319.5, 239.5), "rectification": (1.0, 0, 0, 0, 1, 0, 0, 0, 1),
        "parent_frame": "head", "has_mount": True, "parent_from_camera": transform(), **fields})


def hands(*several: Any, **fields: Any) -> Any:
    return make(deixis.hand_tracks_t, **{"camera": "front", "hands": list(several), **fields})


def hand(**fields: Any) -> Any:
    return make(deixis.hand_t, **{"id": 3, "side": 2, "is_acting": True,
                                  "centre_px": (100.0, 50.0), "box_px": (90.0, 40.0, 20.0, 30.0),
                                  **fields})


def body() -> Any:
    limb = make(deixis.limb_pose_t, proximal_m=(0.0, 0.1, 2.0), distal_m=(0.0, 0.4, 2.1))
    return make(deixis.body_pose_t, person_id=4, state=1, root_in_frame=transform(), limbs=[limb])


def gesture(**fields: Any) -> Any:
    candidate = make(deixis.candidate_t, object_id=7, label="cup", probability=0.875)
    return make(deixis.gesture_t, **{
        "event_id": 9, "person_id": 4, "side": 1, "name": "pointing", "object_id": 7,
        "object_label": "cup", "candidates": [candidate], "has_ray": True, "frame": "front",
        "ray_origin_m": (0.1, 0.2, 2.0), "ray_direction": (0.0, 0.0, -1.0), **fields})


def status(state: int, text: str = "") -> Any:
    return make(deixis.service_status_t, service="hand_tracker", state=state, text=text)


def xy(points: Any) -> list[tuple[float, float]]:
    return [(p.x, p.y) for p in points]


def test_a_jpeg_stays_as_it_is(export: Export) -> None:
    opened = export(("CAMERA", images.from_jpeg(JPEG, 640, 480, UTIME, camera="front")))
    picture = opened.only("/CAMERA/image")
    assert opened.schemas["/CAMERA/image"] == "foxglove.CompressedImage"
    assert (picture.data, picture.format, picture.frame_id) == (JPEG, "jpeg", "front")
    assert picture.timestamp.ToNanoseconds() == UTIME * 1000
    assert opened.times["/CAMERA/image"] == (LOG_TIME * 1000, UTIME * 1000)


@pytest.mark.parametrize(("pixelformat", "shape", "element", "encoding"), [
    (bot_core.image_t.PIXEL_FORMAT_GRAY, (3, 4), "u1", "mono8"),
    (bot_core.image_t.PIXEL_FORMAT_RGB, (3, 4, 3), "u1", "rgb8"),
    (bot_core.image_t.PIXEL_FORMAT_BGR, (3, 4, 3), "u1", "bgr8"),
    (bot_core.image_t.PIXEL_FORMAT_YUYV, (3, 4, 2), "u1", "yuv422_yuy2"),
    (bot_core.image_t.PIXEL_FORMAT_LE_GRAY16, (3, 4), "<u2", "mono16"),
])
def test_raw_pixels_stay_as_they_are(export: Export, pixelformat: int, shape: tuple[int, ...],
                                     element: str, encoding: str) -> None:
    pixels = np.arange(np.prod(shape)).reshape(shape).astype(element)
    raw = export(("CAMERA", images.from_array(pixels, pixelformat, UTIME))).only("/CAMERA/image")
    assert (raw.width, raw.height, raw.encoding) == (4, 3, encoding)
    assert (raw.data, raw.step) == (pixels.tobytes(), pixels.strides[0])
    assert raw.frame_id == "CAMERA"


def test_a_bundle_becomes_its_pictures_and_its_depth(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    left = images.from_jpeg(JPEG, 640, 480, UTIME, camera="left")
    mask = make(bot_core.image_t)
    opened = export(("STEREO", images.bundle(UTIME, [
        (bot_core.images_t.LEFT, left), (bot_core.images_t.MASK_ZIPPED, mask),
        (bot_core.images_t.DEPTH_MM_ZIPPED, images.from_depth_mm(DEPTH, UTIME))])))
    assert opened.only("/STEREO/left").data == JPEG
    depth = opened.only("/STEREO/depth")
    assert (depth.width, depth.height, depth.step, depth.encoding) == (4, 3, 8, "16UC1")
    assert (depth.data, depth.frame_id) == (DEPTH.astype("<u2").tobytes(), "left")
    assert "left out: 1 of images of role 3 on STEREO" in capsys.readouterr().out


def test_depth_that_unzips_to_more_than_it_says_is_passed_over(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    depth = images.from_depth_mm(DEPTH, UTIME)
    depth.data = zlib.compress(bytes(1_000_000))
    depth.size = len(depth.data)
    huge = images.from_depth_mm(DEPTH, UTIME)
    huge.row_stride = huge.height = 1_000_000
    left = (bot_core.images_t.LEFT, images.from_jpeg(JPEG, 640, 480, UTIME))
    opened = export(*(("STEREO", images.bundle(
        UTIME, [left, (bot_core.images_t.DEPTH_MM_ZIPPED, image)])) for image in (depth, huge)))
    assert len(opened.messages["/STEREO/left"]) == 2 and "/STEREO/depth" not in opened.messages
    said = capsys.readouterr().err
    assert "2 messages were passed over" in said and "1000000000000 bytes is larger" in said


def test_calibrations_say_how_a_camera_sees_and_where_it_is(export: Export) -> None:
    opened = export(("CAMERA_CALIBRATION", calibration()))
    seen = opened.only("/CAMERA_CALIBRATION/calibration")
    assert opened.schemas["/CAMERA_CALIBRATION/calibration"] == "foxglove.CameraCalibration"
    assert (seen.width, seen.height, seen.frame_id) == (640, 480, "front")
    assert (seen.distortion_model, list(seen.D)) == ("plumb_bob", [0.1, 0.2, 0.3, 0.4, 0.5])
    assert list(seen.K) == [500, 0, 319.5, 0, 510, 239.5, 0, 0, 1]
    assert list(seen.R) == [1, 0, 0, 0, 1, 0, 0, 0, 1]
    assert list(seen.P) == [500, 0, 319.5, 0, 0, 510, 239.5, 0, 0, 0, 1, 0]
    mount = opened.only("/CAMERA_CALIBRATION/transform")
    assert (mount.parent_frame_id, mount.child_frame_id) == ("head", "front")
    assert xyz(mount.translation) == (1, 2, 3)
    assert (mount.rotation.w, *xyz(mount.rotation)) == (0.5, 0.1, 0.2, 0.3)


@pytest.mark.parametrize(("model", "coefficients", "name", "written"), [
    ("none", [], "plumb_bob", [0.0] * 5), ("rational", [0.5] * 8, "rational_polynomial", [0.5] * 8),
    ("fisheye", [0.5] * 4, "kannala_brandt", [0.5] * 4)])
def test_distortion_has_foxgloves_names(export: Export, model: str, coefficients: list[float],
                                        name: str, written: list[float]) -> None:
    seen = export(("C", calibration(distortion_model=model, distortion=coefficients,
                                    has_mount=False))).only("/C/calibration")
    assert (seen.distortion_model, list(seen.D)) == (name, written)


def test_a_stereo_calibration_gives_the_rectified_camera(export: Export) -> None:
    rectified = calibration(camera="", distortion_model="none", distortion=[], focal_px=(400, 400))
    stereo = make(deixis.stereo_calibration_t, camera="left", left=calibration(),
                  right=calibration(), rectified=rectified, right_from_left=transform())
    opened = export(("STEREO_CALIBRATION", stereo))
    seen = opened.only("/STEREO_CALIBRATION/calibration")
    assert (seen.frame_id, seen.K[0]) == ("left", 400)
    assert opened.only("/STEREO_CALIBRATION/transform").child_frame_id == "left"


def test_a_camera_pose_goes_before_the_mount(export: Export) -> None:
    pose = make(bot_core.rigid_transform_t, trans=(4.0, 5.0, 6.0), quat=(1.0, 0.0, 0.0, 0.0))
    opened = export(("CAMERA_CALIBRATION", calibration()), ("robot/CAMERA_POSE", pose),
                    ("CAMERA_CALIBRATION", calibration()))
    moved = opened.only("/robot/CAMERA_POSE/transform")
    assert opened.schemas["/robot/CAMERA_POSE/transform"] == "foxglove.FrameTransform"
    assert (moved.parent_frame_id, moved.child_frame_id) == ("head", "front")
    assert xyz(moved.translation) == (4, 5, 6) and moved.rotation.w == 1
    assert len(opened.messages["/CAMERA_CALIBRATION/calibration"]) == 2
    assert len(opened.messages["/CAMERA_CALIBRATION/transform"]) == 1


def test_hands_are_drawn_into_the_picture(export: Export) -> None:
    opened = export(("HAND_TRACKS", hands(hand(has_fingertip=True, fingertip_px=(110.0, 41.0)))))
    drawn = opened.only("/HAND_TRACKS/annotations")
    assert opened.schemas["/HAND_TRACKS/annotations"] == "foxglove.ImageAnnotations"
    assert drawn.timestamp.ToNanoseconds() == UTIME * 1000
    assert xy(drawn.points[0].points) == [(90.5, 40.5), (110.5, 40.5), (110.5, 70.5), (90.5, 70.5)]
    assert xy(circle.position for circle in drawn.circles) == [(100.5, 50.5), (110.5, 41.5)]
    assert drawn.texts[0].text == "right hand 3"
    assert "/HAND_TRACKS/scene" not in opened.messages


def test_hands_with_a_position_are_in_the_scene_till_they_are_gone(export: Export) -> None:
    opened = export(("HAND_TRACKS", hands(hand(has_position=True, position_m=(0.1, 0.2, 2.0)))),
                    ("HAND_TRACKS", hands()), ("HAND_TRACKS", hands()))
    there, gone = opened.messages["/HAND_TRACKS/scene"]
    [entity] = there.entities
    assert (entity.id, entity.frame_id) == ("hand 3", "front")
    assert xyz(entity.spheres[0].pose.position) == (0.1, 0.2, 2.0)
    assert entity.spheres[0].pose.orientation.w == 1
    assert entity.texts[0].text == "right hand 3"
    assert not gone.entities and gone.deletions[0].type == gone.deletions[0].ALL


def test_objects_are_boxes_in_the_picture_and_cubes_in_the_scene(export: Export) -> None:
    cup = make(deixis.object_t, id=7, label="cup", has_box=True, box_px=(10.0, 20.0, 4.0, 5.0),
               has_position=True, position_m=(0.0, 0.5, 1.5), extent_m=(0.1, 0.2, 0.3))
    ball = make(deixis.object_t, id=8, has_position=True, position_m=(1.0, 0.5, 1.5),
                visibility=deixis.object_t.OCCLUDED, kind=deixis.object_t.OBJECT)
    opened = export(("OBJECTS", make(deixis.objects_t, camera="front", frame="room",
                                     objects=[cup, ball])))
    drawn = opened.only("/OBJECTS/annotations")
    assert xy(drawn.points[0].points)[0] == (10.5, 20.5) and len(drawn.points) == 1
    cup_entity, ball_entity = opened.only("/OBJECTS/scene").entities
    assert (cup_entity.id, cup_entity.frame_id) == ("object 7", "room")
    assert xyz(cup_entity.cubes[0].size) == (0.1, 0.2, 0.3)
    assert cup_entity.texts[0].text == "cup 7"
    assert xyz(ball_entity.spheres[0].pose.position) == (1.0, 0.5, 1.5)
    assert ball_entity.texts[0].text == "object 8"
    assert cup_entity.cubes[0].color.a == 1.0 and ball_entity.spheres[0].color.a == 0.5


def test_the_area_of_a_hypothesis_is_drawn(export: Export) -> None:
    hypothesis = make(deixis.gesture_hypothesis_t, model="approach", phase=0.5, has_context=True,
                      context_centre_px=(100.0, 100.0), context_radius_px=10.0,
                      context_start_rad=0.0, context_end_rad=np.pi / 2)
    drawn = export(("GESTURE_STATE", make(deixis.gesture_state_t, hypotheses=[hypothesis]))).only(
        "/GESTURE_STATE/annotations")
    outline = xy(drawn.points[0].points)
    assert outline[0] == (100.5, 100.5) and outline[1] == (110.5, 100.5)
    assert outline[-1] == pytest.approx((100.5, 110.5))
    assert drawn.texts[0].text == "approach 0.50"


@pytest.mark.parametrize("is_verified", [False, True])
def test_bodies_are_lines_between_joints(export: Export, is_verified: bool) -> None:
    if is_verified:
        people = make(deixis.verified_poses_t, camera="front",
                      bodies=[make(deixis.verified_body_t, pose=body())])
    else:
        people = make(deixis.body_poses_t, camera="front", bodies=[body()])
    [entity] = export(("POSES", people)).only("/POSES/scene").entities
    assert (entity.id, entity.frame_id) == ("person 4", "front")
    assert [xyz(p) for p in entity.lines[0].points] == [(0.0, 0.1, 2.0), (0.0, 0.4, 2.1)]
    assert xyz(entity.spheres[0].pose.position) == (0.0, 0.1, 2.0)
    assert xyz(entity.texts[0].pose.position) == (1, 2, 3)


def test_keypoints_and_skeletons_are_drawn(export: Export) -> None:
    found = make(deixis.keypoint_t, name="nose", point_px=(5.0, 6.0))
    people = make(deixis.keypoints_t, people=[make(deixis.person_keypoints_t, points=[found])])
    link = make(kinect.link_msg_t, source=make(kinect.point3d_t, x=1.0),
                dest=make(kinect.point3d_t, z=2.0))
    skeleton = make(kinect.skeleton_msg_t, user_id=2, links=[link], num_links=1)
    opened = export(("CAMERA_CALIBRATION", calibration()), ("KEYPOINTS", people),
                    ("SKELETON", skeleton))
    assert xy(opened.only("/KEYPOINTS/annotations").points[0].points) == [(5.5, 6.5)]
    [entity] = opened.only("/SKELETON/scene").entities
    assert (entity.id, entity.frame_id, entity.lifetime.seconds) == ("person 2", "front", 1)
    assert [xyz(p) for p in entity.lines[0].points] == [(1, 0, 0), (0, 0, 2)]


def test_a_gesture_is_said_and_its_ray_drawn_till_it_ends(export: Export) -> None:
    opened = export(("GESTURES", gesture()), ("GESTURES", gesture(end_utime=UTIME + 1)))
    begun, ended = opened.messages["/GESTURES/log"]
    assert opened.schemas["/GESTURES/log"] == "foxglove.Log"
    assert begun.message == "person 4, left hand: pointing at cup 7 (0.88)"
    assert (begun.level, begun.name) == (begun.INFO, "gesture 9")
    assert ended.message == "person 4, left hand: pointing at cup 7: ended"
    drawn, deleted = opened.messages["/GESTURES/scene"]
    assert drawn.entities[0].id == deleted.deletions[0].id == "gesture 9"
    assert [xyz(p) for p in drawn.entities[0].lines[0].points] == [(0.1, 0.2, 2), (0.1, 0.2, -3)]
    assert deleted.deletions[0].type == deleted.deletions[0].MATCHING_ID


@pytest.mark.parametrize(("outcome", "words"), [
    (1, "somebody, hand: pointing at no known object"),
    (2, "somebody, hand: pointing at several objects")])
def test_a_gesture_without_an_object_says_so(export: Export, outcome: int, words: str) -> None:
    opened = export(("GESTURES", gesture(outcome=outcome, person_id=-1, side=0, has_ray=False,
                                         candidates=[])))
    assert opened.only("/GESTURES/log").message == words
    assert "/GESTURES/scene" not in opened.messages


def test_states_of_services_are_said_when_they_change(export: Export) -> None:
    texts = [(1, ""), (1, ""), (2, "no pictures"), (2, "no pictures"), (1, "")]
    said = export(*(("SERVICE_STATUS", status(*text)) for text in texts)).messages[
        "/SERVICE_STATUS/log"]
    assert [log.message for log in said] == ["running", "degraded: no pictures", "running"]
    assert [log.level for log in said] == [Log.INFO, Log.WARNING, Log.INFO]
    assert said[0].name == "hand_tracker"


def test_what_is_left_out_is_counted(export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    export(("SERVICE_STATUS", status(1)), ("OTHER", b"unknown type"), ("OTHER", b"again some"),
           ("PERSON_IDENTITY", make(deixis.person_identity_t)),
           ("BASE_POSE", make(bot_core.rigid_transform_t)))
    said = capsys.readouterr().out
    assert "wrote 1 messages" in said
    for words in ("2 of an unknown type on OTHER", "1 of person_identity_t on PERSON_IDENTITY",
                  "1 of rigid_transform_t on BASE_POSE"):
        assert f"left out: {words}" in said


def test_the_same_log_gives_the_same_bytes(tmp_path: Path) -> None:
    log = log_of(tmp_path / "in.lcmlog", ("CAMERA", images.from_jpeg(JPEG, 640, 480, UTIME)),
                 ("HAND_TRACKS", hands(hand())), ("GESTURES", gesture()))
    runs = []
    for number, seed in enumerate(("1", "2")):
        output = tmp_path / f"{number}.mcap"
        subprocess.run([sys.executable, "-m", "deixis_frontend", "export", log, "--mcap", output],
                       env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path),
                            "PYTHONHASHSEED": seed}, check=True, timeout=60)
        runs.append(output.read_bytes())
    assert runs[0] == runs[1] and len(Opened(tmp_path / "0.mcap").messages) == 4


def test_channels_are_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = log_of(tmp_path / "in.lcmlog", ("A", status(1)), ("B", status(1)))
    output = tmp_path / "out.mcap"
    assert main(["export", str(log), "--mcap", str(output), "--channels", "B|C"]) == 0
    assert set(Opened(output).messages) == {"/B/log"}
    assert main(["export", str(log), "--mcap", str(output), "--force", "--channels", "C"]) == 1
    assert "no channel is 'C'" in capsys.readouterr().err and "/B/log" in Opened(output).messages


def test_nothing_is_replaced_without_force(tmp_path: Path,
                                           capsys: pytest.CaptureFixture[str]) -> None:
    log = log_of(tmp_path / "in.lcmlog", ("A", status(1)))
    output = tmp_path / "out.mcap"
    output.write_text("old", encoding="ascii")
    assert main(["export", str(log), "--mcap", str(output)]) == 1
    assert "is there already: name another --mcap, or give --force" in capsys.readouterr().err
    assert output.read_text(encoding="ascii") == "old"
    assert main(["export", str(log), "--mcap", str(output), "--force"]) == 0
    assert set(Opened(output).messages) == {"/A/log"}
    assert main(["export", str(log), "--mcap", str(log), "--force"]) == 1
    assert "are the same file" in capsys.readouterr().err


def test_damage_is_passed_over_and_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = log_of(tmp_path / "in.lcmlog", *(("A", status(1, str(number))) for number in range(9)),
                 ("A", status(1, "x").encode()[:-1]))
    data = log.read_bytes()
    size = 28 + 1 + len(status(1, "0").encode())
    log.write_bytes(data[:3 * size] + b"noise" * 100 + data[3 * size:])
    output = tmp_path / "out.mcap"
    assert main(["export", str(log), "--mcap", str(output)]) == 0
    said = capsys.readouterr().err
    assert f"{500 + size} bytes are damaged and were passed over" in said
    assert "1 messages were passed over" in said and "does not decode" in said
    texts = [log.message for log in Opened(output).messages["/A/log"]]
    assert texts == [f"running: {number}" for number in (0, 1, 3, 4, 5, 6, 7, 8)]


def test_times_that_cannot_be_are_passed_over(tmp_path: Path,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "in.lcmlog"
    file = lcm.EventLog(str(path), "w")
    early = status(1)
    early.utime = -1
    for time_us, message in ((-5, status(1)), (1, early), (2, status(2))):
        file.write_event(time_us, "A", message.encode())
    file.close()
    assert main(["export", str(path), "--mcap", str(tmp_path / "out.mcap")]) == 0
    assert "2 messages were passed over" in capsys.readouterr().err
    assert Opened(tmp_path / "out.mcap").only("/A/log").message == "degraded"


def test_utimes_that_fit_into_no_file_are_passed_over(
        export: Export, capsys: pytest.CaptureFixture[str]) -> None:
    late = status(1)
    late.utime = 200_000_000_000_000_000  # of the year 8307: too many nanoseconds for 64 bits
    bundle = images.bundle(-5, [(bot_core.images_t.LEFT, images.from_jpeg(JPEG, 640, 480, UTIME))])
    opened = export(("A", late), ("STEREO", bundle), ("A", status(2)))
    assert opened.only("/A/log").message == "degraded" and list(opened.messages) == ["/A/log"]
    said = capsys.readouterr().err
    assert "2 messages were passed over" in said and "STEREO" in said and "utime -5 us" in said


@pytest.mark.parametrize(("content", "fault"), [
    (None, "No such file or directory"), (b"", "is empty"), (b"hello", "is no LCM log"),
    (b"\xed\xa1\xda\x01", "holds no whole message")])
def test_what_is_no_log_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str],
                                   content: bytes | None, fault: str) -> None:
    log = tmp_path / "in.lcmlog"
    if content is not None:
        log.write_bytes(content)
    assert main(["export", str(log), "--mcap", str(tmp_path / "out.mcap")]) == 1
    assert fault in capsys.readouterr().err
    assert not list(tmp_path.glob("out*"))


def test_the_self_test_of_lcm_is_left_out_in_silence(tmp_path: Path,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    log = log_of(tmp_path / "in.lcmlog", ("LCM_SELF_TEST", b"lcm self test"),
                 ("SERVICE_STATUS", status(1)))
    assert main(["export", str(log), "--mcap", str(tmp_path / "out.mcap")]) == 0
    assert main(["export", str(log), "--mcap", str(tmp_path / "no.mcap"), "--channels", "NO"]) == 1
    said = capsys.readouterr()
    assert "left out" not in said.out and "SELF_TEST" not in said.out + said.err


def test_a_log_with_nothing_to_show_is_no_success(tmp_path: Path,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    log = log_of(tmp_path / "in.lcmlog", ("OTHER", b"unknown type"))
    assert main(["export", str(log), "--mcap", str(tmp_path / "out.mcap")]) == 1
    assert "has nothing to show, only an unknown type on OTHER" in capsys.readouterr().err
    assert not list(tmp_path.glob("out*"))


def test_a_file_that_grows_too_large_is_told_and_leaves_nothing_behind(tmp_path: Path) -> None:
    picture = images.from_jpeg(JPEG + os.urandom(1_000_000), 640, 480, UTIME)
    log = log_of(tmp_path / "in.lcmlog", *[("CAMERA", picture)] * 4)
    done = subprocess.run(
        ["sh", "-c", 'ulimit -f 2000; trap "" XFSZ; exec "$@"', "-", sys.executable, "-m",
         "deixis_frontend", "export", log, "--mcap", tmp_path / "out.mcap"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, check=False, timeout=60,
        capture_output=True, text=True)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "out.mcap was not written: File too large" in done.stderr
    assert not list(tmp_path.glob("out*"))


def test_a_full_disk_is_told_and_keeps_what_there_was(tmp_path: Path,
                                                      monkeypatch: pytest.MonkeyPatch,
                                                      capsys: pytest.CaptureFixture[str]) -> None:
    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(McapFile, "finish", fail)
    log = log_of(tmp_path / "in.lcmlog", ("A", status(1)))
    output = tmp_path / "out.mcap"
    output.write_text("old", encoding="ascii")
    assert main(["export", str(log), "--mcap", str(output), "--force"]) == 1
    assert "the disk is full: make room" in capsys.readouterr().err
    assert set(tmp_path.iterdir()) == {log, output}
    assert output.read_text(encoding="ascii") == "old"


def test_an_interrupted_export_leaves_nothing_behind(tmp_path: Path,
                                                     monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(McapFile, "finish", interrupt)
    before = signal.getsignal(signal.SIGINT)
    log = log_of(tmp_path / "in.lcmlog", ("A", status(1)))
    assert main(["export", str(log), "--mcap", str(tmp_path / "out.mcap")]) == 130
    signal.signal(signal.SIGINT, before)
    assert list(tmp_path.iterdir()) == [log]
