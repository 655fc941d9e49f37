"""`deixis doctor`: looks for what keeps messages from arriving, and names the cures."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.commands.system_option import add_system, open_system
from deixis_frontend.doctor import fixing, installation, machine, network, services
from deixis_frontend.doctor.command_lines import CommandLines
from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Check, Finding, examine
from deixis_frontend.doctor.wanted_cameras import wanted_cameras
from deixis_frontend.channel_patterns import any_of
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.listening.publisher_names import PublisherNames
from deixis_frontend.listening.source import Live
from deixis_frontend.listening.traffic import Traffic, listen
from deixis_frontend.number_options import above_zero
from deixis_frontend.supervision.supervisor import log_folder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """How long to listen, whether to cure, and the form of the output."""
    parser.add_argument("--seconds", type=above_zero, default=3.0, metavar="N",
                        help="listen to the bus for N seconds (default: 3)")
    parser.add_argument("--fix", action="store_true",
                        help="run the cures of route and receive buffer, each after asking")
    parser.add_argument("--yes", action="store_true", help="with --fix: do not ask")
    parser.add_argument("--json", action="store_true", help="all findings as JSON")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when there is no problem; warnings are none."""
    url, layout = lcm_url.choose(arguments.lcm_url), layouts.find()
    commands = CommandLines(layout.launcher, url, arguments.system)
    report = _Report(is_quiet=arguments.json)
    _examine_network(report, commands, arguments)
    report.take("python", lambda: installation.python(layout))
    report.take("recorder", installation.recorder)
    clock = machine.ClockWatch()
    report.take("system", lambda: _of_system(arguments, commands, layout))
    if report.has_bus:
        report.take("listening", lambda: _of_traffic(arguments, commands, layout))
    report.take("clock", clock.findings)
    report.conclude(url)
    return 1 if report.count(PROBLEM) else 0


class _Report:
    """Findings, printed as they come."""

    def __init__(self, *, is_quiet: bool) -> None:
        self._is_quiet = is_quiet
        self._findings: list[Finding] = []

    @property
    def has_bus(self) -> bool:
        """Whether there is something to listen to."""
        return not any(finding.level == PROBLEM and finding.check in ("bus", "multicast_route")
                       for finding in self._findings)

    def take(self, name: str, check: Check) -> None:
        """What a check finds."""
        for finding in examine(name, check):
            self.add(finding)

    def add(self, finding: Finding) -> None:
        """One line."""
        self._findings.append(finding)
        if not self._is_quiet:
            print(finding.line(), flush=True)

    def count(self, level: str) -> int:
        """How many findings are that bad."""
        return sum(finding.level == level for finding in self._findings)

    def conclude(self, url: LcmUrl) -> None:
        """The last line, or all as JSON."""
        problems, warnings = self.count(PROBLEM), self.count(WARNING)
        if self._is_quiet:
            print(json.dumps({"lcm_url": str(url), "problems": problems, "warnings": warnings,
                              "findings": [finding.facts() for finding in self._findings]},
                             indent=2))
        else:
            print(f"{self.count(OK)} ok, {_counted(warnings, WARNING)},"
                  f" {_counted(problems, PROBLEM)}")


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _examine_network(report: _Report, commands: CommandLines,
                     arguments: argparse.Namespace) -> None:
    findings = _of_network(commands)
    if arguments.fix and fixing.fix(findings, is_agreed=arguments.yes):
        findings = _of_network(commands)
    for finding in findings:
        report.add(finding)


def _of_network(commands: CommandLines) -> list[Finding]:
    checks = {"bus": network.bus, "receive_buffer": network.receive_buffer, "reach": network.reach,
              "fence": lambda url: network.fence(url, commands)}
    return [finding for name, check in checks.items()
            for finding in examine(name, lambda check=check: check(commands.url))]


def _of_system(arguments: argparse.Namespace, commands: CommandLines,
               layout: Layout) -> list[Finding]:
    """Programs, disk, cameras and supervisor of the system file."""
    system, client = open_system(arguments)
    folders: list[Path] = [log_folder(system, layout), layout.state / "output"]
    return [finding for name, check in {
        "programs": lambda: installation.programs(layout, system),
        "disk": lambda: [finding for folder in folders for finding in machine.disk(folder)],
        "camera": lambda: machine.cameras(wanted_cameras(system, layout)),
        "system": lambda: services.supervisor(client, system, commands),
    }.items() for finding in examine(name, check)]


def _of_traffic(arguments: argparse.Namespace, commands: CommandLines,
                layout: Layout) -> list[Finding]:
    """What is heard on the bus, for some seconds."""
    traffic = Traffic(layout)
    names = PublisherNames(listen(Live(commands.url, any_of([]), arguments.seconds), traffic))
    granted = lcm_url.granted_buffer(lcm_url.RECEIVE_BUFFER_BYTES)
    return [*services.publishers(traffic, names, commands), *services.types(traffic, commands),
            *services.loss(traffic, granted, commands), *services.versions(traffic, commands)]
