"""All services of one system: started in order, stopped together, looked after in between."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl, why_bus_fails
from deixis_frontend.supervision.command_line import command_line
from deixis_frontend.supervision.echoed_log import EchoedLog
from deixis_frontend.supervision.guard import TOKEN_VARIABLE
from deixis_frontend.supervision.own_log import say
from deixis_frontend.supervision.receive_drops import kernel_drops
from deixis_frontend.supervision.rotating_log import RotatingLog
from deixis_frontend.supervision.silence_watch import SilenceWatch
from deixis_frontend.supervision.supervised_service import READY, Launch, State, SupervisedService
from deixis_frontend.supervision.system_file import ServiceEntry, System

Report = Callable[[dict[str, Any]], None]
_GOOD_ENDS = (*READY, State.FINISHED)


class Supervisor:
    """Owns the services. All methods run on one event loop."""

    def __init__(self, system: System, layout: Layout, url: LcmUrl, token: str,
                 echo: BinaryIO | None = None) -> None:
        """`echo` gets what the services write, too, with their names before it."""
        self.system = system
        self._layout = layout
        self._url = url
        self._token = token
        self._echo = echo
        self._services = {
            name: SupervisedService(entry, self._launch(entry), self._log(name))
            for name, entry in system.services.items()
        }
        self._by_identity = {
            (entry.service, entry.instance): self._services[name]
            for name, entry in system.services.items()
        }
        self._began = time.monotonic()
        self._watch = SilenceWatch(lambda: why_bus_fails(url), lambda: kernel_drops(url))
        self._trouble = ""

    async def start(self, names: list[str], report: Report) -> bool:
        """Starts groups and services (none named: those of `start`); true when all got ready."""
        wanted = self.all_for(names)
        for name in wanted:  # Those that others wait for come first.
            await self._services[name].start(*self._predecessors(name, wanted))
        await asyncio.gather(*(self._report_settled(name, report) for name in wanted))
        return all(self._services[name].state in _GOOD_ENDS for name in wanted)

    async def stop(self, names: list[str], report: Report) -> None:
        """Stops groups and services; none named: all."""
        wanted = self.system.resolve(names) if names else list(self._services)
        active = [name for name in wanted if self._services[name].state is not State.STOPPED]
        await asyncio.gather(*(self._stop_one(name, report) for name in active))

    async def restart(self, names: list[str], report: Report) -> bool:
        """Stops groups and services and starts them again; none named: all that are not stopped."""
        wanted = self.system.resolve(names) if names else self.wanted()
        await self.stop(wanted, lambda _: None)
        return await self.start(wanted, report)

    def all_for(self, names: list[str]) -> list[str]:
        """The services that starting `names` starts, in order."""
        named = names or list(self.system.start) or list(self.system.services)
        return self.system.with_needs(self.system.resolve(named))

    def in_state(self, state: State, names: list[str]) -> list[str]:
        """Those of `names` that are in a state."""
        return [name for name in names if self._services[name].state is state]

    def wanted(self) -> list[str]:
        """The services that somebody started and nobody stopped."""
        return [name for name, s in self._services.items() if s.state is not State.STOPPED]

    def hear(self, message: Any) -> None:
        """Hands a status message to its service."""
        service = self._by_identity.get((message.service, message.instance))
        if service:
            service.hear(message)

    def sample(self) -> None:
        """Measures all services and kills those that hang; call it about once a second."""
        for service in self._services.values():
            service.sample()
        judgement = self._watch.judge(list(self._services.values()))
        for service in judgement.hanging:
            service.kill(f"hung: silent for {service.silent_s() or 0.0:.0f} s")
        if judgement.trouble and judgement.trouble != self._trouble:
            say(judgement.trouble)
        self._trouble = judgement.trouble

    def status(self) -> dict[str, Any]:
        """Everything that `status` shows."""
        return {
            "system": self.system.name,
            "file": str(self.system.path),
            "file_digest": self.system.digest,
            "lcm_url": str(self._url),
            "supervisor_pid": os.getpid(),
            "is_in_foreground": self._echo is not None,
            "uptime_s": round(time.monotonic() - self._began, 1),
            "trouble": self._trouble,
            "services": [service.facts() for service in self._services.values()],
        }

    def log_folder(self) -> Path:
        """Folder of the services' log files."""
        return log_folder(self.system, self._layout)

    async def _report_settled(self, name: str, report: Report) -> None:
        await self._services[name].settled()
        report(self._services[name].facts())

    async def _stop_one(self, name: str, report: Report) -> None:
        await self._services[name].stop()
        report(self._services[name].facts())

    def _predecessors(
            self, name: str, wanted: list[str]
    ) -> tuple[list[SupervisedService], list[SupervisedService]]:
        entry = self.system.services[name]
        before = [self._services[other] for other in entry.after
                  if other in wanted or self._services[other].is_active]
        return before, [self._services[other] for other in entry.needs]

    def _launch(self, entry: ServiceEntry) -> Launch:
        environment = {**self._layout.environment(), TOKEN_VARIABLE: self._token,
                       "LCM_DEFAULT_URL": str(self._url)}
        return Launch(lambda: command_line(self.system, entry, self._layout, self._url),
                      environment, self._layout.state)

    def _log(self, name: str) -> RotatingLog | EchoedLog:
        settings = self.system.log
        log = RotatingLog(self.log_folder() / f"{name}.log", int(settings.size_mb * 1e6),
                          settings.count)
        return EchoedLog(log, name, self._echo) if self._echo else log


def log_folder(system: System, layout: Layout) -> Path:
    """Folder of a system's log files."""
    return layout.state / system.log.folder
