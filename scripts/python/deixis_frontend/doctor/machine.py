"""The machine: cameras, disk, clock."""

from __future__ import annotations

import ctypes
import os
import shutil
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Finding
from deixis_frontend.process_facts import command_name

_LITTLE_SPACE, _NO_SPACE = 1e9, 1e8  # bytes: a few minutes of recording; nothing to speak of
_EARLIEST = 1_704_067_200  # 2024-01-01: a clock before that has never been set
_JUMP_S = 0.05
_OWN = "deixis-"  # how our programs are called
_STA_UNSYNC = 0x40  # of adjtimex(2)


def cameras(wanted: Mapping[str, Path], devices: Path = Path("/dev")) -> list[Finding]:
    """The video devices; `wanted` are those that services are to open, and the files that say so."""
    found = sorted(devices.glob("video[0-9]*"))
    findings = [_camera(device) for device in found]
    findings += [Finding(PROBLEM, "camera", f"{device}, which the configuration names, is not there:"
                         f" plug it in, or set source in {file}", "ls -l /dev/video*")
                 for device, file in wanted.items() if not Path(device).exists()]
    return findings or [Finding(OK, "camera", "there is none, and none is asked for")]


def _camera(device: Path) -> Finding:
    if not os.access(device, os.R_OK | os.W_OK):
        return Finding(PROBLEM, "camera", f"{device} may not be opened by this user",
                       "sudo usermod -aG video $USER && newgrp video")
    users = _users(device)
    strangers = [user for user in users if not user.startswith(_OWN)]
    if strangers:
        return Finding(WARNING, "camera", f"{device} is in use by {', '.join(strangers)}",
                       f"fuser -v {device}")
    use = f", in use by {users[0]}" if users else ""
    return Finding(OK, "camera", f"{device} is there{use}")


def _users(device: Path) -> list[str]:
    """Processes that have the file open; of other users' only when we are root."""
    users = set()
    for link in Path("/proc").glob("[0-9]*/fd/*"):
        try:
            if link.readlink() == device.resolve():
                users.add(command_name(int(link.parts[2])))
        except OSError:
            continue
    return sorted(users)


def disk(folder: Path) -> list[Finding]:
    """Room and permission to write below a folder, whether it is there yet or not."""
    place = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    try:
        with tempfile.TemporaryFile(dir=place):
            pass
    except OSError as error:
        cure = f"chown -R $USER {folder}" if place == folder else f"install -d -o $USER {folder}"
        return [Finding(PROBLEM, "disk", f"{folder} cannot be written: {error.strerror}",
                        f"sudo {cure}")]
    free = shutil.disk_usage(place).free
    level = PROBLEM if free < _NO_SPACE else WARNING if free < _LITTLE_SPACE else OK
    cure = "" if level == OK else f"du -ah {place} | sort -h | tail"
    return [Finding(level, "disk", f"{free / 1e9:.1f} GB are free below {folder}", cure)]


class ClockWatch:
    """Whether the clock is set, and whether it jumps between two looks at it."""

    def __init__(self) -> None:
        self._offset_s = _offset()

    def findings(self) -> list[Finding]:
        """What became of it since the beginning."""
        moved_s = _offset() - self._offset_s
        if abs(moved_s) > _JUMP_S:
            return [Finding(PROBLEM, "clock", f"the clock jumped by {moved_s:.3f} s meanwhile",
                            "timedatectl timesync-status")]
        if time.time() < _EARLIEST:
            return [Finding(PROBLEM, "clock", "the clock was never set: it is"
                            f" {time.strftime('%Y-%m-%d')}", "sudo timedatectl set-ntp true")]
        if not is_synchronised():
            return [Finding(WARNING, "clock", "the clock is not synchronised: ages and stamps of"
                            " other hosts differ", "sudo timedatectl set-ntp true")]
        return [Finding(OK, "clock", "the clock is synchronised and did not jump")]


def _offset() -> float:
    return time.clock_gettime(time.CLOCK_REALTIME) - time.clock_gettime(time.CLOCK_MONOTONIC)


def is_synchronised() -> bool:
    """Whether the kernel holds its clock for synchronised, which timedatectl tells, too."""
    timex = (ctypes.c_long * 64)()  # struct timex, 208 bytes; modes = 0: read only
    if ctypes.CDLL(None).adjtimex(ctypes.byref(timex)) < 0:
        return False
    status = ctypes.cast(timex, ctypes.POINTER(ctypes.c_int))[_STATUS_INDEX]
    return not status & _STA_UNSYNC


# modes (int, padded), offset, freq, maxerror, esterror (long), then status (int).
_STATUS_INDEX = 5 * ctypes.sizeof(ctypes.c_long) // ctypes.sizeof(ctypes.c_int)
