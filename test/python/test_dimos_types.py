"""Deixis's copies of the types of dimos robots, against dimos's own package."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

PACKAGES = ("geometry_msgs", "sensor_msgs", "std_msgs", "tf2_msgs")
REPOSITORY = Path(__file__).resolve().parents[2]
TYPES = sorted(
    (package, path.stem.removeprefix(f"{package}_"))
    for package in PACKAGES
    for path in (REPOSITORY / "lcmtypes").glob(f"{package}_*.lcm")
)


def test_every_package_has_types() -> None:
    assert {package for package, _ in TYPES} == set(PACKAGES)


@pytest.mark.parametrize(("package", "name"), TYPES)
def test_fingerprint_is_that_of_dimos(package: str, name: str) -> None:
    theirs = getattr(importlib.import_module(f"dimos_lcm.{package}"), name)
    ours = getattr(importlib.import_module(package), name)
    assert ours._get_packed_fingerprint() == theirs._get_packed_fingerprint()


def test_picture_of_dimos_is_read() -> None:
    from dimos_lcm.sensor_msgs import Image as Theirs
    from sensor_msgs import Image as Ours

    sent = Theirs()
    sent.header.stamp.sec, sent.header.stamp.nsec = 12, 345_678_000
    sent.header.frame_id = "camera_optical"
    sent.height, sent.width, sent.step, sent.encoding = 2, 3, 9, "rgb8"
    sent.data = bytes(range(18))
    sent.data_length = len(sent.data)
    read = Ours.decode(sent.lcm_encode())
    assert (read.header.stamp.sec, read.header.stamp.nsec) == (12, 345_678_000)
    assert (read.header.frame_id, read.encoding) == ("camera_optical", "rgb8")
    assert (read.height, read.width, read.step, bytes(read.data)) == (2, 3, 9, bytes(range(18)))
