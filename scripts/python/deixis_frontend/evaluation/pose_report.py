"""The tables of `deixis evaluate pose`."""

from __future__ import annotations

from typing import Any

_LOST = "lost"  # in place of a figure that falls on what was missed
_ERROR_HEADING = (f"{'':<24}{'joints':>8}{'median mm':>11}{'p95 mm':>9}{'<10 cm %':>10}")
_MORE = (f"{'lost %':>8}{'start':>7}{'again':>7}{'hidden mm':>11}{'angle deg':>11}{'p95':>7}{'cover90 %':>11}"
         f"{'hid. 90':>9}{'overclaim %':>13}{'ids':>5}{'false/min':>11}{'ms':>8}{'p99':>8}")
HEADING = _ERROR_HEADING + _MORE
LEGEND = """\
Errors of visible joints; missed ones are infinitely wrong ("lost" where a figure falls on them). lost: frames in which
nobody stands for the person, or most visible joints are off by more than 15 cm. start, again: frames until the first
and each further start, medians. hidden: median of hidden joints. cover90: share of visible joints inside the stated
90 % ellipsoid, hid. 90: of hidden ones. overclaim: share called measured of the visible joints that are off by more
than 15 cm. ids: changes of the person's number. false/min: people where nobody is. ms: CPU time per depth image."""


def show(report: dict[str, Any]) -> None:
    """Prints one table per column: sequences, joints, stretches, then the whole."""
    for column, summary in report["summary"].items():
        print(f"\n{column.replace('_', ' ')}\n{HEADING}")
        for row in report["sequences"]:
            if row["column"] == column:
                print(_errors(row["name"], row, "visible_") + _more(row))
        print(_errors("all", summary, "visible_") + _more(summary))
        _show_parts(summary)
    if report["summary"]:
        print(LEGEND)


def _show_parts(summary: dict[str, Any]) -> None:
    print(f"{_ERROR_HEADING}{'x off mm':>10}{'y off mm':>10}{'z off mm':>10}")
    for kind, figures in summary["joints"].items():
        print(_errors(kind, figures, "") + "".join(_number(figures[f"{axis}_bias_m"], 10, 0, 1000)
                                                   for axis in "xyz"))
    print("angles: " + "; ".join(f"{name} {_number(a['median_deg'], 0)} p95 {_number(a['p95_deg'], 0)} deg"
                                 for name, a in summary["angles"].items()))
    print("lengths: " + "; ".join(f"{name} {_number(a['median'], 0, 0, 1000)} mm"
                                  for name, a in summary["length_error_m"].items()))
    if summary["segments"]:
        print(f"{_ERROR_HEADING}{'hidden mm':>11}{'lost joints':>13}{'longest s':>11}  worst joint")
    for label, figures in summary["segments"].items():
        print(_errors(label, figures, "visible_") + _number(figures["hidden_median_m"], 11, 0, 1000)
              + f"{figures['lost_episodes']:>13}{figures['longest_lost_s']:>11.2f}  {figures['worst_joint']}")
    for lost in summary["longest_lost"][:3]:
        print(f"longest lost: {', '.join(lost['joints'])} in {lost['sequence']} from frame {lost['start_frame']},"
              f" {lost['seconds']:.1f} s")


def _errors(name: str, figures: dict[str, Any], prefix: str) -> str:
    count = figures[f"{prefix}count"]
    missing = _LOST if count else "-"
    return (f"{name:<24}{count:>8}{_number(figures[f'{prefix}median_m'], 11, 1, 1000, missing)}"
            f"{_number(figures[f'{prefix}p95_m'], 9, 1, 1000, missing)}"
            f"{_number(figures['within_10cm_percent'], 10)}")


def _more(figures: dict[str, Any]) -> str:
    missing = _LOST if figures["hidden_count"] else "-"
    return (f"{_number(figures['lost_frames_percent'], 8)}{_number(figures['start_frames_median'], 7, 0)}"
            f"{_number(figures['restart_frames_median'], 7, 0)}"
            f"{_number(figures['hidden_median_m'], 11, 1, 1000, missing)}"
            f"{_number(figures['angle_median_deg'], 11, 1, 1, _LOST)}"
            f"{_number(figures['angle_p95_deg'], 7, 1, 1, _LOST)}"
            f"{_number(figures['coverage90_percent'], 11)}{_number(figures['hidden_coverage90_percent'], 9)}"
            f"{_number(figures['overclaim_percent'], 13)}{figures['id_switches']:>5}"
            f"{_number(figures['false_people_per_min'], 11)}{_number(figures['fit_ms_median'], 8)}"
            f"{_number(figures['fit_ms_p99'], 8)}")


def _number(value: float | None, width: int, digits: int = 1, scale: float = 1.0, missing: str = "-") -> str:
    return f"{missing if value is None else f'{scale * value:.{digits}f}':>{width}}"
