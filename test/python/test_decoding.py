"""deixis_lcm.decoding: types told by fingerprint; whatever the bytes are, an answer at once."""

from __future__ import annotations

import importlib
import random
import struct
from typing import Any

import pytest
from bot_core import image_t, images_t
from deixis import candidate_t, gesture_t, object_t, service_status_t
from deixis_lcm import decoding, images, stamps
from kinect import skeleton_msg_t

TYPES = decoding.types_by_fingerprint()


def gesture() -> gesture_t:
    message = gesture_t()
    message.utime, message.sequence, message.name = 7, 3, "pointing"
    message.candidates = [candidate_t(), candidate_t()]
    message.n_candidates = 2
    return message


def test_all_types_are_known_by_name() -> None:
    names = {decoding.type_name(message_type) for message_type in TYPES.values()}
    assert len(names) > 40 and {"deixis.gesture_t", "bot_core.image_t"} < names


def test_a_message_of_a_known_type_is_decoded_and_no_other() -> None:
    assert decoding.decode(gesture().encode(), TYPES).name == "pointing"
    assert decoding.decode(b"unknown type", TYPES) is None
    assert decoding.decode(b"", TYPES) is None


def with_length(message: Any, value: int, length: int) -> bytes:
    """The bytes with the only int32 that is `value` replaced."""
    data = message.encode()
    assert data.count(struct.pack(">i", value)) == 1
    return data.replace(struct.pack(">i", value), struct.pack(">i", length))


def skeleton() -> skeleton_msg_t:
    message = skeleton_msg_t()
    message.user_id = 77
    return message


def picture() -> image_t:
    return images.from_jpeg(b"\xff\xd8" + bytes(1234), 640, 480, 9, sequence=5)


def pictures() -> images_t:
    return images.bundle(9, [(images_t.LEFT, picture()), (images_t.RIGHT, picture())])


@pytest.mark.parametrize("length", [-1, -2**31, 2**30, 2**31 - 1])
def test_a_lying_length_is_found_out_at_once(length: int) -> None:
    structs = with_length(gesture(), 2, length)
    blob = with_length(picture(), 1236, length)
    numbers = pictures().encode()[:16] + struct.pack(">i", length) + pictures().encode()[20:]
    text = gesture().encode().replace(struct.pack(">i", 9) + b"pointing",
                                      struct.pack(">i", length) + b"pointing")
    for data in (structs, blob, numbers, text):
        with pytest.raises(decoding.DecodeError) as error:
            decoding.decode(data, TYPES)
        assert error.value.reason in ("truncated", "bad_length")


def test_a_length_below_zero_before_structs_is_no_empty_list() -> None:
    data = skeleton().encode()
    data = data[:16] + struct.pack(">i", -5) + data[20:]
    assert skeleton_msg_t.decode(data).links == []
    with pytest.raises(decoding.DecodeError, match="num_links is -5") as error:
        decoding.decode(data, TYPES)
    assert error.value.reason == "bad_length"


@pytest.mark.parametrize(("change", "reason"), [
    (lambda data: data[:-1], "truncated"), (lambda data: data[:9], "truncated"),
    (lambda data: data + b"x", "trailing_bytes"),
    (lambda data: data.replace(b"pointing\0", b"pointing!"), "bad_string"),
    (lambda data: data.replace(b"pointing\0", b"point\0ng\0"), "bad_string"),
    (lambda data: data.replace(b"pointing\0", b"point\xffng\0"), "bad_string"),
    (lambda data: data.replace(b"\0\0\0\x09pointing\0", b"\0\0\0\0"), "bad_string")])
def test_the_reason_is_a_word_for_counting(change: Any, reason: str) -> None:
    with pytest.raises(decoding.DecodeError, match="deixis.gesture_t of") as error:
        decoding.decode(change(gesture().encode()), TYPES)
    assert error.value.reason == reason


def test_a_boolean_that_is_neither_yes_nor_no_is_told() -> None:
    message = object_t()
    without = message.encode()
    message.has_box = True
    data = message.encode()
    [at] = [place for place, pair in enumerate(zip(without, data)) if pair[0] != pair[1]]
    for damaged in (data[:at] + b"\2" + data[at + 1:], data[:at] + b"\xff" + data[at + 1:]):
        with pytest.raises(decoding.DecodeError, match="has a boolean that is") as error:
            decoding.decode(damaged, TYPES)
        assert error.value.reason == "bad_boolean"


def test_another_type_than_the_one_asked_for_is_told() -> None:
    with pytest.raises(decoding.DecodeError) as error:
        decoding.decode_as(service_status_t, gesture().encode())
    assert error.value.reason == "wrong_type"


@pytest.mark.parametrize("name", sorted(decoding.type_name(t) for t in TYPES.values()))
def test_noise_gives_a_message_or_an_error(name: str) -> None:
    package, struct_name = name.split(".")
    message_type = getattr(importlib.import_module(package), struct_name)
    noise = random.Random(1)
    for _ in range(50):
        data = bytes(noise.choice((0, 0, 0, 1, 2, 127, 255)) for _ in range(noise.randrange(400)))
        try:
            decoding.decode(message_type._get_packed_fingerprint() + data, TYPES)
        except decoding.DecodeError:
            continue


def test_stamps_of_messages_and_of_pictures() -> None:
    assert stamps.stamp_of(gesture()) == stamps.Stamp(7, 3, "")
    assert stamps.stamp_of(picture()) == stamps.Stamp(9, 5, "")
    assert stamps.stamp_of(pictures()) == stamps.Stamp(9, 5, "")
    assert stamps.stamp_of(skeleton()) == stamps.Stamp(0, None, "")


def test_each_speaker_on_the_status_channel_counts_its_own() -> None:
    one, other = service_status_t(), service_status_t()
    one.pid, other.pid = 1, 2
    assert stamps.stamp_of(one).publisher != stamps.stamp_of(other).publisher
