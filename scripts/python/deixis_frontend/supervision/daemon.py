"""The supervising process, which `deixis start` starts and leaves behind, or becomes."""

from __future__ import annotations

import argparse
import asyncio
import os
import secrets
import signal
import subprocess
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl, parse
from deixis_frontend.supervision import guard
from deixis_frontend.supervision.control_server import ControlServer
from deixis_frontend.supervision.foreground import Foreground
from deixis_frontend.supervision.own_log import note, say
from deixis_frontend.supervision.run_folder import RunFolder
from deixis_frontend.supervision.status_listener import StatusListener
from deixis_frontend.supervision.supervisor import Supervisor
from deixis_frontend.supervision.system_file import System, load

_SAMPLE_EVERY_S = 1.0
_GUARD_PAUSE_S = 0.2


def main(argv: list[str]) -> int:
    """Runs until everything has been stopped; what went wrong at the start goes to stderr."""
    parser = argparse.ArgumentParser(prog="deixis-supervisor")
    parser.add_argument("--system", type=Path, required=True)
    parser.add_argument("--lcm-url", required=True)
    parser.add_argument("--while-pid", type=int, help="end when this process has ended")
    arguments = parser.parse_args(argv)
    try:
        supervise(load(arguments.system), layouts.find(), parse(arguments.lcm_url),
                  while_pid=arguments.while_pid)
    except UserError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def supervise(system: System, layout: Layout, url: LcmUrl, *, while_pid: int | None = None,
              foreground: Foreground | None = None) -> None:
    """Runs until everything has been stopped; raises UserError when it runs already."""
    folder = RunFolder(system.name)
    token = secrets.token_hex(8)
    guard.stop_all(*folder.lock(system.path.resolve(), token))
    asyncio.run(_run(system, layout, url, folder, token, while_pid, foreground))
    folder.release()
    note("ended")


async def _run(system: System, layout: Layout, url: LcmUrl, folder: RunFolder, token: str,
               while_pid: int | None, foreground: Foreground | None) -> None:
    echo = sys.stdout.buffer if foreground else None
    supervisor = Supervisor(system, layout, url, token, echo)
    end = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, _end_by_signal, number, end)
    StatusListener(url, system.channel_prefix, layout, supervisor.hear).attach(loop)
    server = ControlServer(supervisor, end.set)
    await server.serve(folder.socket)
    note(f"started, pid {os.getpid()}, from {system.path}, on {url}")
    helpers = [asyncio.create_task(_keep_guard(token)), asyncio.create_task(_sample(supervisor)),
               asyncio.create_task(_stay_reachable(folder, system, token, server, end))]
    if while_pid:
        helpers.append(asyncio.create_task(_end_with(while_pid, end)))
    if foreground:
        helpers.append(foreground.begin(supervisor, end))
    await end.wait()
    for helper in helpers[2:]:  # The guard stays till the services have gone.
        helper.cancel()
    folder.hide()
    await supervisor.stop([], lambda _: None)
    await server.close()
    for helper in helpers:
        helper.cancel()


async def _keep_guard(token: str) -> None:
    """Has a guard beside us at all times: it ends the services if we die."""
    while True:
        process = await asyncio.create_subprocess_exec(
            sys.executable, "-m", guard.__name__, token,
            stdin=subprocess.PIPE, start_new_session=True)
        await process.wait()
        await asyncio.sleep(_GUARD_PAUSE_S)


def _end_by_signal(number: signal.Signals, end: asyncio.Event) -> None:
    note(f"asked to stop everything by {number.name}")
    end.set()


async def _end_with(pid: int, end: asyncio.Event) -> None:
    while Path(f"/proc/{pid}").exists():
        await asyncio.sleep(_SAMPLE_EVERY_S)
    end.set()


async def _stay_reachable(folder: RunFolder, system: System, token: str, server: ControlServer,
                          end: asyncio.Event) -> None:
    """Restores the run folder when somebody has deleted it; ends when another one has it then."""
    while True:
        await asyncio.sleep(_SAMPLE_EVERY_S)
        try:
            if folder.is_lost():
                folder.lock_again(system.path, token)
            if not folder.socket.exists():
                await server.serve(folder.socket)
                say(f"{folder.path} was deleted: made anew")
        except (UserError, OSError) as error:
            say(f"{folder.path} was deleted: everything is stopped: {error}")
            end.set()
            return


async def _sample(supervisor: Supervisor) -> None:
    while True:
        supervisor.sample()
        await asyncio.sleep(_SAMPLE_EVERY_S)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
