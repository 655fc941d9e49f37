"""`deixis record`: writes the messages on the bus to a log file."""

from __future__ import annotations

import argparse
import re
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.channel_patterns import any_of, channel_pattern
from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.interrupts import end_as_by_ctrl_c, held_back
from deixis_frontend.lcm_tools import find_logger, url_option
from deixis_frontend.number_options import above_zero
from deixis_frontend.output_files import UnfinishedFile

_POLL_S = 0.1
_SAY_EVERY_S = 2.0
_MOST_ERRORS = 50  # lines
_DROPPED = re.compile(r"Dropped (\d+) packet")  # in what lcm-logger writes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to, how long, and what."""
    parser.add_argument("channels", nargs="*", type=channel_pattern,
                        help="channels or regular expressions of them (default: all)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE",
                        help="log file (default: output/recordings/<time>.lcmlog);"
                             " missing folders are created")
    parser.add_argument("--seconds", type=above_zero, metavar="N", help="stop after N seconds")
    parser.add_argument("--force", action="store_true", help="replace a file that is there")


def run(arguments: argparse.Namespace) -> int:
    """0 when messages were recorded; Ctrl-C, SIGTERM and SIGHUP end the recording alike."""
    url = lcm_url.choose(arguments.lcm_url)
    lcm_url.require_bus(url)
    command = [find_logger(), url_option(url), "--force", f"--channel={any_of(arguments.channels).pattern}"]
    output = arguments.output or _default_output()
    _make_folder(output.parent)
    file = UnfinishedFile(output, "--output", may_replace=arguments.force)
    _announce(file, "" if arguments.seconds else "; Ctrl-C stops")
    end_as_by_ctrl_c(signal.SIGTERM, signal.SIGHUP)
    with held_back() as let_through:
        logger = subprocess.Popen([*command, str(file.path)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, errors="replace",
                                  start_new_session=True,
                                  preexec_fn=end_with_parent(signal.SIGINT))
        words = _Words(logger)
        _wait(logger, arguments.seconds, file, let_through)
    return _conclude(logger, file, words)


class _Words:
    """What the logger says: read all the time, since it would stop when nobody took it.

    What it has dropped, since the disk was too slow, it says once per second, on stdout; what it
    drops in its last second it does not say.
    """

    def __init__(self, logger: subprocess.Popen[str]) -> None:
        assert logger.stdout is not None and logger.stderr is not None
        self._dropped = 0
        self._last_errors: deque[str] = deque(maxlen=_MOST_ERRORS)
        self._readers = [threading.Thread(target=self._count_drops, args=[logger.stdout], daemon=True),
                         threading.Thread(target=self._keep_errors, args=[logger.stderr], daemon=True)]
        for reader in self._readers:
            reader.start()

    def end(self) -> tuple[int, list[str]]:
        """Messages dropped, at least, and its last errors; to be asked when the logger has ended."""
        for reader in self._readers:
            reader.join()
        return self._dropped, list(self._last_errors)

    def _count_drops(self, lines: Iterable[str]) -> None:
        for line in lines:
            if match := _DROPPED.search(line):
                self._dropped += int(match[1])

    def _keep_errors(self, lines: Iterable[str]) -> None:
        self._last_errors.extend(line.strip() for line in lines if line.strip())


def _announce(file: UnfinishedFile, cure: str) -> None:
    try:
        print(f"recording to {file.target}{cure}", flush=True)
    except OSError:
        file.discard()
        raise


def _default_output() -> Path:
    folder = layouts.find().state / "output" / "recordings"
    return folder / time.strftime("%Y-%m-%d_%H-%M-%S.lcmlog")


def _make_folder(folder: Path) -> None:
    """As lcm-logger does; said aloud, since a folder that was not there may be a slip."""
    if folder.exists():
        return
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        raise UserError(f"the folder {folder} cannot be made: {error.strerror}:"
                        " name another --output") from None
    print(f"created the folder {folder}", flush=True)


def _wait(logger: subprocess.Popen[str], seconds: float | None, file: UnfinishedFile,
          let_through: Callable[[], None]) -> None:
    began = said = time.monotonic()
    try:
        let_through()
        while logger.poll() is None:
            now = time.monotonic()
            if seconds is not None and now - began >= seconds:
                break
            if now - said >= _SAY_EVERY_S and sys.stdout.isatty():
                print(f"\r{now - began:.0f} s, {_megabytes(file)}", end="", flush=True)
                said = now
            time.sleep(_POLL_S)
    except KeyboardInterrupt:
        if sys.stdout.isatty():
            print()
    finally:
        logger.send_signal(signal.SIGINT)  # It is in a session of its own: nobody else ends it.


def _conclude(logger: subprocess.Popen[str], file: UnfinishedFile, words: _Words) -> int:
    logger.wait()
    dropped, said = words.end()
    if dropped:
        print(f"deixis: at least {dropped} messages were not recorded, since the disk was too slow:"
              " record fewer channels, or to a faster disk", file=sys.stderr)
    is_empty = not file.size
    if is_empty:
        file.discard()
    if logger.returncode not in (0, -signal.SIGINT):
        kept = "" if is_empty else f"; what came before is kept in {file.path} and can be replayed"
        raise UserError(f"recording to {file.target} ended: {_reason(said)}{kept}")
    if is_empty:
        raise UserError("nothing was recorded: are the services running on this LCM URL?"
                        " (`deixis status`)")
    size = _megabytes(file)
    file.keep()
    print(f"recorded {size} to {file.target}")
    return 0


def _reason(said: list[str]) -> str:
    if any("No space left" in line for line in said):
        return "the disk is full: make room, or name an --output on another disk"
    return said[-1] if said else "lcm-logger gave no reason"


def _megabytes(file: UnfinishedFile) -> str:
    return f"{file.size / 1e6:.1f} MB"
