"""LCM URLs: reading, completing, and whether multicast works on this machine."""

from __future__ import annotations

import os
import secrets
import socket
import struct
import time
from dataclasses import dataclass, replace

from deixis_frontend.errors import UserError

DEFAULT = "udpm://239.255.76.67:7667?ttl=0"
GROUP = "239.255.76.67"
# The same as in common/transport/bus.h: a raw picture of 1280 x 960 (3.7 MB) fits in.
RECEIVE_BUFFER_BYTES = 4 * 1024 * 1024
TCP_HOST, TCP_PORT = "127.0.0.1", "7700"  # LCM's own defaults
_CONNECTS_WITHIN_S = 2.0
_RANGES = {"ttl": (0, 255), "recv_buf_size": (1, 2**31 - 1)}  # what a udpm URL may set
_PROVIDERS = ("udpm", "tcpq", "memq", "file")
CURE_ROUTE = (
    "give loopback a multicast route: `sudo ip route add 224.0.0.0/4 dev lo`"
    " or `scripts/setup --kernel`"
)


@dataclass(frozen=True)
class LcmUrl:
    """`provider://network?key=value&...`; for udpm with group and port told apart."""

    provider: str
    network: str
    parameters: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        query = "&".join(f"{key}={value}" for key, value in self.parameters)
        return f"{self.provider}://{self.network}" + (f"?{query}" if query else "")

    @property
    def group(self) -> str:
        """Multicast group of a udpm URL."""
        return self.network.partition(":")[0] or GROUP

    @property
    def port(self) -> int:
        """Port of a udpm URL."""
        return int(self.network.partition(":")[2] or 7667)

    def with_default(self, key: str, value: object) -> LcmUrl:
        """The same URL with `key=value` appended unless `key` is there."""
        if any(present == key for present, _ in self.parameters):
            return self
        return replace(self, parameters=(*self.parameters, (key, str(value))))

    def without(self, key: str) -> LcmUrl:
        """The same URL with `key` left to its default."""
        return replace(self, parameters=tuple(
            parameter for parameter in self.parameters if parameter[0] != key))

    def with_receive_buffer(self) -> LcmUrl:
        """The same URL asking for a receive buffer that pictures fit into (udpm only).

        For no more than the kernel grants: liblcm would print a page about the rest at every start.
        """
        if self.provider != "udpm":
            return self
        return self.with_default("recv_buf_size", granted_buffer(RECEIVE_BUFFER_BYTES))


def parse(text: str) -> LcmUrl:
    """Reads and checks a URL; raises UserError naming the fault and the cure."""
    provider, separator, rest = text.partition("://")
    if not separator or provider not in _PROVIDERS:
        raise UserError(f"LCM URL '{text}' is not one of udpm://, tcpq://, memq://, file://"
                        f": write for example '{DEFAULT}'")
    network, _, query = rest.partition("?")
    url = LcmUrl(provider, network, tuple(_parameter(text, part) for part in _split(query)))
    _check_keys_once(text, url)
    if provider == "udpm":
        _check_udpm(text, url)
    if provider == "tcpq" and ":" in network:
        _check_port(text, network.partition(":")[2])
    return url


def choose(option: str | None) -> LcmUrl:
    """The URL of `-l`, else of LCM_DEFAULT_URL, else LCM's own default."""
    return parse(option or os.environ.get("LCM_DEFAULT_URL") or DEFAULT)


def granted_buffer(asked: int) -> int:
    """Bytes that a socket gets; the kernel tells twice that, for its own bookkeeping."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, asked)
        return probe.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) // 2


def with_free_port() -> LcmUrl:
    """A URL on this host alone whose port no one else uses."""
    return parse(f"udpm://{GROUP}:{free_port()}?ttl=0")


def free_port() -> int:
    """A UDP port that is free at this moment."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return int(probe.getsockname()[1])


def why_multicast_fails(group: str = GROUP, seconds: float = 0.3, tries: int = 3) -> str | None:
    """None when a multicast datagram that is sent here arrives here, else the reason."""
    try:
        with member(group) as receiver, _sender() as sender:
            port = receiver.getsockname()[1]
            return _exchange(receiver, sender, (group, port), seconds, tries)
    except OSError as error:
        return f"multicast to {group} fails: {error.strerror or error}"


