"""One service of the system through its life: waiting, starting, running, back after a crash."""

from __future__ import annotations

import asyncio
import signal
import socket
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from deixis_frontend import process_facts, service_facts
from deixis_frontend.errors import UserError
from deixis_frontend.printable import printable
from deixis_frontend.supervision.echoed_log import EchoedLog
from deixis_frontend.supervision.restart_policy import (
    WRONG_USAGE, Ending, RestartPolicy, Verdict)
from deixis_frontend.supervision.rotating_log import RotatingLog
from deixis_frontend.supervision.service_process import ServiceProcess
from deixis_frontend.supervision.system_file import ServiceEntry

SILENT_AFTER_S = 5.0  # a service speaks every second
_NEVER_READY = 1  # exit code of a run that was ended because it never got ready


class State(str, Enum):
    """Where a service is in its life."""

    STOPPED = "stopped"
    WAITING = "waiting"
    STARTING = "starting"
    RUNNING = "running"
    DEGRADED = "degraded"
    BACKING_OFF = "backing off"
    STOPPING = "stopping"
    FAILED = "failed"
    FINISHED = "finished"


READY = (State.RUNNING, State.DEGRADED)
SETTLED = (*READY, State.STOPPED, State.FAILED, State.FINISHED)


@dataclass(frozen=True)
class Launch:
    """How the program is started."""

    command: Callable[[], list[str]]
    environment: dict[str, str]
    folder: Path


