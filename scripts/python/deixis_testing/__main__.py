"""`python -m deixis_testing`: what scripts/test does once everything is built."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from deixis_testing import suites
from deixis_testing.suites import Suite
from deixis_testing.totals import Totals

_ROOT = Path(__file__).resolve().parents[3]


def main(argv: list[str]) -> int:
    """0 when tests ran and none failed."""
    arguments = _parse(argv)
    total = run(_suites(arguments), is_filtered=bool(arguments.filter))
    if arguments.totals:
        arguments.totals.write_text(f"{total.passed} {total.failed} {total.skipped}\n",
                                    encoding="ascii")
    return 1 if total.failed else 0


def run(chosen: list[Suite], *, is_filtered: bool) -> Totals:
    """Runs the suites and prints the sum as the last line.

    A suite without tests is a failure; with a filter only that no suite at all has one.
    """
    total = sum((suite.run(may_be_empty=is_filtered) for suite in chosen), Totals())
    if not total.count:
        print("no test was run: the filter fits none", file=sys.stderr)
        total = Totals(failed=1)
    sys.stderr.flush()
    print(total.line(), flush=True)
    return total


def _parse(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="scripts/test")
    parser.add_argument("filter", nargs="?")
    parser.add_argument("--preset", default="release", choices=("release", "ci", "asan"))
    parser.add_argument("--only", choices=("cpp", "python"))
    parser.add_argument("--totals", type=Path, metavar="FILE")
    return parser.parse_args(argv)


def _suites(arguments: argparse.Namespace) -> list[Suite]:
    folder = "build/asan" if arguments.preset == "asan" else "build/release"
    build = _ROOT / (os.environ.get("DEIXIS_BUILD_DIR") or folder)
    only = "cpp" if arguments.preset == "asan" else arguments.only
    makers = {"cpp": suites.cpp, "python": suites.python}
    return [make(_ROOT, build, arguments.filter) for name, make in makers.items()
            if only in (None, name)]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
