"""What running services say, and what is heard of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from deixis_frontend import __version__, lcm_url
from deixis_frontend.doctor.command_lines import CommandLines
from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Finding
from deixis_frontend.listening.publisher_names import PublisherNames
from deixis_frontend.listening.traffic import Traffic
from deixis_frontend.printable import printable
from deixis_frontend.supervision.control_client import Client
from deixis_frontend.supervision.system_file import SERVICE_NAME, System

_KERNEL_DROPPED = "kernel_buffer_full"


def supervisor(client: Client, system: System, commands: CommandLines) -> list[Finding]:
    """Whether the system runs, and on the bus that we look at."""
    if not client.is_supervised():
        return [Finding(OK, "system", f"'{system.name}' does not run")]
    running = client.command("status", [])["status"]["lcm_url"]
    if running == str(commands.url):
        return [Finding(OK, "system", f"'{system.name}' runs on {running}")]
    return [Finding(WARNING, "system", f"'{system.name}' runs on {running}, we look at"
                    f" {commands.url}", replace(commands, url=lcm_url.parse(running)).on_bus("doctor"))]


def publishers(traffic: Traffic, names: PublisherNames,
               commands: CommandLines) -> list[Finding]:
    """More than one publisher on a channel that is made for one."""
    findings = [Finding(PROBLEM, "publishers", f"{channel.name}: {several}: stop one of them",
                        commands.on_bus("topics"))
                for channel in traffic.channels() if (several := names.several(channel))]
    heard = sum(channel.messages > 0 for channel in traffic.channels())
    return findings or [Finding(OK, "publishers", f"{heard} channels, each with one publisher"
                                if heard else "nobody speaks on this bus")]


def types(traffic: Traffic, commands: CommandLines) -> list[Finding]:
    """Channels on which messages do not fit together or do not decode."""
    findings = []
    for channel in traffic.channels():
        show = commands.on_bus("echo", channel.name, "--count", "5")
        if len(channel.types) > 1:
            findings.append(Finding(PROBLEM, "types", f"{channel.name} has messages of several"
                                    f" types: {', '.join(channel.types)}", show))
        if damaged := traffic.decoder.damaged_on(channel.name):
            findings.append(Finding(PROBLEM, "types", f"{damaged} messages on {channel.name} do"
                                    " not decode", show))
    findings += [finding for first, last in traffic.statuses()
                 for finding in _refusals(first, last, traffic.name_of(last), commands)]
    return findings or [Finding(OK, "types", "every message is of one type per channel")]


def _refusals(first: Any, last: Any, service: str, commands: CommandLines) -> list[Finding]:
    before = {(channel.name, drop.reason): drop.count
              for channel in first.channels for drop in channel.drops}
    findings = []
    for channel in last.channels:
        for drop in channel.drops:
            if drop.reason == _KERNEL_DROPPED:
                continue  # It is loss.
            name, reason = printable(channel.name), printable(drop.reason)
            is_going_on = drop.count > before.get((channel.name, drop.reason), 0)
            findings.append(Finding(
                PROBLEM if is_going_on else WARNING, "types",
                f"{service} has refused {drop.count} messages on {name} ({reason})"
                + ("" if is_going_on else ", none of them now"),
                commands.on_bus("echo", name, "--count", "5")))
    return findings


def loss(traffic: Traffic, granted: int, commands: CommandLines) -> list[Finding]:
    """Services that miss messages, or that have a smaller buffer than they would get now."""
    findings = []
    for first, last in traffic.statuses():
        service = traffic.name_of(last)
        if 0 < last.receive_buffer_bytes < granted:
            findings.append(Finding(
                WARNING, "loss", f"{service} has a receive buffer of {last.receive_buffer_bytes}"
                f" bytes, it would get {granted} now",
                _restart(last, commands)))
        if (dropped := _kernel_dropped(last) - _kernel_dropped(first)) > 0:
            findings.append(Finding(
                WARNING, "loss", f"the kernel dropped {dropped} datagrams to {service} while we"
                f" listened: its receive buffer of {last.receive_buffer_bytes} bytes was full",
                f"sysctl -w net.core.rmem_max={lcm_url.RECEIVE_BUFFER_BYTES}, then `deixis restart`; or"
                " smaller messages"))
        before = {channel.name: channel.gaps for channel in first.channels}
        for channel in last.channels:
            lost = channel.gaps - before.get(channel.name, channel.gaps)
            if lost > 0:
                name = printable(channel.name)
                findings.append(Finding(WARNING, "loss", f"{service} misses messages on {name}"
                                        f" ({lost} while we listened)",
                                        commands.on_bus("hz", name)))
    return findings or [Finding(OK, "loss", "no service misses messages")]


def _kernel_dropped(status: Any) -> int:
    return sum(drop.count for channel in status.channels for drop in channel.drops
               if drop.reason == _KERNEL_DROPPED)


def versions(traffic: Traffic, commands: CommandLines) -> list[Finding]:
    """Services that run since before the last build."""
    return [Finding(PROBLEM, "programs", f"{traffic.name_of(status)} runs as version"
                    f" {printable(status.version)}, the front end is {__version__}",
                    _restart(status, commands))
            for _, status in traffic.statuses() if status.version != __version__]


def _restart(status: Any, commands: CommandLines) -> str:
    """The cure; none for a name that no system file can have: anyone may say anything on the bus."""
    is_one = SERVICE_NAME.fullmatch(status.service) is not None
    return commands.on_system("restart", status.service) if is_one else ""
