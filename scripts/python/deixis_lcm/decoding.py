"""Messages from bytes of unknown origin: the type is told by its fingerprint, lengths are held to the bytes there are.

    types = decoding.types_by_fingerprint()
    message = decoding.decode(data, types)

The generated decoders believe every length that a message states; here a lying one ends the decoding at once.
"""
import functools
import importlib
import inspect
import io
import re
import struct

PACKAGES = ("deixis", "bot_core", "kinect", "geometry_msgs", "sensor_msgs", "std_msgs", "tf2_msgs")
FINGERPRINT_BYTES = 8
# The words by which services count what they drop for its bytes (common/messages/wire_check.h says what they mean).
REASONS = ("wrong_type", "truncated", "trailing_bytes", "bad_length", "bad_string", "bad_boolean")
_LOOP = re.compile(r"range\(self\.(\w+)\)")  # how generated code runs over arrays of structs and strings


class DecodeError(ValueError):
    """A message of a known type that does not fit it. `reason` is a word for counting, one of REASONS."""

    def __init__(self, reason, text):
        super().__init__(text)
        self.reason = reason


def types_by_fingerprint(packages=PACKAGES):
    """All generated types: 8 bytes -> class. ImportError if the generated packages are not on the path."""
    types = {}
    for package in packages:
        for value in vars(importlib.import_module(package)).values():
            if isinstance(value, type) and hasattr(value, "_get_packed_fingerprint"):
                types[value._get_packed_fingerprint()] = value
    return types


def type_name(message_type):
    """As in the .lcm file, package and struct: bot_core.image_t."""
    return f"{message_type.__module__.partition('.')[0]}.{message_type.__name__}"


def decode(data, types):
    """The message in `data` (bytes), or None if its fingerprint is not known. DecodeError if the rest does not fit."""
    message_type = types.get(bytes(data[:FINGERPRINT_BYTES]))
    return None if message_type is None else decode_as(message_type, data)


def decode_as(message_type, data):
    """The message of that type in `data` (bytes). DecodeError if it is none."""
    stream = _BoundedBytes(data)
    try:
        message = message_type.decode(stream)
        _require_honest_parts(message)
    except DecodeError as error:
        raise _fault(message_type, data, error.reason, f"does not decode: {error}") from None
    except ValueError:
        raise _fault(message_type, data, "wrong_type", "does not decode: it is of another type") from None
    except (struct.error, IndexError, OverflowError, MemoryError, RecursionError) as error:
        raise _fault(message_type, data, "truncated", f"does not decode: {error}") from None
    if stream.tell() != len(data):
        raise _fault(message_type, data, "trailing_bytes", f"ends after {stream.tell()} of them")
    _require_same_bytes(message, data)
    return message


def _require_same_bytes(message, data):
    """The generated code takes texts that end too early, and booleans that are neither 0 nor 1: DecodeError for them."""
    encoded = message.encode()
    if encoded == bytes(data):
        return
    given, written = next((pair for pair in zip(data, encoded) if pair[0] != pair[1]), (0, 0))
    if written == 1 and given > 1:
        raise _fault(type(message), data, "bad_boolean", f"has a boolean that is {given}")
    raise _fault(type(message), data, "bad_string", "has a text that does not end with its NUL, or is no UTF-8")


class _BoundedBytes(io.BytesIO):
    """Bytes of which no more can be read than are there, and nothing not more often than there are bytes."""

    def __init__(self, data):
        super().__init__(data)
        self._size = self._empty_reads_left = len(data)

    def read(self, size=-1):
        if size < 0:
            raise DecodeError("bad_length", f"a length is {size}")
        left = self._size - self.tell()
        if size > left:
            raise DecodeError("truncated", f"{size} bytes are to follow, {left} are left")
        if size == 0:
            self._empty_reads_left -= 1
            if self._empty_reads_left < 0:
                raise DecodeError("truncated", "more elements than bytes")
        return super().read(size)


def _require_honest_parts(message):
    """DecodeError for what generated code takes: arrays with a length below 0 for empty ones, texts with a NUL inside."""
    for name in _looped_lengths(type(message)):
        if getattr(message, name) < 0:
            raise DecodeError("bad_length", f"{name} is {getattr(message, name)}")
    for name in message.__slots__:
        value = getattr(message, name)
        parts = value if isinstance(value, list) else [value]
        if parts and hasattr(parts[0], "_decode_one"):
            for part in parts:
                _require_honest_parts(part)
        elif parts and isinstance(parts[0], str) and any("\0" in text for text in parts):
            raise DecodeError("bad_string", f"{name} has a NUL inside")


@functools.lru_cache(maxsize=None)
def _looped_lengths(message_type):
    """Names of the lengths of arrays that generated code loops over."""
    return tuple(set(_LOOP.findall(inspect.getsource(message_type._decode_one))))


def _fault(message_type, data, reason, text):
    return DecodeError(reason, f"{type_name(message_type)} of {len(data)} bytes {text}")
