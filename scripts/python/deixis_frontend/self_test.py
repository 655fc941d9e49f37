"""LCM's own message: every LCM program sends it to itself at its start, and so all others hear it."""

from __future__ import annotations

CHANNELS = ("LCM_SELF_TEST", "#!mpudpm_SELF_TEST")  # of udpm:// and mpudpm://
_PAYLOAD = b"lcm self test"


def is_self_test(channel: str, data: bytes) -> bool:
    """True for what tells nothing of the robot; other bytes on the same channel are somebody's."""
    return channel in CHANNELS and data.rstrip(b"\0") == _PAYLOAD
