"""LCM logs as iterators of decoded messages.

    for log_time_us, channel, message in logs.read("walk.lcmlog", channels={"GESTURES"}):
        ...

The type of a message is told by its fingerprint; one that is not known stays bytes.
"""
import os
import warnings

import lcm

from deixis_lcm.decoding import decode, types_by_fingerprint
from deixis_lcm.log_events import EventReader


def read(path, channels=None):
    """Yields (log_time_us, channel, message) of a log in the order of the file.

    `log_time_us` is when the logger received the message, microseconds; the capture time is in the message.
    `channels` is a set of names, None for all. FileNotFoundError if there is no such file, ValueError if it is no log.
    Damaged parts, and messages of a known type that do not decode, are passed over with a warning (UserWarning) at
    the end.
    """
    if not os.path.isfile(path):
        raise FileNotFoundError(f"no log file {path}")
    types = types_by_fingerprint()
    tally = _Tally()
    with EventReader(path) as events:
        for event in events:
            tally.events += 1
            if channels is not None and event.channel not in channels:
                continue
            record = _record(event, events, types, tally)
            if record is not None:
                yield record
        if tally.events == 0 and events.damaged_bytes:
            raise ValueError(f"{path} is no LCM log: no event begins in it")
        for what in tally.undecodable(), tally.damage(events):
            if what:
                warnings.warn(f"{path}: {what}", stacklevel=2)


class _Tally:
    """What was read of a log, and what was passed over."""

    def __init__(self):
        self.events = 0
        self._undecodable = 0
        self._last_reason = ""

    def pass_over(self, event, reason):
        """Counts a message that does not decode."""
        self._undecodable += 1
        self._last_reason = f"{event.channel} at {event.time_us} us: {reason}"

    def undecodable(self):
        """In words; nothing when all decoded."""
        if not self._undecodable:
            return ""
        return f"{self._undecodable} messages do not decode, the last: {self._last_reason}"

    def damage(self, events):
        """In words; nothing when the file is whole."""
        return f"{self.events} messages were read; {events.damage()}" if events.damage() else ""


def _record(event, events, types, tally):
    """(log_time_us, channel, message); None when it does not decode."""
    try:
        data = events.data(event)
        message = decode(data, types)
    except ValueError as error:
        tally.pass_over(event, error)
        return None
    return event.time_us, event.channel, data if message is None else message


class Writer:
    """Writes a log; a context manager. An existing file raises FileExistsError.

        with logs.Writer("out.lcmlog") as log:
            log.write(message.utime, "GESTURES", message)
    """

    def __init__(self, path):
        if os.path.exists(path):
            raise FileExistsError(f"{path} exists")
        self._log = lcm.EventLog(str(path), "w")

    def write(self, log_time_us, channel, message):
        """Appends a message (or its bytes) at a time in microseconds. ValueError if the channel name is not usable."""
        if not 0 < len(channel.encode()) <= 63:
            raise ValueError(f"channel '{channel}' must have 1 to 63 bytes")
        self._log.write_event(log_time_us, channel, message if isinstance(message, bytes) else message.encode())

    def close(self):
        """Ends the file."""
        if self._log is not None:
            self._log.close()
            self._log = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
