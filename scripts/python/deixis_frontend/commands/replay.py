"""`deixis replay`: publishes the messages of a log file as they came."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from deixis_frontend import lcm_url, log_player
from deixis_frontend.bus import open_bus
from deixis_frontend.channel_patterns import channel_pattern
from deixis_frontend.errors import UserError
from deixis_frontend.lcm_tools import require_log
from deixis_frontend.log_player import LONGEST_NAME, Played
from deixis_frontend.number_options import above_zero
from deixis_frontend.printable import printable


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What, and how fast."""
    parser.add_argument("file", type=Path, help="log file")
    parser.add_argument("--speed", type=above_zero, default=1.0, metavar="X",
                        help="2 = twice as fast as recorded (default: 1)")
    parser.add_argument("--channels", type=channel_pattern, default=".*", metavar="REGEX",
                        help="only these (default: all)")


def run(arguments: argparse.Namespace) -> int:
    """0 when messages were published and the log was played to its end, damaged or not."""
    url = lcm_url.choose(arguments.lcm_url)
    require_log(arguments.file)
    played = log_player.play(arguments.file, open_bus(url), arguments.channels, arguments.speed)
    if played.damage:
        print(f"deixis: {arguments.file}: {played.damage}", file=sys.stderr)
    if played.unsendable:
        print(f"deixis: {arguments.file}: {played.unsendable} messages were passed over: LCM carries"
              f" channels of 1 to {LONGEST_NAME} bytes without NUL only", file=sys.stderr)
    if not played.published:
        raise UserError(_why_nothing(arguments, played))
    print(f"published {played.published} messages ({played.bytes / 1e6:.1f} MB) on {url}")
    return 0


def _why_nothing(arguments: argparse.Namespace, played: Played) -> str:
    if played.unsendable:
        return f"nothing was published: of {arguments.file} no message can be"
    if not played.other_channels:
        return f"nothing was published: {arguments.file} holds no whole message"
    return (f"nothing was published: no channel is '{arguments.channels.pattern}': {arguments.file}"
            f" has {', '.join(map(printable, sorted(played.other_channels)))}")
