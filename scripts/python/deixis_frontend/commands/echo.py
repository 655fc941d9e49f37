"""`deixis echo`: prints messages, live or of a log."""

from __future__ import annotations

import argparse
import signal
import sys
import time
from contextlib import suppress
from typing import Any

from deixis_frontend import layout as layouts
from deixis_frontend.errors import UserError
from deixis_frontend.interrupts import end_as_by_ctrl_c
from deixis_frontend.listening import fields, source, text_forms
from deixis_frontend.listening.decoder import Decoder, Message
from deixis_frontend.listening.fields import NoSuchField, field_path
from deixis_frontend.listening.source import Arrival, Source
from deixis_frontend.number_options import positive_count


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which messages, which fields of them, in which form."""
    source.add_arguments(parser)
    parser.add_argument("--field", action="append", type=field_path, default=[], metavar="PATH",
                        help="only this, as hands[0].centre_px or hands[*].id; repeatable")
    parser.add_argument("--count", type=positive_count, metavar="N", help="stop after N messages")
    parser.add_argument("--json", action="store_true",
                        help="one JSON object per line; NaN and infinity as \"NaN\", \"Infinity\"")
    parser.add_argument("--full", action="store_true",
                        help="bytes in full (base64), not only how many there are")


def run(arguments: argparse.Namespace) -> int:
    """0 when a message was printed; Ctrl-C, SIGTERM and SIGHUP end it alike."""
    printer = _Printer(arguments, Decoder(layouts.find()))
    messages = source.open_source(arguments)
    end_as_by_ctrl_c(signal.SIGTERM, signal.SIGHUP)
    try:
        with suppress(KeyboardInterrupt):
            printer.print_all(messages)
    finally:
        printer.say_what_was_left_out()
    if not printer.arrived:
        raise UserError(source.why_nothing(messages, arguments.channels))
    return 0 if printer.printed else 1


class _Printer:
    """Prints what decodes and has the fields that are asked for; counts the rest."""

    def __init__(self, arguments: argparse.Namespace, decoder: Decoder) -> None:
        self._arguments = arguments
        self._decoder = decoder
        self.arrived = self.printed = 0
        self._without_field: set[tuple[str, str]] = set()

    def print_all(self, messages: Source) -> None:
        """Until there are enough, or no more."""
        for arrival in source.telling_silence(messages, self._arguments.channels):
            if arrival is None:
                continue
            self.arrived += 1
            message = self._decoder.decode(arrival)
            if message is not None:
                self._print(arrival, message)
            if self.printed == self._arguments.count or self._can_print_nothing():
                return

    def _can_print_nothing(self) -> bool:
        """Whether each channel was named and has spoken, without the field that is asked for."""
        asked = {channel.pattern for channel in self._arguments.channels}
        return not self.printed and bool(asked) and asked <= {name for name, _ in self._without_field}

    def say_what_was_left_out(self) -> None:
        """What did not decode, and why."""
        left_out = self._decoder.words()
        if left_out:
            print(f"deixis: printed {self.printed} messages; not printed: {left_out}",
                  file=sys.stderr)

    def _print(self, arrival: Arrival, message: Message) -> None:
        try:
            content = self._content(message)
        except NoSuchField as fault:
            self._say_once(arrival.channel, f"{message.type_name} {fault}")
            return
        self.printed += 1  # First: Ctrl-C may come as soon as it is printed.
        print(self._as_json(arrival, message, content) if self._arguments.json
              else _as_yaml(arrival, message, content), flush=True)

    def _content(self, message: Message) -> Any:
        full = self._arguments.full
        if not self._arguments.field:
            return fields.plain(message.content, is_full=full)
        return {path.text: fields.plain(fields.select(message.content, path), is_full=full)
                for path in self._arguments.field}

    def _as_json(self, arrival: Arrival, message: Message, content: Any) -> str:
        return text_forms.as_json({
            "channel": arrival.channel, "type": message.type_name, "arrived_us": arrival.time_us,
            "bytes": len(arrival.data),
            "fields" if self._arguments.field else "message": content})

    def _say_once(self, channel: str, fault: str) -> None:
        if (channel, fault) not in self._without_field:
            self._without_field.add((channel, fault))
            print(f"deixis: {channel}: {fault}", file=sys.stderr, flush=True)


def _as_yaml(arrival: Arrival, message: Message, content: Any) -> str:
    seconds, microseconds = divmod(arrival.time_us, 1_000_000)
    clock = time.strftime("%H:%M:%S", time.localtime(seconds)) if 0 <= seconds < 2**40 else seconds
    head = (f"--- # {arrival.channel} {message.type_name}, {len(arrival.data)} bytes,"
            f" arrived {clock}.{microseconds:06}")
    return f"{head}\n{text_forms.as_yaml(content)}".rstrip("\n")