class SupervisedService:
    """Runs one entry of the system file and keeps it alive by its restart policy."""

    def __init__(self, entry: ServiceEntry, launch: Launch,
                 log: RotatingLog | EchoedLog) -> None:
        self.entry = entry
        self.state = State.STOPPED
        self.last_error = ""
        self.restarts = 0
        self._launch = launch
        self._log = log
        self._process: ServiceProcess | None = None
        self._task: asyncio.Task[None] | None = None
        self._turn = asyncio.Lock()  # start and stop take turns
        self._ready = asyncio.Event()
        self._settled = asyncio.Event()
        self._started_at = self._ready_at = 0.0
        self._cpu = process_facts.CpuMeter()
        self._heard: dict[str, Any] = {}
        self._heard_at = 0.0
        self._killed_because = ""
        self.stranger = ""

    @property
    def is_active(self) -> bool:
        """True while there is a process, or one is going to be."""
        return self._task is not None and not self._task.done()

    async def start(self, before: list[SupervisedService], needed: list[SupervisedService]) -> None:
        """Begins to run once those in `before` have settled; does nothing when it runs already."""
        async with self._turn:
            if not self.is_active:
                self.restarts, self.last_error = 0, ""
                self._enter(State.WAITING)
                self._task = asyncio.create_task(self._live(before, needed))
                self._task.add_done_callback(self._task_ended)

    async def stop(self) -> None:
        """Ends the process and its children; returns when they are gone."""
        async with self._turn:
            if self._task is not None:
                self._task.cancel()
                await asyncio.gather(self._task, return_exceptions=True)
                self._task = None
            await self._end_process()
            self._enter(State.STOPPED)
            self._log.close()

    async def settled(self) -> None:
        """Returns when the service is ready, or is not going to be."""
        await self._settled.wait()

    def hear(self, message: Any) -> None:
        """Takes a status message of this service and instance."""
        is_here = message.host == socket.gethostname()
        if is_here and self._process and self._process.owns(message.pid):
            self._heard = service_facts.as_facts(message)
            self._heard_at = time.monotonic()
            self._follow(message.state)
        else:
            self.stranger = f"pid {message.pid} on {printable(message.host)}"

    def silent_s(self) -> float | None:
        """How long it has not spoken; None when it has not to, since it is not ready."""
        return time.monotonic() - self._heard_at if self.state in READY else None

    def excuse_silence(self) -> None:
        """Counts the silence anew: it was not the service's own."""
        self._heard_at = time.monotonic()

    def kill(self, reason: str) -> None:
        """Ends a process that hangs, and its children; the restart policy says what follows."""
        if self._process and not self._killed_because:
            self._killed_because = reason
            self._note(f"{reason}: killed")
            self._process.signal_group(signal.SIGKILL)

    def sample(self) -> None:
        """Measures the CPU use; call it about once a second."""
        if self._process:
            self._cpu.sample(self._process.pid)

    def facts(self) -> dict[str, Any]:
        """Everything that `status` shows."""
        process = self._process
        now = time.monotonic()
        memory = process_facts.resident_bytes(process.pid) if process else None
        return {
            "name": self.entry.name,
            "state": "silent" if self._is_silent(now) else self.state.value,
            "pid": process.pid if process else None,
            "uptime_s": _rounded(now - self._started_at) if process else None,
            "restarts": self.restarts,
            "cpu_percent": _rounded(self._cpu.percent) if process else None,
            "memory_mb": _rounded(memory / 1e6 if memory else None),
            "status_age_s": _rounded(now - self._heard_at) if self._heard else None,
            "last_error": self.last_error,
            "stranger": self.stranger,
            "log_bytes_lost": self._log.lost_bytes,
            **self._heard,
        }

    def _is_silent(self, now: float) -> bool:
        return self.state in READY and now - self._heard_at > SILENT_AFTER_S

    def _follow(self, state: int) -> None:
        name = service_facts.state_name(state)
        if name in (State.RUNNING.value, State.DEGRADED.value) and self.state in (
                State.STARTING, *READY):
            if self.state is State.STARTING:
                self._ready_at = time.monotonic()
            self._enter(State(name))
            self._ready.set()

    def _task_ended(self, task: asyncio.Task[None]) -> None:
        if not task.cancelled() and (error := task.exception()):
            self._fail(f"error in the supervisor itself: {error!r}")

    async def _live(self, before: list[SupervisedService],
                    needed: list[SupervisedService]) -> None:
        await asyncio.gather(*(service.settled() for service in [*before, *needed]))
        failed = [service.entry.name for service in needed if service.state not in READY]
        if failed:
            self._fail(f"needs {failed[0]}, which is not running: see its error")
            return
        policy = RestartPolicy(self.entry.restart, self.entry.give_up_after)
        while await self._goes_on(policy.decide(await self._run_once())):
            self.restarts += 1

    async def _goes_on(self, verdict: Verdict) -> bool:
        if verdict.delay_s is None:
            self._enter(State.FAILED if verdict.has_failed else State.FINISHED)
            self._note(self.state.value)
            return False
        self._enter(State.BACKING_OFF)
        self._note(f"starts again in {verdict.delay_s:g} s")
        await asyncio.sleep(verdict.delay_s)
        return True

    async def _run_once(self) -> Ending:
        self._ready.clear()
        self._heard, self.stranger = {}, ""
        try:
            self._spawn()
        except (UserError, OSError) as error:
            self.last_error = str(error)
            self._note(self.last_error)
            return Ending(WRONG_USAGE, was_ready=False)
        assert self._process is not None
        if not await self._gets_ready(self._process):
            return await self._end_unready()
        exit_code = await self._process.wait()
        self._process_ended(exit_code)
        ready_for_s = time.monotonic() - self._ready_at if self._ready.is_set() else 0.0
        return Ending(exit_code, self._ready.is_set(), ready_for_s)

    def _spawn(self) -> None:
        command = self._launch.command()
        self._process = ServiceProcess(command, self._launch.environment, self._launch.folder,
                                       self._log.write)
        self._started_at = time.monotonic()
        self._enter(State.STARTING)
        self._note(f"started, pid {self._process.pid}: {' '.join(command)}")

    async def _gets_ready(self, process: ServiceProcess) -> bool:
        """False when the time limit passes first; true when it is ready or has ended."""
        tasks = [asyncio.ensure_future(process.wait()), asyncio.ensure_future(self._ready.wait())]
        try:
            done, _ = await asyncio.wait(tasks, timeout=self.entry.ready_within_s,
                                         return_when=asyncio.FIRST_COMPLETED)
            return bool(done)
        finally:
            for task in tasks:
                task.cancel()

    async def _end_unready(self) -> Ending:
        assert self._process is not None
        said = self._process.last_error_line
        await self._end_process()
        self.last_error = (f"not ready within {self.entry.ready_within_s:g} s"
                           + (f": {said}" if said else ""))
        self._note(self.last_error)
        return Ending(_NEVER_READY, was_ready=False)

    async def _end_process(self) -> None:
        process = self._process
        if process is not None:
            self._enter(State.STOPPING)
            await process.stop(self.entry.stop_within_s)
            self._note("stopped")
            self._process = None

    def _process_ended(self, exit_code: int) -> None:
        assert self._process is not None
        said = self._process.last_error_line
        self._process = None
        how = self._killed_because or _describe(exit_code)
        self._killed_because = ""
        self._note(f"ended: {how}")
        if exit_code:
            self.last_error = f"{how}: {said}" if said and exit_code > 0 else how

    def _fail(self, text: str) -> None:
        self.last_error = text
        self._note(text)
        self._enter(State.FAILED)

    def _enter(self, state: State) -> None:
        self.state = state
        if state in SETTLED:
            self._settled.set()
        else:
            self._settled.clear()

    def _note(self, text: str) -> None:
        stamp = time.strftime("%Y-%m-%dT%H:%M:%S")
        self._log.write(f"-- {stamp} {self.entry.name}: {text}\n".encode())


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 1)


def _describe(exit_code: int) -> str:
    if exit_code >= 0:
        return f"exit code {exit_code}"
    try:
        return f"killed by {signal.Signals(-exit_code).name}"
    except ValueError:
        return f"killed by signal {-exit_code}"
