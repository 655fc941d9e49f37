"""`deixis evaluate people`: figures of a small sequence whose truth is known, and what is said when there is none."""

from __future__ import annotations

import json
import struct
import subprocess
import zlib
from pathlib import Path

import numpy as np
from conftest import REPOSITORY

_WIDTH, _HEIGHT, _FOCAL = 160, 120, 140.0
_CAMERA_HEIGHT_M, _PERSON_M, _WALL_M = 1.2, 2.5, 4.0


def _evaluate(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(REPOSITORY / "scripts" / "deixis"), "evaluate", "people", *arguments],
                          capture_output=True, text=True, timeout=120, check=False)


def _write_png(path: Path, pixels: np.ndarray) -> None:
    """Grey, 8 or 16 bits."""
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.astype(pixels.dtype.newbyteorder(">")).tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8 * pixels.itemsize, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows))
                     + chunk(b"IEND", b""))


def _matrix(name: str, values: np.ndarray) -> str:
    rows, columns = values.shape
    data = ", ".join(f"{value:.9e}" for value in values.ravel())
    return f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data: [ {data} ]\n"


def _person(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask and depth, metres, of a head, a trunk and two legs, all round."""
    mask, depth = np.zeros(u.shape, bool), np.zeros(u.shape)
    x, height = _PERSON_M * u, _CAMERA_HEIGHT_M - _PERSON_M * v
    parts = [(0.0, 0.10, 1.5, 1.75), (0.0, 0.20, 0.8, 1.5), (-0.11, 0.08, 0.04, 0.8), (0.11, 0.08, 0.04, 0.8)]
    for centre, radius, low, high in parts:
        here = (np.abs(x - centre) < radius) & (height > low) & (height < high)
        bulge = 0.6 * np.sqrt(np.maximum(0, radius**2 - (x - centre) ** 2))
        depth[here], mask[here] = (_PERSON_M - bulge)[here], True
    return mask, depth


def _write_sequence(folder: Path) -> None:
    for name in ("depth", "mask"):
        (folder / name).mkdir(parents=True)
    lens = np.array([[_FOCAL, 0, _WIDTH / 2 - 0.5], [0, _FOCAL, _HEIGHT / 2 - 0.5], [0, 0, 1]])
    projection = np.hstack([lens, np.zeros((3, 1))])
    head = "%YAML:1.0\n---\n"
    (folder / "intrinsics.yml").write_text(head + _matrix("M1", lens) + _matrix("D1", np.zeros((1, 5))))
    (folder / "extrinsics.yml").write_text(head + _matrix("R1", np.eye(3)) + _matrix("P1", projection))
    floor = np.array([[0, -1.0, 0, _CAMERA_HEIGHT_M]])
    (folder / "camera_world.yml").write_text(head + _matrix("floor_plane_cam", floor))
    (folder / "frames.csv").write_text("frame,time_s,light_factor,person_pixels\n0,0.0,1,1\n1,0.1,1,1\n2,0.2,1,1\n")
    v, u = np.mgrid[0:_HEIGHT, 0:_WIDTH]
    u, v = (u - lens[0, 2]) / _FOCAL, (v - lens[1, 2]) / _FOCAL
    room = np.minimum(_WALL_M, np.where(v > 0, _CAMERA_HEIGHT_M / np.maximum(v, 1e-9), _WALL_M))
    _write_png(folder / "depth" / "room.png", (1000 * room).astype(np.uint16))
    mask, depth = _person(u, v)
    for name in ("000000.png", "000002.png"):
        _write_png(folder / "depth" / name, (1000 * depth).astype(np.uint16))
        _write_png(folder / "mask" / name, mask.astype(np.uint8))


def test_measures_a_sequence(tmp_path: Path) -> None:
    _write_sequence(tmp_path / "one")
    (tmp_path / "other").mkdir()
    figures = tmp_path / "figures.json"
    done = _evaluate("--data", str(tmp_path), "--json", str(figures), "--width", str(_WIDTH))
    assert done.returncode == 0, done.stderr
    assert "not used: other (no intrinsics.yml)" in done.stdout
    report = json.loads(figures.read_text())
    (one,) = report["sequences"]
    assert (one["name"], one["frames"], one["people"], one["found_people"]) == ("one", 2, 2, 2)
    assert one["recall_percent"] > 95
    assert one["precision_percent"] > 95
    assert one["false_regions"] == 0
    assert one["floors"] == 2
    assert one["tilt_median_deg"] < 0.5
    assert one["height_median_m"] < 0.02
    assert report["summary"]["frames"] == 2


def test_counts_what_is_no_person(tmp_path: Path) -> None:
    _write_sequence(tmp_path / "one")
    for mask in (tmp_path / "one" / "mask").iterdir():
        _write_png(mask, np.zeros((_HEIGHT, _WIDTH), np.uint8))
    figures = tmp_path / "figures.json"
    assert _evaluate("--data", str(tmp_path), "--json", str(figures)).returncode == 0
    summary = json.loads(figures.read_text())["summary"]
    assert (summary["people"], summary["false_regions"], summary["precision_percent"]) == (0, 2, 0)


def test_says_when_there_is_nothing_to_measure(tmp_path: Path) -> None:
    done = _evaluate("--data", str(tmp_path))
    assert done.returncode == 1
    assert "nothing was measured" in done.stderr
    assert "Traceback" not in done.stderr


def test_leaves_out_sequences_without_a_log(tmp_path: Path) -> None:
    _write_sequence(tmp_path / "data" / "one")
    done = _evaluate("--data", str(tmp_path / "data"), "--logs", str(tmp_path))
    assert done.returncode == 1
    assert "not used: one (no one.lcmlog)" in done.stdout