def require_bus(url: LcmUrl) -> None:
    """Raises UserError with the cure when `url` leads to no other process."""
    if url.provider == "udpm":
        reason = why_multicast_fails(url.group)
        if reason:
            raise UserError(f"{reason}: {CURE_ROUTE}")
    elif url.provider == "tcpq":
        _require_server(url)
    else:
        raise UserError(f"LCM URL '{url}' leads to no other process: name a bus, for example"
                        f" '{DEFAULT}', with -l or in LCM_DEFAULT_URL")


def why_bus_fails(url: LcmUrl) -> str | None:
    """None when messages on `url` arrive, else the reason; takes a fifth of a second at most on
    multicast."""
    if url.provider == "udpm":
        return why_multicast_fails(url.group, seconds=0.1, tries=2)
    try:
        require_bus(url)
    except UserError as error:
        return str(error)
    return None


def _require_server(url: LcmUrl) -> None:
    host, _, port = url.network.partition(":")
    try:
        address = (host or TCP_HOST, int(port or TCP_PORT))
        socket.create_connection(address, _CONNECTS_WITHIN_S).close()
    except OSError as error:
        raise UserError(f"nobody listens on '{url}' ({error.strerror or error}):"
                        " start LCM's TCP server there, or name another URL with -l") from None


def _split(query: str) -> list[str]:
    return [part for part in query.split("&") if part]


def _parameter(text: str, part: str) -> tuple[str, str]:
    key, separator, value = part.partition("=")
    if not separator or not key or not value:
        raise UserError(f"LCM URL '{text}': '{part}' is not of the form key=value")
    return key, value


def _check_keys_once(text: str, url: LcmUrl) -> None:
    keys = [key for key, _ in url.parameters]
    for key in keys:
        if keys.count(key) > 1:
            raise UserError(f"LCM URL '{text}' gives '{key}' twice: remove one")


def _check_udpm(text: str, url: LcmUrl) -> None:
    host, _, port = url.network.partition(":")
    if url.network and not _is_multicast(host):
        raise UserError(f"LCM URL '{text}': '{host}' is no multicast group"
                        f" (224.0.0.0 to 239.255.255.255): write for example {GROUP}")
    if url.network:
        _check_port(text, port)
    for key, value in url.parameters:
        _check_parameter(text, key, value)


def _check_port(text: str, port: str) -> None:
    if not port:
        raise UserError(f"LCM URL '{text}' has no port: write for example {GROUP}:7667")
    if not 1 <= _whole(port) <= 65535:
        raise UserError(f"LCM URL '{text}': port '{port}' is not a number from 1 to 65535")


def _check_parameter(text: str, key: str, value: str) -> None:
    if key not in _RANGES:
        raise UserError(f"LCM URL '{text}': unknown key '{key}': known are {', '.join(_RANGES)}")
    low, high = _RANGES[key]
    if not low <= _whole(value) <= high:
        raise UserError(f"LCM URL '{text}': {key} '{value}' is not a whole number"
                        f" from {low} to {high}")


def _whole(text: str) -> int:
    """The number; -1 when the text is none."""
    return int(text) if text.isascii() and text.isdigit() else -1


def _is_multicast(host: str) -> bool:
    try:
        return 224 <= socket.inet_pton(socket.AF_INET, host)[0] <= 239
    except OSError:
        return False


def member(group: str, port: int | None = None) -> socket.socket:
    """A socket that hears what is sent to the group: on a port that others hear, too, or a free one."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    if port is not None:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER_BYTES)
    receiver.bind(("", port or 0))
    membership = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("0.0.0.0"))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
    return receiver


def _sender() -> socket.socket:
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    return sender


def _exchange(receiver: socket.socket, sender: socket.socket, target: tuple[str, int],
              seconds: float, tries: int) -> str | None:
    token = b"deixis probe " + secrets.token_bytes(8)
    for _ in range(tries):
        sender.sendto(token, target)
        if _arrives(receiver, token, seconds):
            return None
    return f"a multicast datagram to {target[0]} did not come back"


def _arrives(receiver: socket.socket, token: bytes, seconds: float) -> bool:
    deadline = time.monotonic() + seconds
    while (left := deadline - time.monotonic()) > 0:
        receiver.settimeout(left)
        try:
            if receiver.recv(1024) == token:
                return True
        except TimeoutError:
            return False
    return False
