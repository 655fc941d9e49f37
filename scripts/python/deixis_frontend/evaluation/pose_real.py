"""Recordings of real people that say something of poses: one module per kind, named in one table.

A kind has NAME, is_in(folder), evaluate(layout, folder, only, chain), which returns `sequences` and `summary`, and
lines(report), which tells them.
"""

from __future__ import annotations

from fnmatch import fnmatch
from pathlib import Path
from types import ModuleType
from typing import Any

from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import pose_cloud, pose_mhad, pose_turning, pose_upper_body
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.sequences import Skipped
from deixis_frontend.layout import Layout

KINDS: tuple[ModuleType, ...] = (pose_cloud, pose_mhad, pose_turning, pose_upper_body)


def find(data: Path, only: str | None) -> list[tuple[ModuleType, Path, str | None]]:
    """Kind, folder and glob of recordings: `data` itself, or those of its folders whose name matches `only`."""
    kind = _kind(data)
    if kind:
        return [(kind, data, only)]
    folders = sorted(path for path in data.iterdir() if path.is_dir()) if data.is_dir() else []
    return [(kind, folder, None) for folder in folders
            if (not only or fnmatch(folder.name, only)) and (kind := _kind(folder))]


def evaluate_all(layout: Layout, found: list[tuple[ModuleType, Path, str | None]],
                 chain: Chain) -> tuple[dict[str, Any], list[Skipped]]:
    """Reports by kind, printed as they come, and what could not be run."""
    reports, failed = {}, []
    for kind, folder, only in found:
        try:
            report = kind.evaluate(layout, folder, only, chain)
            if not report["sequences"]:
                raise UserError(f"no recording there is called {only}")
        except (UserError, ValueError, KeyError, OSError) as error:
            failed.append(Skipped(kind.NAME, str(error)))
            print(f"not run: {kind.NAME} ({error})", flush=True)
            continue
        reports[kind.NAME] = report
        print("\n".join([f"\n{kind.NAME}, nothing given", *kind.lines(report)]), flush=True)
    return reports, failed


def _kind(folder: Path) -> ModuleType | None:
    return next((kind for kind in KINDS if kind.is_in(folder)), None)
