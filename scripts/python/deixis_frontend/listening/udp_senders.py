"""Who sends on which channel of a UDP bus, by the addresses that datagrams come from.

LCM's datagrams: a message that fits in one begins with "LC02", a number, the channel; one in
fragments with "LC03", number, size, offset, index, count, and in its first fragment the channel.
All numbers are big-endian.
"""

from __future__ import annotations

import select
import struct
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from deixis_frontend.lcm_url import LcmUrl, member
from deixis_frontend.listening.source import MOST_CHANNELS
from deixis_frontend.printable import printable
from deixis_frontend.process_facts import command_name

_SMALL, _FRAGMENT = b"LC02", b"LC03"
_SMALL_HEADER = struct.Struct(">4sI")
_FRAGMENT_HEADER = struct.Struct(">4sIIIHH")  # magic, number, size, offset, index, count
_LONGEST_CHANNEL = 63  # LCM's own limit
_LONGEST_DATAGRAM = 65_536
_POLL_S = 0.1
MOST_SENDERS = 100  # of a channel that are told apart
Address = tuple[str, int]


@dataclass
class Sender:
    """One address that speaks on a channel, and when it was heard (monotonic clock)."""

    address: Address
    first_s: float
    last_s: float


@dataclass
class Senders:
    """The addresses heard so far, by channel."""

    by_channel: dict[str, dict[Address, Sender]] = field(default_factory=dict)

    def add(self, channel: str, address: Address, now_s: float) -> None:
        """A message from there. Noise is not to fill the memory."""
        if channel not in self.by_channel and len(self.by_channel) >= MOST_CHANNELS:
            return
        senders = self.by_channel.setdefault(channel, {})
        if address in senders:
            senders[address].last_s = now_s
        elif len(senders) < MOST_SENDERS:
            senders[address] = Sender(address, now_s, now_s)

    def at_once(self, channel: str) -> list[Address]:
        """Those of a channel that spoke at the same time as another one; a restart is none."""
        senders = list(self.by_channel.get(channel, {}).values())
        return [one.address for one in senders
                if any(one is not other and one.first_s <= other.last_s
                       and other.first_s <= one.last_s for other in senders)]


def channel_of(datagram: bytes) -> str | None:
    """The channel that a datagram names; None for later fragments and what is not LCM's."""
    offset = _channel_offset(datagram)
    if offset is None:
        return None
    end = datagram.find(b"\0", offset, offset + _LONGEST_CHANNEL + 1)
    return printable(datagram[offset:end].decode(errors="replace")) if end > offset else None


def _channel_offset(datagram: bytes) -> int | None:
    if datagram[:4] == _SMALL:
        return _SMALL_HEADER.size
    if datagram[:4] == _FRAGMENT and len(datagram) >= _FRAGMENT_HEADER.size:
        index = _FRAGMENT_HEADER.unpack_from(datagram)[4]
        return _FRAGMENT_HEADER.size if index == 0 else None
    return None


class SenderWatch:
    """Listens beside LCM on the port of a udpm bus; a context manager."""

    def __init__(self, url: LcmUrl) -> None:
        self.senders = Senders()
        self._socket = member(url.group, url.port)
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)

    def __enter__(self) -> SenderWatch:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        self._thread.join()
        self._socket.close()

    def _listen(self) -> None:
        while not self._is_over.is_set():
            if not select.select([self._socket], [], [], _POLL_S)[0]:
                continue
            datagram, address = self._socket.recvfrom(_LONGEST_DATAGRAM)
            channel = channel_of(datagram)
            if channel is not None:
                self.senders.add(channel, address[:2], time.monotonic())


def process_names(addresses: list[Address]) -> dict[Address, str]:
    """The processes of this host that own the ports; of other users' only when we are root."""
    inodes = {inode: port for port, inode in _udp_inodes().items()}
    owners: dict[int, str] = {}
    for link in Path("/proc").glob("[0-9]*/fd/*") if addresses else ():
        try:
            target = str(link.readlink())
        except OSError:
            continue  # Gone, or another user's.
        if target.startswith("socket:[") and target[8:-1] in inodes:
            owners.setdefault(inodes[target[8:-1]], command_name(int(link.parts[2])))
    return {address: owners[address[1]] for address in addresses if address[1] in owners}


def _udp_inodes() -> dict[int, str]:
    lines = Path("/proc/net/udp").read_text(encoding="ascii").splitlines()[1:]
    rows = [line.split() for line in lines]
    return {int(row[1].rpartition(":")[2], 16): row[9] for row in rows}
