"""A stereo rig on disk: two equal cameras side by side, as OpenCV's stereo_calib writes them."""

from __future__ import annotations

from pathlib import Path

WIDTH, HEIGHT = 320, 240
FOCAL_PX, BASELINE_M = 300.0, 0.1


def write_rig(folder: Path) -> list[str]:
    """Writes intrinsics.yml and extrinsics.yml; returns the stereo driver's settings that name them."""
    lens = [FOCAL_PX, 0.0, (WIDTH - 1) / 2, 0.0, FOCAL_PX, (HEIGHT - 1) / 2, 0.0, 0.0, 1.0]
    straight = [0.0] * 5
    _write(folder / "intrinsics.yml", _matrix("M1", 3, lens), _matrix("D1", 1, straight),
           _matrix("M2", 3, lens), _matrix("D2", 1, straight))
    _write(folder / "extrinsics.yml",
           _matrix("R", 3, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
           _matrix("T", 3, [-BASELINE_M, 0.0, 0.0]))
    return [f"calibration.intrinsics={folder}/intrinsics.yml",
            f"calibration.extrinsics={folder}/extrinsics.yml"]


def _matrix(name: str, rows: int, numbers: list[float]) -> str:
    return (f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {len(numbers) // rows}\n"
            f"   dt: d\n   data: {numbers}\n")


def _write(path: Path, *matrices: str) -> None:
    path.write_text("%YAML:1.0\n---\n" + "".join(matrices), encoding="ascii")
