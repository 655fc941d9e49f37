"""The configuration of a procman sheriff (libbot2, procman), from a system file.

Grammar: `group "NAME" { cmd "NAME" { KEY = "TEXT"; KEY = NUMBER; } }` and
`script "NAME" { start cmd "NAME"; wait cmd "NAME" status "running"; wait ms N; }`. In a text a
backslash takes the next character as it is; no line ends within one.
"""

from __future__ import annotations

import math
import shlex
import signal
from collections.abc import Iterator
from dataclasses import dataclass

from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.supervision.command_line import command_line
from deixis_frontend.supervision.system_file import ServiceEntry, System


@dataclass(frozen=True)
class Sheriff:
    """Which words a sheriff knows."""

    deputy: str  # the attribute that names the deputy
    knows_stopping: bool  # stop_signal and stop_time_allowed


SHERIFFS = {
    "libbot2": Sheriff("host", knows_stopping=True),
    "libbot2-early": Sheriff("host", knows_stopping=False),
    "procman": Sheriff("deputy", knows_stopping=True),
}


@dataclass(frozen=True)
class Choices:
    """What the system file does not say."""

    sheriff: Sheriff
    deputy: str  # name of the deputy that runs the commands
    wait_ms: int  # from the start of a process till it counts as ready


def render(system: System, layout: Layout, url: LcmUrl, choices: Choices) -> str:
    """The file; raises UserError for what its grammar cannot say."""
    lines = [f"# The services of {system.path.name}, for a procman sheriff.",
             f"group {_quoted(system.name)} {{"]
    for entry in system.services.values():
        lines += [f"    {line}" for line in _command(system, entry, layout, url, choices)]
    lines.append("}")
    for script, names in _scripts(system).items():
        lines += ["", f"script {_quoted(script)} {{"]
        lines += [f"    {action};" for action in _start(system, names, choices.wait_ms)]
        lines.append("}")
    lines += ["", 'script "stop" {', f"    stop group {_quoted(system.name)};", "}"]
    return "\n".join(lines) + "\n"


def _scripts(system: System) -> dict[str, list[str]]:
    """What starts together: what `deixis start` takes when nothing is named, and each group."""
    return {"start": list(system.start) or list(system.services),
            **{f"start {group}": [group] for group in system.groups()}}


def restarted_always(system: System) -> list[str]:
    """Services that procman starts again after exit code 0, too, other than the file says."""
    return [name for name, entry in system.services.items() if entry.restart == "on_failure"]


def _command(system: System, entry: ServiceEntry, layout: Layout, url: LcmUrl,
             choices: Choices) -> Iterator[str]:
    respawns = "false" if entry.restart == "never" else "true"
    yield f"cmd {_quoted(entry.name)} {{"
    yield f"    exec = {_quoted(_words(system, entry, layout, url))};"
    yield f"    {choices.sheriff.deputy} = {_quoted(choices.deputy)};"
    yield f"    auto_respawn = {_quoted(respawns)};"
    if choices.sheriff.knows_stopping:
        yield f"    stop_signal = {int(signal.SIGTERM)};"
        yield f"    stop_time_allowed = {max(1, math.ceil(entry.stop_within_s))};"
    yield "}"


def _words(system: System, entry: ServiceEntry, layout: Layout, url: LcmUrl) -> str:
    """As for a shell. `env` takes the program to the folder that relative paths are meant from."""
    config = layout.environment()["DEIXIS_CONFIG_DIR"]
    words = ["/usr/bin/env", f"--chdir={layout.state}", f"DEIXIS_CONFIG_DIR={config}",
             *command_line(system, entry, layout, url)]
    for word in words:
        if "$" in word or not word.isprintable():
            raise UserError(f"{system.path}: {entry.name}: '{word}' holds a '$' or a character that"
                            " is not printed: procman would change it: choose another text")
    return shlex.join(words)


def _start(system: System, names: list[str], wait_ms: int) -> Iterator[str]:
    """Starts in order; procman knows that a process runs, not that it is ready: hence the wait."""
    wanted = system.with_needs(system.resolve(names))
    ready: set[str] = set()
    for name in wanted:
        entry = system.services[name]
        before = [other for other in wanted
                  if other in (*entry.after, *entry.needs) and other not in ready]
        for other in before:
            yield f'wait cmd {_quoted(other)} status "running"'
        if before:
            yield f"wait ms {wait_ms}"
        ready.update(before)
        yield f"start cmd {_quoted(name)}"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
