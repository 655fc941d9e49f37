"""`deixis evaluate body`: what follows of a person's sizes and sex from a few lengths.

On people of a survey (ANSUR II) with even numbers; what is inferred with was learned from those with odd ones.
"""

from __future__ import annotations

import argparse
import csv
import io
from pathlib import Path
from statistics import mean
from typing import Any

from deixis_frontend import layout
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program

_SETS = ("", "kph", "kph,oal,ual", "oal,ual,oslp,usl,biacromial_breadth")
_HEADING = (f"{'measure':<20}{'median mm':>10}{'p90 mm':>8}{'p95 mm':>8}{'stated spread mm':>18}"
            f"{'bias mm':>9}{'within 50 %':>13}{'within 90 %':>13}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which survey, what is known of each person, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder with the tables of ANSUR II")
    parser.add_argument("--given", metavar="NAMES",
                        help="measures that are known, as kph,oal,ual (default: four sets in turn: none;"
                             " stature; with both arm lengths; arms, legs and shoulders)")
    parser.add_argument("--error", type=above_zero, default=10.0, metavar="MM",
                        help="standard deviation of these, millimetres (default: 10)")
    report_options.add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    reports = []
    for given in _SETS if arguments.given is None else (arguments.given,):
        reports.append(_measure(arguments, given))
        _show(reports[-1], arguments.error)
    report_options.write_json(arguments, {"error_mm": arguments.error, "sets": reports})
    return 0


def _measure(arguments: argparse.Namespace, given: str) -> dict[str, Any]:
    """The figures with these measures known; those of given ones do not count in the overall ones."""
    known = ["--given", given] if given else []
    report = parse(run_program(layout.find(), "deixis-evaluate-body", "--survey", str(arguments.data),
                               "--error", str(arguments.error), *known))
    inferred = [row for row in report["measures"] if row["measure"] not in report["given"]]
    overall = {key: mean(row[key] for row in inferred)
               for key in ("median_mm", "p90_mm", "within_50", "within_90")} if inferred else {}
    return {**report, "inferred": overall}


def _show(report: dict[str, Any], error_mm: float) -> None:
    known = ",".join(report["given"])
    print(f"{report['people']} people, known: " + (f"{known} +- {error_mm:g} mm" if known else "nothing"))
    print(_HEADING)
    for row in report["measures"]:
        print(f"{row['measure']:<20}{row['median_mm']:>10.1f}{row['p90_mm']:>8.1f}{row['p95_mm']:>8.1f}"
              f"{row['stated_spread_mm']:>18.1f}{row['bias_mm']:>9.1f}{row['within_50']:>13.3f}"
              f"{row['within_90']:>13.3f}")
    if report["inferred"]:
        means = report["inferred"]
        print(f"inferred, mean of measures: median {means['median_mm']:.1f} mm, p90 {means['p90_mm']:.1f} mm,"
              f" within 50 % {means['within_50']:.3f}, within 90 % {means['within_90']:.3f}")
    sex = report["sex"]
    print(f"sex: {sex['accuracy']:.1%} right; {sex['sure_share']:.1%} stated with more than 90 %, of which"
          f" {sex['sure_accuracy']:.1%} right; calibration error {sex['calibration_error']:.3f},"
          f" Brier score {sex['brier']:.3f}")


def parse(text: str) -> dict[str, Any]:
    """The program's tables: measures, a blank line, then the people and their sex."""
    measures, _, people = text.partition("\n\n")
    [last] = csv.DictReader(io.StringIO(people))
    given = last.pop("given")
    facts = {key: float(value) for key, value in last.items()}
    rows = [{key: value if key == "measure" else float(value) for key, value in row.items()}
            for row in csv.DictReader(io.StringIO(measures))]
    return {"given": given.split(";") if given else [], "people": int(facts.pop("people")),
            "measures": rows, "sex": facts}
