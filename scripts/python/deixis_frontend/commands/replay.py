"""`deixis replay`: publishes the messages of a log file as they came."""

from __future__ import annotations

import argparse
import subprocess
from pathlib import Path

from deixis_frontend import lcm_url
from deixis_frontend.errors import UserError
from deixis_frontend.lcm_tools import find_tool, require_log, url_option


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What, and how fast."""
    parser.add_argument("file", type=Path, help="log file")
    parser.add_argument("--speed", type=_speed, default=1.0, metavar="X",
                        help="2 = twice as fast as recorded (default: 1)")
    parser.add_argument("--channels", default=".*", metavar="REGEX",
                        help="only these (default: all)")


def run(arguments: argparse.Namespace) -> int:
    """0 when the log was played to its end."""
    url = lcm_url.choose(arguments.lcm_url)
    require_log(arguments.file)
    lcm_url.require_multicast(url)
    command = [find_tool("lcm-logplayer"), url_option(url), f"--speed={arguments.speed:g}",
               f"--regexp={arguments.channels}", str(arguments.file)]
    code = subprocess.run(command, check=False).returncode
    if code:
        raise UserError(f"lcm-logplayer ended with exit code {code}: see its message above")
    return 0


def _speed(text: str) -> float:
    speed = float(text)
    if not speed > 0:
        raise argparse.ArgumentTypeError("must be above 0")
    return speed
