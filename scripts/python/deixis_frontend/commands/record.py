"""`deixis record`: writes the messages on the bus to a log file."""

from __future__ import annotations

import argparse
import signal
import subprocess
import sys
import time
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.errors import UserError
from deixis_frontend.lcm_tools import find_tool, url_option

_POLL_S = 0.1
_SAY_EVERY_S = 2.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to, how long, and what."""
    parser.add_argument("channels", nargs="*",
                        help="channels or regular expressions of them (default: all)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE",
                        help="log file (default: output/recordings/<time>.lcmlog)")
    parser.add_argument("--seconds", type=float, metavar="N", help="stop after N seconds")
    parser.add_argument("--force", action="store_true", help="replace a file that is there")


def run(arguments: argparse.Namespace) -> int:
    """0 when messages were recorded."""
    url = lcm_url.choose(arguments.lcm_url)
    lcm_url.require_multicast(url)
    output = arguments.output or _default_output()
    _prepare(output, arguments.force)
    command = [find_tool("lcm-logger"), url_option(url), "--quiet", "--force",
               f"--channel={_pattern(arguments.channels)}", str(output)]
    print(f"recording to {output}" + ("" if arguments.seconds else "; Ctrl-C stops"), flush=True)
    logger = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              start_new_session=True)
    _wait(logger, arguments.seconds, output)
    return _conclude(logger, output)


def _default_output() -> Path:
    folder = layouts.find().state / "output" / "recordings"
    return folder / time.strftime("%Y-%m-%d_%H-%M-%S.lcmlog")


def _prepare(output: Path, may_replace: bool) -> None:
    if output.exists() and not may_replace:
        raise UserError(f"{output} is there already: name another --output, or give --force")
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with output.open("wb"):
            return
    except OSError as error:
        raise UserError(f"{output} cannot be written: {error.strerror}:"
                        " name another --output") from None


def _pattern(channels: list[str]) -> str:
    return "|".join(f"({channel})" for channel in channels) if channels else ".*"


def _wait(logger: subprocess.Popen[str], seconds: float | None, output: Path) -> None:
    began = said = time.monotonic()
    try:
        while logger.poll() is None:
            now = time.monotonic()
            if seconds is not None and now - began >= seconds:
                break
            if now - said >= _SAY_EVERY_S and sys.stdout.isatty():
                print(f"\r{now - began:.0f} s, {_megabytes(output)}", end="", flush=True)
                said = now
            time.sleep(_POLL_S)
    except KeyboardInterrupt:
        print()
    logger.send_signal(signal.SIGINT)


def _conclude(logger: subprocess.Popen[str], output: Path) -> int:
    said = (logger.communicate()[1] or "").strip().splitlines()
    if logger.returncode not in (0, -signal.SIGINT):
        raise UserError(f"recording to {output} ended: {_reason(said)}."
                        " What was recorded before is kept and can be replayed")
    if not output.stat().st_size:
        output.unlink()
        raise UserError("nothing was recorded: are the services running on this LCM URL?"
                        " (`deixis status`)")
    print(f"recorded {_megabytes(output)} to {output}")
    return 0


def _reason(said: list[str]) -> str:
    if any("No space left" in line for line in said):
        return "the disk is full: make room, or name an --output on another disk"
    return said[-1] if said else "lcm-logger gave no reason"


def _megabytes(path: Path) -> str:
    return f"{path.stat().st_size / 1e6:.1f} MB"
