"""deixis_lcm.logs: a log there and back, types told by fingerprint, and broken messages."""
import io

import pytest
from bot_core import image_t
from deixis import candidate_t, gesture_t
from deixis_lcm import images, log_events, logs
from kinect import skeleton_msg_t


def gesture(event_id=1):
    message = gesture_t()
    message.event_id, message.name = event_id, "pointing"
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


@pytest.mark.parametrize("break_it, message", [
    (lambda data: data[:-1], "does not decode"),
    (lambda data: data + b"x", "ends after"),
])
def test_a_message_that_does_not_decode_is_named_in_the_end(tmp_path, break_it, message):
    path = write(tmp_path / "a.lcmlog", (5, "GESTURES", break_it(gesture().encode())))
    with pytest.warns(UserWarning, match=f"GESTURES at 5 us: deixis.gesture_t.*{message}"):
        assert not list(logs.read(path))


def test_a_missing_log_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="missing.lcmlog"):
        list(logs.read(tmp_path / "missing.lcmlog"))


def ten_gestures(path):
    return write(path, *((number, "GESTURES", gesture(number)) for number in range(10)))


def numbers(path):
    return [time for time, _, _ in logs.read(path)]


def test_reading_goes_on_behind_noise(tmp_path):
    path = ten_gestures(tmp_path / "a.lcmlog")
    data, size = path.read_bytes(), path.stat().st_size // 10
    path.write_bytes(data[:3 * size] + bytes(5000) + data[5 * size:])
    with pytest.warns(UserWarning, match=f"7 messages were read; {5000 + size} bytes are damaged"):
        assert numbers(path) == [0, 1, 5, 6, 7, 8, 9]  # The noise may lie within 2.


def test_a_message_that_does_not_decode_is_passed_over(tmp_path):
    path = ten_gestures(tmp_path / "a.lcmlog")
    data, size = bytearray(path.read_bytes()), path.stat().st_size // 10
    inside = data.index(b"GESTURES", 3 * size) + len("GESTURES")
    data[inside + 8:4 * size] = b"\xff" * (4 * size - inside - 8)
    path.write_bytes(data)
    with pytest.warns(UserWarning, match="1 messages do not decode, the last: GESTURES at 3 us"):
        assert numbers(path) == [0, 1, 2, 4, 5, 6, 7, 8, 9]


def test_a_damaged_length_does_not_swallow_what_follows(tmp_path):
    path = ten_gestures(tmp_path / "a.lcmlog")
    data, size = bytearray(path.read_bytes()), path.stat().st_size // 10
    data[2 * size + 24:2 * size + 28] = (3 * size).to_bytes(4, "big")
    path.write_bytes(data)
    with pytest.warns(UserWarning, match=f"9 messages were read; {size} bytes are damaged"):
        assert numbers(path) == [0, 1, 3, 4, 5, 6, 7, 8, 9]


@pytest.mark.parametrize("missing", [1, 100])
def test_a_log_that_ends_in_a_message_is_read_up_to_it(tmp_path, missing):
    path = ten_gestures(tmp_path / "a.lcmlog")
    path.write_bytes(path.read_bytes()[:-missing])
    with pytest.warns(UserWarning, match="9 messages were read; it ends in the middle of a message"):
        assert numbers(path) == list(range(9))


def test_an_end_within_the_header_is_told(tmp_path):
    path = ten_gestures(tmp_path / "a.lcmlog")
    size = path.stat().st_size // 10
    path.write_bytes(path.read_bytes()[:9 * size + 2])
    with pytest.warns(UserWarning, match="9 messages were read; it ends in the middle of a message"):
        assert numbers(path) == list(range(9))


@pytest.mark.parametrize("content", [b"hello", bytes(3_000_000), b"\xed\xa1\xda\x01" * 20])
def test_what_is_no_log_is_an_error(tmp_path, content):
    path = tmp_path / "a.lcmlog"
    path.write_bytes(content)
    with pytest.raises(ValueError, match="a.lcmlog is no LCM log"):
        list(logs.read(path))


def test_what_was_read_to_find_an_event_is_not_read_for_each_sync_word(tmp_path, monkeypatch):
    path = ten_gestures(tmp_path / "a.lcmlog")
    path.write_bytes(log_events.SYNC * 10_000 + path.read_bytes())
    read_bytes = []

    class Counting(io.FileIO):
        def read(self, size=-1):
            read_bytes.append(size)
            return super().read(size)

    monkeypatch.setattr(log_events, "open", Counting, raising=False)
    with pytest.warns(UserWarning, match="10 messages were read; 40000 bytes are damaged"):
        assert numbers(path) == list(range(10))
    assert sum(read_bytes) < 100 * path.stat().st_size  # Else it is 10,000 times a chunk.


@pytest.mark.parametrize("before", range(5))
def test_a_sync_word_across_the_chunks_that_are_read_is_found(tmp_path, before):
    path = ten_gestures(tmp_path / "a.lcmlog")
    noise = (1 << 20) + 1 - before
    path.write_bytes(b"x" * noise + path.read_bytes())
    with pytest.warns(UserWarning, match=f"10 messages were read; {noise} bytes are damaged"):
        assert numbers(path) == list(range(10))


def test_no_log_is_written_over(tmp_path):
    path = write(tmp_path / "a.lcmlog", (1, "A", gesture()))
    with pytest.raises(FileExistsError):
        logs.Writer(path)


def test_channel_names_are_checked(tmp_path):
    with logs.Writer(tmp_path / "a.lcmlog") as log, pytest.raises(ValueError, match="1 to 63 bytes"):
        log.write(1, "x" * 64, gesture())
