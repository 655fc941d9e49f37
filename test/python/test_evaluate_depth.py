"""`deixis evaluate depth`: figures of a pair with known disparity, and what is said when there is none."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY

image = pytest.importorskip("matplotlib.image")

_DISPARITY_PX = 12


def _evaluate(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(REPOSITORY / "scripts" / "deixis"), "evaluate", "depth", *arguments],
                          capture_output=True, text=True, timeout=120, check=False)


def _write(path: Path, grey: np.ndarray) -> None:
    image.imsave(path, np.repeat(grey[:, :, None], 3, axis=2))


def _write_pair(folder: Path) -> None:
    wall = np.random.default_rng(5).integers(0, 255, (120, 240 + _DISPARITY_PX), dtype=np.uint8)
    _write(folder / "motorcycle_left.png", wall[:, :240])
    _write(folder / "motorcycle_right.png", wall[:, _DISPARITY_PX:])
    _write(folder / "motorcycle_disp_x256.png", np.full((120, 240), 255, np.uint8))


def test_measures_a_pair(tmp_path: Path) -> None:
    _write_pair(tmp_path)
    # The truth says 255 / 256 px, so that what is measured must be wrong by 11 px.
    figures = tmp_path / "figures.json"
    done = _evaluate("--data", str(tmp_path), "--json", str(figures))
    assert done.returncode == 0, done.stderr
    ours, opencv = json.loads(figures.read_text())["sequences"]
    assert (ours["name"], ours["column"], opencv["column"]) == ("motorcycle", "deixis", "opencv")
    assert ours["error_median_px"] == pytest.approx(_DISPARITY_PX - 255 / 256, abs=0.1)
    assert ours["bad2px_percent"] > 99
    assert ours["bad2px_shared_percent"] > 99
    assert ours["valid_percent"] > 90
    assert ours["lost_percent"] > 99


def test_says_when_there_is_nothing_to_measure(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    done = _evaluate("--data", str(tmp_path))
    assert done.returncode == 1
    assert "not used: empty (no left.mp4)" in done.stdout
    assert "nothing was measured" in done.stderr
    assert "Traceback" not in done.stderr


def test_every_zeroth_frame_is_wrong_usage(tmp_path: Path) -> None:
    done = _evaluate("--data", str(tmp_path), "--every", "0")
    assert done.returncode == 2 and "--every" in done.stderr


def test_names_the_setting_that_is_wrong(tmp_path: Path) -> None:
    _write_pair(tmp_path)
    done = _evaluate("--data", str(tmp_path), "--set", "matcher.disparity.block_px=4")
    assert done.returncode == 1
    assert "block_px" in done.stderr
    assert "Traceback" not in done.stderr
