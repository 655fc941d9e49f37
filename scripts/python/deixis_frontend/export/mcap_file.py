"""An MCAP file with Foxglove's protobuf schemas."""

from __future__ import annotations

from typing import IO, Any

from mcap.writer import Writer
from mcap_protobuf.schema import register_schema


class McapFile:
    """Writes messages; makes the channel of a topic with its first message."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._writer = Writer(stream)
        self._writer.start()
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, tuple[int, str]] = {}
        self._sequences: dict[str, int] = {}
        self.messages = 0

    def write(self, topic: str, message: Any, log_us: int, publish_us: int) -> None:
        """Appends a message; times in microseconds. A topic keeps the type of its first message.

        ValueError if it has another one. `sequence` counts the messages of the topic.
        """
        channel = self._channel(topic, type(message))
        sequence = self._sequences.get(topic, 0)
        self._writer.add_message(channel, log_time=log_us * 1000, publish_time=publish_us * 1000,
                                 data=message.SerializeToString(deterministic=True),
                                 sequence=sequence & 0xFFFFFFFF)
        self._sequences[topic] = sequence + 1
        self.messages += 1

    def finish(self) -> None:
        """Writes the index; the file is complete then."""
        self._writer.finish()

    def _channel(self, topic: str, kind: Any) -> int:
        name = kind.DESCRIPTOR.full_name
        if topic not in self._channels:
            if name not in self._schemas:
                self._schemas[name] = register_schema(self._writer, kind)
            channel = self._writer.register_channel(topic, "protobuf", self._schemas[name])
            self._channels[topic] = (channel, name)
        channel, first = self._channels[topic]
        if first != name:
            raise ValueError(f"{topic} has held {first} before, {name} does not go with it")
        return channel
