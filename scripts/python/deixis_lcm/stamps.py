"""What a message says of itself: when its picture was taken, which one of its publisher it is, who that is."""
from dataclasses import dataclass

from bot_core import image_t, images_t
from deixis import service_status_t

from deixis_lcm import images


@dataclass(frozen=True)
class Stamp:
    """`utime` is the capture time, microseconds; what a message does not carry is None."""

    utime: int | None
    sequence: int | None
    publisher: str  # of SERVICE_STATUS, on which many speak, each counting its own; else empty


def stamp_of(message):
    """The stamp of a decoded message of any type."""
    return Stamp(getattr(message, "utime", None), _sequence_of(message), _publisher_of(message))


def speaker_of(status):
    """Who sent a service_status_t: service, instance, host and process id."""
    return status.service, status.instance, status.host, status.pid


def _sequence_of(message):
    if isinstance(message, images_t):
        return next(filter(lambda found: found is not None, map(_image_sequence, message.images)), None)
    if isinstance(message, image_t):
        return _image_sequence(message)
    return getattr(message, "sequence", None)


def _image_sequence(image):
    try:
        return images.sequence_of(image)
    except ValueError:
        return None


def _publisher_of(message):
    return " ".join(map(str, speaker_of(message))) if isinstance(message, service_status_t) else ""
