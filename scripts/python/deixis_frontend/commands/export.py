"""`deixis export`: turns a log into an MCAP file, for Foxglove."""

from __future__ import annotations

import argparse
import signal
import sys
from pathlib import Path
from typing import Any

from deixis_frontend import layout as layouts
from deixis_frontend.channel_patterns import channel_pattern
from deixis_frontend.errors import UserError
from deixis_frontend.interrupts import end_as_by_ctrl_c
from deixis_frontend.lcm_tools import require_log
from deixis_frontend.output_files import UnfinishedFile
from deixis_frontend.printable import printable
from deixis_frontend.progress_bar import ProgressBar

DEFAULT_BUS = "none, for none is needed"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What, where to, and what of it."""
    parser.add_argument("log", type=Path, help="LCM log, of `record` or `run-offline`")
    parser.add_argument("--mcap", type=Path, metavar="FILE", required=True,
                        help="MCAP file to write, with Foxglove's schemas (protobuf)")
    parser.add_argument("--channels", type=channel_pattern, default=".*", metavar="REGEX",
                        help="only these (default: all)")
    parser.add_argument("--force", action="store_true", help="replace a file that is there")


def run(arguments: argparse.Namespace) -> int:
    """0 when messages were written, to the end of the log, damaged or not."""
    layouts.find().use_types()
    from deixis_frontend.export.log_export import export

    require_log(arguments.log)
    if arguments.mcap.resolve() == arguments.log.resolve():
        raise UserError(f"log and --mcap are the same file {arguments.log}: name another --mcap")
    end_as_by_ctrl_c(signal.SIGTERM, signal.SIGHUP)
    with UnfinishedFile(arguments.mcap, "--mcap", may_replace=arguments.force) as output:
        with ProgressBar(arguments.log.stat().st_size) as bar:
            exported = export(arguments.log, output, arguments.channels, bar.show)
        _tell_faults(arguments.log, exported)
        if not exported.written:
            raise UserError(_why_nothing(arguments, exported))
        size_mb = output.size / 1e6
        output.keep()
    print(f"wrote {exported.written} messages ({size_mb:.1f} MB) to {arguments.mcap}")
    for words, count in sorted(exported.left_out.items()):
        print(f"left out: {count} of {printable(words)}")
    return 0


def _tell_faults(log: Path, exported: Any) -> None:
    if exported.damage:
        print(f"deixis: {log}: {exported.damage}", file=sys.stderr)
    if exported.refused:
        print(f"deixis: {log}: {exported.refused} messages were passed over, the last:"
              f" {printable(exported.last_refusal)}", file=sys.stderr)


def _why_nothing(arguments: argparse.Namespace, exported: Any) -> str:
    if exported.read:
        kinds = ", ".join(map(printable, sorted(exported.left_out))) or "what does not decode"
        return f"nothing was written: {arguments.log} has nothing to show, only {kinds}"
    if not exported.other_channels:
        return f"nothing was written: {arguments.log} holds no whole message"
    return (f"nothing was written: no channel is '{arguments.channels.pattern}': {arguments.log}"
            f" has {', '.join(map(printable, sorted(exported.other_channels)))}")
