"""How much the kernel dropped of what was sent to this process's bus."""

from __future__ import annotations

import os
import socket
import stat
import struct

from deixis_frontend.lcm_url import LcmUrl

_SO_MEMINFO = 55
_FACTS = struct.Struct("=9I")
_DROPS = 8  # SK_MEMINFO_DROPS


def kernel_drops(url: LcmUrl) -> int:
    """Datagrams that were lost since the receive buffer was full; 0 when the kernel does not tell.

    liblcm does not show its sockets: they are those of this process that are bound to the port.
    """
    if url.provider != "udpm":
        return 0
    return sum(_drops(int(name), url.port) for name in os.listdir("/proc/self/fd"))


def _drops(descriptor: int, port: int) -> int:
    try:
        if not stat.S_ISSOCK(os.fstat(descriptor).st_mode):
            return 0
        with socket.socket(fileno=os.dup(descriptor)) as ours:
            if ours.family != socket.AF_INET or ours.getsockname()[1] != port:
                return 0
            facts = ours.getsockopt(socket.SOL_SOCKET, _SO_MEMINFO, _FACTS.size)
            return int(_FACTS.unpack(facts)[_DROPS])
    except (OSError, struct.error):
        return 0  # It is gone, or the kernel does not tell.
