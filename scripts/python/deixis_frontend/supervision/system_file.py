"""The system file: which services there are, how they are started and kept alive."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from pathlib import Path

from deixis_frontend.errors import Refusal, UserError
from deixis_frontend.supervision import strict_yaml
from deixis_frontend.supervision.strict_yaml import Section

SHORTEST_SILENCE_S = 2.0
RESTARTS = ("always", "on_failure", "never")
SERVICE_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")


@dataclass(frozen=True)
class LogSettings:
    """Where the services' output goes and how much of it is kept."""

    folder: str = "logs"
    size_mb: float = 5.0
    count: int = 3


@dataclass(frozen=True)
class ServiceEntry:
    """One service of the system file."""

    name: str
    service: str  # as the service calls itself in its status
    program: str
    instance: str = ""
    config: str = ""
    settings: dict[str, str] = field(default_factory=dict)
    args: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    after: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    restart: str = "on_failure"
    ready_within_s: float = 15.0
    stop_within_s: float = 5.0
    give_up_after: int = 3
    restart_when_silent_s: float = 10.0  # 0 = never


@dataclass(frozen=True)
class System:
    """A read and checked system file."""

    name: str
    path: Path
    channel_prefix: str
    start: tuple[str, ...]
    log: LogSettings
    services: dict[str, ServiceEntry]
    digest: str = ""  # of the file's text

    def groups(self) -> list[str]:
        """All groups, in the order of the file."""
        return list(dict.fromkeys(g for entry in self.services.values() for g in entry.groups))

    def resolve(self, names: list[str]) -> list[str]:
        """The services that groups and services in `names` mean, in the order of the file."""
        wanted = {service for name in names for service in self._members(name)}
        return [name for name in self.services if name in wanted]

    def with_needs(self, names: list[str]) -> list[str]:
        """`names` and all that they need; those that others wait for come before these."""
        wanted: set[str] = set()
        pending = list(names)
        while pending:
            name = pending.pop()
            if name not in wanted:
                wanted.add(name)
                pending.extend(self.services[name].needs)
        return [name for name in self._in_order() if name in wanted]

    def _in_order(self) -> list[str]:
        order: dict[str, None] = {}

        def visit(name: str) -> None:
            if name not in order:
                for other in (*self.services[name].after, *self.services[name].needs):
                    visit(other)
                order[name] = None

        for name in self.services:
            visit(name)
        return list(order)

    def _members(self, name: str) -> list[str]:
        if name in self.services:
            return [name]
        members = [entry.name for entry in self.services.values() if name in entry.groups]
        if not members:
            raise UserError(f"no service or group '{name}' in {self.path}: there are"
                            f" {', '.join([*self.groups(), *self.services])}")
        return members


def load(path: Path) -> System:
    """Reads a system file; raises Refusal with all its faults."""
    top = strict_yaml.read(path)
    system = System(
        name=top.text("name", "deixis"),
        path=path,
        channel_prefix=top.text("channel_prefix", ""),
        start=top.texts("start"),
        log=_log(top.section("log")),
        services=_services(top),
        digest=hashlib.sha256(path.read_bytes()).hexdigest(),
    )
    top.finish()
    _check(system, top)
    if top.faults:
        raise Refusal(list(dict.fromkeys(top.faults)))
    return system


def _log(section: Section | None) -> LogSettings:
    if section is None:
        return LogSettings()
    settings = LogSettings(
        folder=section.text("folder", LogSettings.folder),
        size_mb=section.number("size_mb", LogSettings.size_mb, 0.001, 10_000),
        count=section.integer("count", LogSettings.count, 1, 100),
    )
    section.finish()
    return settings


def _services(top: Section) -> dict[str, ServiceEntry]:
    services = top.section("services")
    if services is None:
        top.fault("services", "missing: a system has at least one service")
        return {}
    return {name: _service(name, section) for name, section in services.sections()}


def _service(name: str, section: Section) -> ServiceEntry:
    default = ServiceEntry(name, name, "")
    service = section.text("service", name)
    entry = ServiceEntry(
        name=name,
        service=service,
        program=section.text("program", "deixis-" + service.replace("_", "-")),
        instance=section.text("instance", ""),
        config=section.text("config", ""),
        settings=section.settings("set"),
        args=section.texts("args"),
        groups=section.texts("groups"),
        after=section.texts("after"),
        needs=section.texts("needs"),
        restart=section.choice("restart", default.restart, RESTARTS),
        ready_within_s=section.number("ready_within_s", default.ready_within_s, 0.1, 600),
        stop_within_s=section.number("stop_within_s", default.stop_within_s, 0.1, 600),
        give_up_after=section.integer("give_up_after", default.give_up_after, 1, 100),
        restart_when_silent_s=_silence(section, default.restart_when_silent_s),
    )
    section.finish()
    return entry


def _silence(section: Section, default: float) -> float:
    key = "restart_when_silent_s"
    value = section.number(key, default, 0, 3600)
    if 0 < value < SHORTEST_SILENCE_S:
        section.fault(key, f"{value:g} is neither 0 nor {SHORTEST_SILENCE_S:g} or more: a service"
                           " speaks once a second, and may be busy")
        return default
    return value


def _check(system: System, top: Section) -> None:
    for name in (system.name, *system.services):
        if not SERVICE_NAME.fullmatch(name):
            key = "name" if name == system.name else f"services.{name}"
            top.fault(key, f"'{name}' is not made of letters, digits, '_' and '-' alone")
    known = {*system.services, *system.groups()}
    for name in system.start:
        if name not in known:
            top.fault("start", f"names '{name}', which is no service or group of this file")
    for group in set(system.groups()) & set(system.services):
        top.fault("services", f"'{group}' is the name of both a service and a group: rename one")
    for entry in system.services.values():
        _check_references(system, entry, top)
    _check_twins(system, top)


def _check_references(system: System, entry: ServiceEntry, top: Section) -> None:
    for key, names in (("after", entry.after), ("needs", entry.needs)):
        for name in names:
            if name not in system.services:
                top.fault("services",
                          f"{entry.name}.{key} names '{name}', which is no service here")
    if _leads_back(system, entry.name):
        top.fault("services", f"{entry.name} waits for itself by way of its 'after' and 'needs'")


def _check_twins(system: System, top: Section) -> None:
    seen: dict[tuple[str, str], str] = {}
    for entry in system.services.values():
        twin = seen.setdefault((entry.service, entry.instance), entry.name)
        if twin != entry.name:
            top.fault("services", f"{twin} and {entry.name} are the same service and instance:"
                                  " their states could not be told apart: give one an 'instance'")


def _leads_back(system: System, start: str) -> bool:
    seen: set[str] = set()
    pending = [start]
    while pending:
        entry = system.services.get(pending.pop())
        for name in (*entry.after, *entry.needs) if entry else ():
            if name == start:
                return True
            if name not in seen:
                seen.add(name)
                pending.append(name)
    return False
