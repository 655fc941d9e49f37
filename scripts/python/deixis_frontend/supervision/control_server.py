"""Takes commands on a unix socket: a line of JSON in, lines of JSON out, the last has "done"."""

from __future__ import annotations

import asyncio
import json
import socket
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

from deixis_frontend.errors import UserError
from deixis_frontend.printable import printable
from deixis_frontend.process_facts import command_name
from deixis_frontend.supervision.own_log import note
from deixis_frontend.supervision.supervisor import Report, Supervisor


class ControlServer:
    """Runs the commands that `scripts/deixis` sends; several at a time."""

    def __init__(self, supervisor: Supervisor, shut_down: Callable[[], None]) -> None:
        self._supervisor = supervisor
        self._shut_down = shut_down
        self._answers: set[asyncio.Task[None]] = set()
        self._server: asyncio.Server | None = None

    async def serve(self, path: Path) -> None:
        """Begins to listen; a second call takes the place of the first."""
        if self._server:
            self._server.close()
        self._server = await asyncio.start_unix_server(self._take, path)

    async def close(self) -> None:
        """Listens no more; lets the answers that are under way reach their askers."""
        if self._server:
            self._server.close()
        if self._answers:
            await asyncio.wait(self._answers, timeout=1.0)

    async def _take(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        answer = asyncio.create_task(self._answer(reader, writer))
        self._answers.add(answer)
        answer.add_done_callback(self._answers.discard)

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        def report(facts: dict[str, Any]) -> None:
            if not writer.is_closing():
                writer.write(json.dumps(facts).encode() + b"\n")

        try:
            request = json.loads(await reader.readline())
            _note_request(request, writer)
            report(await self._obey(request, report))
            await writer.drain()
        except (ConnectionError, ValueError):
            return  # The asker has gone, or was none of ours.
        finally:
            writer.close()

    async def _obey(self, request: dict[str, Any], report: Report) -> dict[str, Any]:
        try:
            return {"done": True, **await self._command(request, report)}
        except UserError as error:
            return {"done": True, "ok": False, "error": str(error)}

    async def _command(self, request: dict[str, Any], report: Report) -> dict[str, Any]:
        names = [str(name) for name in request.get("names", [])]
        match request.get("command"):
            case "start":
                return {"ok": await self._supervisor.start(names, report)}
            case "restart":
                return {"ok": await self._supervisor.restart(names, report)}
            case "stop":
                return await self._stop(names, report)
            case "status":
                return {"ok": True, "status": self._supervisor.status()}
        raise UserError(f"unknown command {request.get('command')!r}")

    async def _stop(self, names: list[str], report: Report) -> dict[str, Any]:
        wanted = self._supervisor.wanted()
        await self._supervisor.stop(names, report)
        if not self._supervisor.wanted():
            self._shut_down()
        return {"ok": True, "stopped": wanted}


def _note_request(request: dict[str, Any], writer: asyncio.StreamWriter) -> None:
    """Who asks for what, for those who wonder later; `status` changes nothing."""
    if request.get("command") in ("start", "restart", "stop"):
        names = ", ".join(map(str, request.get("names", [])))
        otherwise = "everything" if request["command"] == "stop" else "what is started by default"
        note(printable(f"asked to {request['command']} {names or otherwise} by"
                       f" {command_name(_peer_pid(writer))},"
                       f" system file {request.get('system_file', 'not told')}"))


def _peer_pid(writer: asyncio.StreamWriter) -> int:
    """The process at the other end, as the kernel knows it; see SO_PEERCRED in unix(7)."""
    connection = writer.get_extra_info("socket")
    credentials = struct.Struct("3i")  # pid, uid, gid
    raw = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, credentials.size)
    return int(credentials.unpack(raw)[0])
