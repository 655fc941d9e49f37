"""What signals do to a command: Ctrl-C, and those that are to work like it."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager

INTERRUPTED = 130  # exit code, as of a shell
ALL = frozenset((signal.SIGINT, signal.SIGTERM, signal.SIGHUP))


def end_at_once() -> None:
    """Ctrl-C ends this process without a word: for the time until the command runs."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # The launcher has it blocked.


def raise_on_ctrl_c() -> None:
    """Ctrl-C raises KeyboardInterrupt again; a run in the background goes on ignoring it."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def end_as_by_ctrl_c(*signals: signal.Signals) -> None:
    """Lets the signals raise KeyboardInterrupt, too, unless they are ignored."""
    for number in signals:
        if signal.getsignal(number) is not signal.SIG_IGN:  # nohup has SIGHUP ignored.
            signal.signal(number, signal.default_int_handler)


@contextmanager
def held_back() -> Iterator[Callable[[], None]]:
    """Holds interrupts back until what it gives is called, or to the end of the block.

    For starting a child: one that comes in between would leave a child that nobody knows. The
    child has to let them through itself (child_processes.end_with_parent does).
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ALL)

    def let_through() -> None:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

    try:
        yield let_through
    finally:
        let_through()
