"""The events of an LCM log file as they stand there, past damage.

An event is a header (sync word, number, time, lengths), the channel and the data. Where no event begins, the
reader goes on at the next sync word that begins one, and counts what it passed over.
"""
import os
import struct
from dataclasses import dataclass

SYNC = b"\xed\xa1\xda\x01"
_HEADER = struct.Struct(">4sqqii")  # sync, number, log time in microseconds, lengths of channel and data
_LONGEST_CHANNEL = 255  # LCM's own limit is 63
_CHUNK_BYTES = 1 << 20


@dataclass(frozen=True)
class Event:
    """One event: where it begins, when the logger received it, and where its data are."""

    offset: int
    time_us: int
    channel: str
    data_offset: int
    data_length: int

    @property
    def end(self):
        """Offset of the byte behind it."""
        return self.data_offset + self.data_length


class EventReader:
    """Iterates over the events of a file; a context manager. OSError if it cannot be read.

    `damaged_bytes` tells how many bytes so far belong to no event; `is_cut_off` is true once the file turned out
    to end in the middle of one.
    """

    def __init__(self, path):
        self._file = open(path, "rb")
        self._size = os.fstat(self._file.fileno()).st_size
        self.damaged_bytes = 0
        self.is_cut_off = False
        self._chunk_offset, self._chunk = 0, b""  # what was read last in search of a sync word

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()

    def __iter__(self):
        offset = 0
        while offset < self._size:
            event = self._event_at(offset)
            following = offset + 1 if event is None else event.end
            if event is not None and self._begins_well(following):
                yield event
                offset = following
                continue
            offset = self._past_damage(offset)

    def data(self, event):
        """The bytes of a message."""
        self._file.seek(event.data_offset)
        return self._file.read(event.data_length)

    def damage(self):
        """What is wrong with the file as far as it was read, in words; empty when nothing is."""
        parts = []
        if self.damaged_bytes:
            parts.append(f"{self.damaged_bytes} bytes are damaged and were passed over")
        if self.is_cut_off:
            parts.append("it ends in the middle of a message")
        return " and ".join(parts)

    def _past_damage(self, offset):
        """Where to go on. What no sync word follows is damaged, too: noise may stand within it."""
        following = self._next_event(offset + 1)
        if following == self._size and self._event_at(offset) is None and self._is_header(offset):
            self.is_cut_off = True
        else:
            self.damaged_bytes += following - offset
        return following

    def _event_at(self, offset):
        """The event that begins there, None if there is none or it does not fit into the file."""
        header = self._header(offset)
        if header is None:
            return None
        time_us, channel_length, data_length = header
        data_offset = offset + _HEADER.size + channel_length
        if data_offset + data_length > self._size:
            return None
        channel = self._file.read(channel_length).decode(errors="replace")
        return Event(offset, time_us, channel, data_offset, data_length)

    def _header(self, offset):
        self._file.seek(offset)
        data = self._file.read(_HEADER.size)
        if len(data) < _HEADER.size:
            return None
        sync, _, time_us, channel_length, data_length = _HEADER.unpack(data)
        is_sound = sync == SYNC and 0 < channel_length <= _LONGEST_CHANNEL and data_length >= 0
        return (time_us, channel_length, data_length) if is_sound else None

    def _is_header(self, offset):
        """True if a sound header, or the first bytes of one, stand there."""
        self._file.seek(offset)
        left = self._file.read(_HEADER.size)
        if len(left) < _HEADER.size:
            return left[:len(SYNC)] == SYNC[:len(left)]
        return self._header(offset) is not None

    def _begins_well(self, offset):
        """True at the end of the file and where a sync word, or the rest of the file as its beginning, stands."""
        self._file.seek(offset)
        word = self._file.read(len(SYNC))
        return word == SYNC[:len(word)]

    def _next_event(self, offset):
        """Where the next event begins; the end of the file if none does."""
        while (offset := self._find_sync(offset)) < self._size:
            if self._event_at(offset) is not None:
                return offset
            offset += 1
        return self._size

    def _find_sync(self, offset):
        """The next sync word; the end of the file if there is none. Searches no chunk twice from its beginning."""
        while offset < self._size:
            if not 0 <= offset - self._chunk_offset <= len(self._chunk) - len(SYNC):
                self._file.seek(offset)
                self._chunk_offset, self._chunk = offset, self._file.read(_CHUNK_BYTES)
            found = self._chunk.find(SYNC, offset - self._chunk_offset)
            if found >= 0:
                return self._chunk_offset + found
            offset = max(offset, self._chunk_offset + len(self._chunk) - len(SYNC)) + 1
        return self._size
