"""Pictures of the figures of `deixis evaluate pointing`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

_ERRORS = ("insertions", "deletions", "substitutions")


def write(report: dict[str, Any], folder: Path) -> None:
    """Errors per column, and recognition and word error rate per column, as PNG files."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    folder.mkdir(parents=True, exist_ok=True)
    columns = {name: figures for name, figures in report["summary"].items()
               if isinstance(figures, dict) and "wer_percent" in figures}
    figure, (errors, rates) = pyplot.subplots(2, 1, figsize=(9, 8), constrained_layout=True)
    _draw_errors(errors, columns)
    _draw_rates(rates, columns)
    figure.savefig(folder / "pointing.png", dpi=120)
    pyplot.close(figure)
    print(f"written: {folder / 'pointing.png'}")


def _draw_errors(axes: Any, columns: dict[str, dict[str, float]]) -> None:
    names = list(columns)
    base = [0.0] * len(names)
    for kind in _ERRORS:
        heights = [columns[name][kind] for name in names]
        axes.bar(names, heights, bottom=base, label=kind)
        base = [low + high for low, high in zip(base, heights)]
    axes.set_ylabel("gestures")
    axes.tick_params(axis="x", rotation=30)
    axes.legend()


def _draw_rates(axes: Any, columns: dict[str, dict[str, float]]) -> None:
    names = list(columns)
    for rate, label in (("wer", "word error rate"), ("recognition", "recognition rate")):
        axes.errorbar(names, [columns[name][f"{rate}_percent"] for name in names],
                      yerr=[columns[name][f"{rate}_spread_percent"] for name in names],
                      marker="o", capsize=3, label=label)
    axes.set_ylabel("percent")
    axes.tick_params(axis="x", rotation=30)
    axes.legend()
