"""`deixis evaluate body`: what follows of a person's sizes and sex from a few lengths.

On people of a survey (ANSUR II) with even numbers; what is inferred with was learned from those with odd ones.
"""

from __future__ import annotations

import argparse
import csv
import io
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program

_HEADING = (f"{'measure':<20}{'median mm':>10}{'p95 mm':>8}{'stated spread mm':>18}{'bias mm':>9}"
            f"{'within 90 %':>13}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which survey, what is known of each person, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder with the tables of ANSUR II")
    parser.add_argument("--given", default="kph", metavar="NAMES",
                        help="measures that are known, as kph,oal,ual (default: kph, the stature)")
    parser.add_argument("--error", type=above_zero, default=10.0, metavar="MM",
                        help="standard deviation of these, millimetres (default: 10)")
    report_options.add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    report = parse(run_program(layout.find(), "deixis-evaluate-body", "--survey",
                               str(arguments.data), "--given", arguments.given, "--error",
                               str(arguments.error)))
    print(f"{report['people']} people, known: {arguments.given} +- {arguments.error:g} mm")
    print(_HEADING)
    for row in report["measures"]:
        print(f"{row['measure']:<20}{row['median_mm']:>10.1f}{row['p95_mm']:>8.1f}"
              f"{row['stated_spread_mm']:>18.1f}{row['bias_mm']:>9.1f}{row['within_90']:>13.3f}")
    sex = report["sex"]
    print(f"sex: {sex['accuracy']:.1%} right; {sex['sure_share']:.1%} stated with more than 90 %, of which"
          f" {sex['sure_accuracy']:.1%} right; calibration error {sex['calibration_error']:.3f}")
    report_options.write_json(arguments, report)
    return 0


def parse(text: str) -> dict[str, Any]:
    """The program's tables: measures, a blank line, then the people and their sex."""
    measures, _, people = text.partition("\n\n")
    [last] = csv.DictReader(io.StringIO(people))
    facts = {key: float(value) for key, value in last.items()}
    rows = [{key: value if key == "measure" else float(value) for key, value in row.items()}
            for row in csv.DictReader(io.StringIO(measures))]
    return {"people": int(facts.pop("people")), "measures": rows, "sex": facts}
