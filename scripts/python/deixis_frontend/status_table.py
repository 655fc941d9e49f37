"""The status of a system as a table for people."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from deixis_frontend import text_table

_HEADER = ("service", "state", "pid", "uptime", "restarts", "in Hz", "out Hz", "lost", "work ms",
           "age ms", "CPU %", "MB")
_ALL_CHANNELS = "*"  # as the C++ services name what cannot be told by channel
_LEFT = 2  # columns that are flush left


def render(status: dict[str, Any], own_file: Path) -> str:
    """The table, and below it a line for everything that needs words.

    A system that was started from another file than `own_file` is told by its file.
    """
    rows = [_HEADER, *(_row(service) for service in status["services"])]
    origin = "" if status["file"] == str(own_file) else f" from {status['file']}"
    lines = [f"{status['system']}{origin} on {status['lcm_url']}, supervisor pid"
             f" {status['supervisor_pid']}, up {duration(status['uptime_s'])}"]
    lines += text_table.lines(rows, _LEFT)
    lines += [status["trouble"]] if status.get("trouble") else []
    lines += [note for service in status["services"] for note in _notes(service)]
    return "\n".join(lines)


def duration(seconds: float | None) -> str:
    """Seconds in the unit that suits them: 8 s, 12:05, 3:00:07."""
    if seconds is None:
        return "-"
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours}:{minutes:02}:{rest:02}"
    return f"{minutes}:{rest:02}" if minutes else f"{rest} s"


def lost(service: dict[str, Any]) -> int:
    """Messages that did not arrive or were thrown away; those passed over for newer ones apart."""
    return sum(channel["gaps"] + sum(channel["drops"].values())
               for channel in service.get("channels", []))


def _row(service: dict[str, Any]) -> tuple[str, ...]:
    return (
        service["name"], service["state"], _text(service["pid"]), duration(service["uptime_s"]),
        str(service["restarts"]), _rate(service, "in"), _rate(service, "out"),
        str(lost(service)) if "channels" in service else "-",
        _percentiles(service.get("processing_ms")), _percentiles(service.get("age_ms")),
        _text(service["cpu_percent"]), _text(service["memory_mb"]),
    )


def _rate(service: dict[str, Any], direction: str) -> str:
    if "channels" not in service:
        return "-"
    rates = [c["rate_hz"] for c in service["channels"] if c["direction"] == direction]
    return f"{sum(rates):.1f}"


def _percentiles(values: dict[str, float | None] | None) -> str:
    if not values or values["p50"] is None or values["p99"] is None:
        return "-"
    return f"{values['p50']:.1f}/{values['p99']:.1f}"


def _notes(service: dict[str, Any]) -> list[str]:
    notes = [service["last_error"] and f"last error: {service['last_error']}",
             service.get("text"),
             service["stranger"] and f"another one of its name speaks on this bus:"
                                     f" {service['stranger']}",
             service["log_bytes_lost"] and f"{service['log_bytes_lost']} bytes of its log are lost:"
                                           " is there room in log.folder?"]
    for channel in service.get("channels", []):
        if channel["drops"]:
            reasons = ", ".join(f"{count} {reason}" for reason, count in channel["drops"].items())
            where = "any channel" if channel["name"] == _ALL_CHANNELS else channel["name"]
            notes.append(f"dropped on {where}: {reasons}")
    return [f"{service['name']}: {note}" for note in notes if note]


def _text(value: object) -> str:
    return "-" if value is None else str(value)
