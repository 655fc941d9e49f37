"""A supervisor that does not go to the background: for systemd, containers, and to look on."""

from __future__ import annotations

import asyncio
import os
import socket
import sys
from contextlib import suppress
from typing import Any

from deixis_frontend.supervision.own_log import say
from deixis_frontend.supervision.supervised_service import State
from deixis_frontend.supervision.supervisor import Report, Supervisor

_LOOK_EVERY_S = 1.0


class Foreground:
    """Starts services, says when they are ready, and ends all when one of them is given up.

    `exit_code` is 1 then, so that whoever looks after this process starts it again.
    """

    def __init__(self, names: list[str], report: Report) -> None:
        """`report` gets the facts of each service that got ready, or did not."""
        self._names = names
        self._report = report
        self.exit_code = 0

    def begin(self, supervisor: Supervisor, end: asyncio.Event) -> asyncio.Task[None]:
        """Starts the services; `end` is set when one that was asked for is given up."""
        def ended(task: asyncio.Task[None]) -> None:
            if not task.cancelled() and (error := task.exception()):
                self._give_up(f"error in the supervisor itself: {error!r}", end)

        task = asyncio.create_task(self._run(supervisor, end))
        task.add_done_callback(ended)
        return task

    async def _run(self, supervisor: Supervisor, end: asyncio.Event) -> None:
        wanted = supervisor.all_for(self._names)
        await supervisor.start(self._names, self._tell)
        if not supervisor.in_state(State.FAILED, wanted):
            notify(f"READY=1\nSTATUS={len(wanted)} services have been started")
        while not (failed := supervisor.in_state(State.FAILED, wanted)):
            await asyncio.sleep(_LOOK_EVERY_S)
        self._give_up(f"given up: {', '.join(failed)}: all is stopped", end)

    def _tell(self, facts: dict[str, Any]) -> None:
        """The services go on when nobody reads: what they write is in their logs."""
        with suppress(OSError):
            self._report(facts)

    def _give_up(self, words: str, end: asyncio.Event) -> None:
        say(f"deixis: {words}")
        notify(f"STATUS={words}")
        self.exit_code = 1
        end.set()


def notify(text: str) -> None:
    """Tells systemd, if it asks to be told (sd_notify(3)); nothing happens otherwise."""
    address = os.environ.get("NOTIFY_SOCKET")
    if not address:
        return
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as connection:
        try:
            connection.connect("\0" + address[1:] if address.startswith("@") else address)
            connection.sendall(text.encode())
        except OSError as error:
            print(f"deixis: NOTIFY_SOCKET {address}: {error.strerror}", file=sys.stderr)

