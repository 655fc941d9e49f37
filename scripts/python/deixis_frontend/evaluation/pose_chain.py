"""From a stereo recording to what the pose fitter says of it: stereo driver (video to log), then offline (log to log).

The log of depth is kept between runs where a folder for it is named, under a name that changes with all that it
follows from.
"""

from __future__ import annotations

import csv
import hashlib
import os
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from deixis_frontend.evaluation.pose_overlays import Overlay
from deixis_frontend.layout import Layout
from deixis_frontend.programs import run_program

_STEREO_DRIVER = "deixis-stereo-driver"
_HANDS = ("object_detector", "hand_tracker")
# What the services need said to work on the left pictures of STEREO.
_BY_STEREO = ("object_detector.image_channel=STEREO", "hand_tracker.image_channel=STEREO")
_FITTER = "pose_fitter"
_DRIVER = "stereo_driver"
_RESULTS = {"BODY_MODEL", "BODY_POSES"}


@dataclass(frozen=True)
class Chain:
    """Which services work, and with which settings (KEY=VALUE of their files)."""

    fitter_settings: tuple[str, ...] = ()
    stereo_settings: tuple[str, ...] = ()
    uses_hands: bool = False
    # True: pairs are logged, and stereo driver and fitter run together, so that one can learn from the other.
    matches_with_fitter: bool = False
    cache: Path | None = None


@dataclass(frozen=True)
class Fitted:
    """What came of a recording: messages by channel in order, and what the fitter took per depth image."""

    messages: list[tuple[str, Any]]
    fit_ms: list[float] = field(default_factory=list)


def fit(layout: Layout, log: Path, chain: Chain, settings: Iterable[str] = (),
        recording: Path | None = None, overlay: Overlay | None = None) -> Fitted:
    """Runs the pose fitter over a log of STEREO; over its STEREO_PAIR where the chain matches with the fitter and
    the log is of a stereo `recording`. `settings` go before the chain's own. What was fitted is drawn where `overlay` says.
    UserError when a program fails."""
    layout.use_types()
    from deixis_lcm import logs

    matched = recording if chain.matches_with_fitter else None
    services = [*(_HANDS if chain.uses_hands else ()), *((_DRIVER,) if matched else ()), _FITTER]
    said = [*(_BY_STEREO if chain.uses_hands else ()),
            *(f"{_FITTER}.{setting}" for setting in (*settings, *chain.fitter_settings))]
    if matched:
        said += [f"{_DRIVER}.{setting}" for setting in (*_calibration(matched), *chain.stereo_settings)]
    with tempfile.TemporaryDirectory() as folder:
        results, times = Path(folder) / "results.lcmlog", Path(folder) / "times.csv"
        results_only = [] if overlay else ["--results-only"]
        run_program(layout, "deixis-offline", str(log), str(results), *results_only,
                    "--services", ",".join(services), "--times", str(times),
                    *(word for setting in said for word in ("--set", setting)))
        if overlay:
            overlay.draw(layout, results)
        messages = [(channel, message) for _, channel, message in logs.read(results, _RESULTS)]
        return Fitted(messages, _fit_ms(times))


def stereo_log(layout: Layout, folder: Path, chain: Chain, scratch: Path) -> Path:
    """The log of a sequence folder, in the cache or else in `scratch`; made when it is not there."""
    key = _key(layout, folder, chain)
    log = (chain.cache or scratch) / f"{folder.name}-{key}.lcmlog"
    if log.exists():
        return log
    log.parent.mkdir(parents=True, exist_ok=True)
    unfinished = log.with_suffix(f".{os.getpid()}.part")
    try:
        run_program(layout, _STEREO_DRIVER, *_driver_options(folder, chain),
                    "--lcm-url", f"file://{unfinished}?mode=w")
        unfinished.replace(log)
    finally:
        unfinished.unlink(missing_ok=True)
    return log


def _driver_options(folder: Path, chain: Chain) -> list[str]:
    folder = folder.resolve()
    said = [f"source.{side}.{key}" for side in ("left", "right")
            for key in ("kind=video", f"path={folder / side}.mp4")]
    said += _calibration(folder)
    said += ["pace=as_fast_as_possible", *chain.stereo_settings]
    if chain.matches_with_fitter:
        said.append("publishes_pairs=true")
    return [word for setting in said for word in ("--set", setting)]


def _calibration(folder: Path) -> list[str]:
    return [f"calibration.{name}={folder.resolve() / name}.yml" for name in ("intrinsics", "extrinsics")]


def _key(layout: Layout, folder: Path, chain: Chain) -> str:
    """Changes with the recording, the settings and the program."""
    digest = hashlib.sha256("\n".join(_driver_options(folder, chain)).encode())
    for name in ("left.mp4", "right.mp4"):
        facts = (folder / name).stat()
        digest.update(f"{facts.st_size} {facts.st_mtime_ns}".encode())
    for path in (folder / "intrinsics.yml", folder / "extrinsics.yml", layout.find_config("stereo_driver.yaml"),
                 layout.program(_STEREO_DRIVER)):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def _fit_ms(times: Path) -> list[float]:
    with times.open(newline="") as file:
        return [float(row["cpu_us"]) / 1000.0 for row in csv.DictReader(file)
                if row["service"] == _FITTER and row["channel"] == "STEREO"]
