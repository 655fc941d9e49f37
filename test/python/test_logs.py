"""deixis_lcm.logs: a log there and back, types told by fingerprint, and broken messages."""
import pytest
from bot_core import image_t
from deixis import candidate_t, gesture_t
from deixis_lcm import images, logs
from kinect import skeleton_msg_t


def gesture(event_id=1):
    message = gesture_t()
    message.event_id, message.name = event_id, "point"
    message.candidates = [candidate_t()]
    message.n_candidates = 1
    return message


def write(path, *events):
    with logs.Writer(path) as log:
        for event in events:
            log.write(*event)
    return path


def test_messages_go_there_and_back(tmp_path):
    picture = images.from_jpeg(b"\xff\xd8\xff\xd9", 640, 480, 9)
    path = write(tmp_path / "a.lcmlog", (1, "GESTURES", gesture(7)), (2, "CAMERA", picture),
                 (2, "SKELETON", skeleton_msg_t()), (3, "OTHER", b"unknown type"))
    events = list(logs.read(path))
    assert [(time, channel) for time, channel, _ in events] == [
        (1, "GESTURES"), (2, "CAMERA"), (2, "SKELETON"), (3, "OTHER")]
    assert isinstance(events[0][2], gesture_t) and events[0][2].event_id == 7
    assert isinstance(events[1][2], image_t) and images.jpeg_bytes(events[1][2]) == b"\xff\xd8\xff\xd9"
    assert isinstance(events[2][2], skeleton_msg_t)
    assert events[3][2] == b"unknown type"


def test_channels_select(tmp_path):
    path = write(tmp_path / "a.lcmlog", (1, "A", gesture(1)), (2, "B", gesture(2)))
    assert [channel for _, channel, _ in logs.read(path, channels={"B"})] == ["B"]


def test_all_types_are_known():
    assert len(logs.types_by_fingerprint()) > 40


@pytest.mark.parametrize("break_it, message", [
    (lambda data: data[:-1], "does not decode"),
    (lambda data: data + b"x", "ends after"),
])
def test_a_message_that_does_not_decode_is_named(tmp_path, break_it, message):
    path = write(tmp_path / "a.lcmlog", (5, "GESTURES", break_it(gesture().encode())))
    with pytest.raises(ValueError, match=f"GESTURES at 5 us: deixis.gesture_t.*{message}"):
        list(logs.read(path))


def test_a_missing_log_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="missing.lcmlog"):
        list(logs.read(tmp_path / "missing.lcmlog"))


def test_no_log_is_written_over(tmp_path):
    path = write(tmp_path / "a.lcmlog", (1, "A", gesture()))
    with pytest.raises(FileExistsError):
        logs.Writer(path)


def test_channel_names_are_checked(tmp_path):
    with logs.Writer(tmp_path / "a.lcmlog") as log, pytest.raises(ValueError, match="1 to 63 bytes"):
        log.write(1, "x" * 64, gesture())
