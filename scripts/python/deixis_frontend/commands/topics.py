"""`deixis topics`: lists channels, their types, and who speaks and listens."""

from __future__ import annotations

import argparse
import json
from typing import Any

from deixis_frontend import layout as layouts
from deixis_frontend import text_table
from deixis_frontend.errors import UserError
from deixis_frontend.listening import source
from deixis_frontend.listening.publisher_names import PublisherNames
from deixis_frontend.listening.source import Source
from deixis_frontend.listening.traffic import Channel, Traffic, listen
from deixis_frontend.number_options import above_zero

_LISTENS_S = 3.0  # SERVICE_STATUS comes once per second
_HEADER = ("channel", "type", "Hz", "kB/s", "messages", "publishers", "subscribers")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """How long to listen, or the log to read, and the form of the output."""
    source.add_log(parser)
    parser.add_argument("--seconds", type=above_zero, metavar="N",
                        help=f"listen N seconds (default: {_LISTENS_S:.0f}; a log: all of it)")
    parser.add_argument("--json", action="store_true", help="as JSON")


def run(arguments: argparse.Namespace) -> int:
    """0 when a message was heard."""
    traffic = Traffic(layouts.find())
    if arguments.log is None and arguments.seconds is None:
        arguments.seconds = _LISTENS_S
    messages = source.open_source(arguments)
    names = PublisherNames(listen(messages, traffic))
    channels = [describe(channel, traffic, names) for channel in traffic.channels()]
    if arguments.json:
        print(json.dumps({"source": messages.name, "seconds": traffic.seconds,
                          "channels": channels}, indent=2))
    elif channels:
        print("\n".join([*_table(channels), *_notes(channels)]))
    if not channels:
        raise UserError(f"no message from {messages.name}: {_cure(messages)}")
    return 0


def describe(channel: Channel, traffic: Traffic, names: PublisherNames) -> dict[str, Any]:
    """A channel as plain values."""
    seconds = traffic.seconds
    unknown = [fingerprint for name, fingerprint in traffic.decoder.unknown if name == channel.name]
    return {
        "channel": channel.name,
        "types": list(channel.types),
        "unknown_fingerprints": unknown,
        "messages": channel.messages,
        "damaged": traffic.decoder.damaged_on(channel.name),
        "rate_hz": channel.messages / seconds if seconds else None,
        "bytes_per_s": channel.bytes / seconds if seconds else None,
        "lost": channel.lost,
        "publishers": names.of(channel),
        "subscribers": channel.subscribers,
        "several_publishers": names.several(channel),
        "wrong_type_refused_by": channel.wrong_types,
    }


def _table(channels: list[dict[str, Any]]) -> list[str]:
    rows = [(channel["channel"], _types(channel), _number(channel["rate_hz"], 1.0),
             _number(channel["bytes_per_s"], 1e-3), str(channel["messages"]),
             ", ".join(channel["publishers"]) or "-", ", ".join(channel["subscribers"]) or "-")
            for channel in channels]
    return text_table.lines([_HEADER, *rows], left=len(_HEADER))


def _notes(channels: list[dict[str, Any]]) -> list[str]:
    return [f"{channel['channel']}: {note}" for channel in channels for note in _faults(channel)]


def _faults(channel: dict[str, Any]) -> list[str]:
    faults = [f"{service} refused {count} messages of the wrong type since its start"
              for service, count in channel["wrong_type_refused_by"].items()]
    if channel["several_publishers"]:
        faults.append(channel["several_publishers"])
    if len(channel["types"]) + len(channel["unknown_fingerprints"]) > 1:
        faults.append("messages of several types")
    if channel["damaged"]:
        faults.append(f"{channel['damaged']} messages do not decode")
    if channel["lost"]:
        faults.append(f"{channel['lost']} messages are missing by their sequence numbers")
    return faults


def _types(channel: dict[str, Any]) -> str:
    unknown = [f"unknown ({fingerprint})" for fingerprint in channel["unknown_fingerprints"]]
    return ", ".join([*channel["types"], *unknown]) or "-"


def _number(value: float | None, factor: float) -> str:
    return "-" if value is None else f"{value * factor:.1f}"


def _cure(messages: Source) -> str:
    return ("are the services running on this LCM URL? (`deixis status`)" if messages.url
            else "name another log")
