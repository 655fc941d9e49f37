"""Child processes that do not outlive the command that started them."""

from __future__ import annotations

import ctypes
import os
import signal
from collections.abc import Callable

from deixis_frontend.interrupts import ALL

_PR_SET_PDEATHSIG = 1


def end_with_parent(number: signal.Signals) -> Callable[[], None]:
    """For subprocess's preexec_fn: the child gets the signal when this process dies, even killed.

    A guard as of the supervisor is not needed: these children have none of their own.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    parent = os.getpid()

    def prepare() -> None:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ALL)
        libc.prctl(_PR_SET_PDEATHSIG, int(number), 0, 0, 0)
        if os.getppid() != parent:  # It has died before this.
            os.kill(os.getpid(), number)

    return prepare
