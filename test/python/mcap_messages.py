"""What the tests of `deixis export` share: messages into a log, and out of an MCAP file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from deixis_lcm import logs

UTIME = 1_700_000_000_123_456
LOG_TIME = UTIME + 5_000


class Opened:
    """The messages of an MCAP file by topic, and their times."""

    def __init__(self, path: Path) -> None:
        self.messages: dict[str, list[Any]] = {}
        self.schemas: dict[str, str] = {}
        self.times: dict[str, tuple[int, int]] = {}
        with path.open("rb") as file:
            reader = make_reader(file, decoder_factories=[DecoderFactory()])
            for schema, channel, message, decoded in reader.iter_decoded_messages():
                self.messages.setdefault(channel.topic, []).append(decoded)
                self.schemas[channel.topic] = schema.name
                self.times[channel.topic] = (message.log_time, message.publish_time)

    def only(self, topic: str) -> Any:
        """The one message of a topic."""
        [message] = self.messages[topic]
        return message


def log_of(path: Path, *pairs: tuple[str, Any]) -> Path:
    with logs.Writer(path) as log:
        for number, (channel, message) in enumerate(pairs):
            log.write(LOG_TIME + 1000 * number, channel, message)
    return path


def make(message_type: type, **fields: Any) -> Any:
    """A message; sets the length of each list that is given, and utime."""
    message = message_type()
    if "utime" in message.__slots__:
        message.utime = UTIME
    for name, value in fields.items():
        assert name in message.__slots__
        setattr(message, name, value)
        if f"n_{name}" in message.__slots__:
            setattr(message, f"n_{name}", len(value))
    return message


def xyz(of: Any) -> tuple[float, float, float]:
    return of.x, of.y, of.z
