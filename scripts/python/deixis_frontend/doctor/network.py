"""Whether messages arrive on this host, and whether they stay there."""

from __future__ import annotations

import fcntl
import os
import shutil
import socket
import struct
import subprocess

from deixis_frontend import lcm_url
from deixis_frontend.doctor import firewall
from deixis_frontend.doctor.command_lines import CommandLines
from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Finding
from deixis_frontend.lcm_url import RECEIVE_BUFFER_BYTES, LcmUrl, granted_buffer

_ROUTE = (("ip", "link", "set", "lo", "up"), ("ip", "route", "add", "224.0.0.0/4", "dev", "lo"))
_SIOCGIFFLAGS = 0x8913  # netdevice(7)
_IFF_UP, _IFF_LOOPBACK = 0x1, 0x8
_BUFFER = (("sysctl", "-w", f"net.core.rmem_max={RECEIVE_BUFFER_BYTES}"),)


def bus(url: LcmUrl) -> list[Finding]:
    """Whether what is said on the bus can be heard."""
    if url.provider != "udpm":
        lcm_url.require_bus(url)
        return [Finding(OK, "bus", f"{url} answers")]
    reason = lcm_url.why_multicast_fails(url.group)
    if reason:
        return [Finding(PROBLEM, "multicast_route", reason, "sudo ip route add 224.0.0.0/4 dev lo",
                        _ROUTE)]
    return [Finding(OK, "multicast_route", f"what is sent to {url.group} arrives here")]


def receive_buffer(url: LcmUrl) -> list[Finding]:
    """Whether the kernel grants the receive buffer that pictures need."""
    if url.provider != "udpm":
        return []
    asked = int(dict(url.parameters).get("recv_buf_size", RECEIVE_BUFFER_BYTES))
    if asked < RECEIVE_BUFFER_BYTES:
        return [Finding(WARNING, "receive_buffer", f"the URL asks for {asked} bytes only: leave"
                        f" recv_buf_size out",
                        f"export LCM_DEFAULT_URL='{url.without('recv_buf_size')}'")]
    granted = granted_buffer(asked)
    if granted < asked:
        return [Finding(WARNING, "receive_buffer", f"the kernel grants {granted} of {asked} bytes:"
                        " large pictures are lost", f"sudo {' '.join(_BUFFER[0])}", _BUFFER)]
    return [Finding(OK, "receive_buffer", f"the kernel grants {granted} bytes")]


def reach(url: LcmUrl) -> list[Finding]:
    """Whether our messages stay on this host."""
    if url.provider != "udpm":
        return []
    ttl = int(dict(url.parameters).get("ttl", "0"))
    if ttl == 0:
        return [Finding(OK, "reach", "messages stay on this host (ttl=0)")]
    return [Finding(WARNING, "reach", f"messages leave this host (ttl={ttl}), and LCM knows no"
                    " passwords", f"export LCM_DEFAULT_URL='{url.without('ttl').with_default('ttl', 0)}'")]


def fence(url: LcmUrl, commands: CommandLines) -> list[Finding]:
    """Whether others can send to our port."""
    if url.provider != "udpm":
        return []
    others = _interfaces_to_others()
    if not others:
        return [Finding(OK, "fence", "this host has no network but loopback")]
    place = f"port {url.port} on {', '.join(others)}"
    if os.geteuid() != 0:
        return [Finding(WARNING, "fence", f"only root can tell whether a firewall closes {place}",
                        f"sudo {commands.on_bus('doctor')}")]
    rule = firewall.closing_rule(_rules(), url.port)
    if rule:
        return [Finding(OK, "fence", f"a firewall closes {place}: {rule}")]
    return [Finding(WARNING, "fence", f"no firewall rule closes {place}: whoever reaches it can"
                    " speak", firewall.cure(url.port))]


def _interfaces_to_others() -> list[str]:
    """Names of the interfaces that are up, loopback left out."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        flags = {name: _flags(asked, name) for _, name in socket.if_nameindex()}
    return [name for name, value in flags.items() if value & _IFF_UP and not value & _IFF_LOOPBACK]


def _flags(asked: socket.socket, name: str) -> int:
    try:
        answer = fcntl.ioctl(asked, _SIOCGIFFLAGS, struct.pack("16sH14x", name.encode(), 0))
    except OSError:
        return 0  # Gone meanwhile.
    return int(struct.unpack_from("H", answer, 16)[0])


def _rules() -> str:
    commands = (("nft", "list", "ruleset"), ("iptables", "-S", "INPUT"))
    return "\n".join(subprocess.run(command, capture_output=True, text=True, check=False,
                                    errors="replace").stdout
                     for command in commands if shutil.which(command[0]))
