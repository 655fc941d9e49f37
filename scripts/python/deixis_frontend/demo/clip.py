"""A clip: a video, and beside it what is known of the scene."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from deixis_frontend import csv_table
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout

DEFAULT = "spread_01"


@dataclass(frozen=True)
class Label:
    """A gesture that truly happens in the clip, in frames."""

    start_frame: int
    end_frame: int
    object_label: str


@dataclass(frozen=True)
class Clip:
    """Where the parts of a clip are; what is not there is left out."""

    video: Path
    lens: Path | None
    places: Path | None
    labels: tuple[Label, ...]

    def camera_settings(self) -> dict[str, str]:
        """Settings with which the camera driver plays the clip."""
        settings = {"source.kind": "video", "source.path": str(self.video), "source.loop": "false"}
        return {**settings, "calibration.file": str(self.lens)} if self.lens else settings

    def detector_settings(self) -> dict[str, str]:
        """Settings with which the object detector knows the things in the clip."""
        return {"places.file": str(self.places)} if self.places else {}


def open_clip(given: Path | None, layout: Layout) -> Clip:
    """The clip in a folder, or a video with its folder; without a name the one that is shipped."""
    path = (given or layout.clips / DEFAULT).resolve()
    video = path / "left.mp4" if path.is_dir() else path
    if not video.is_file():
        raise UserError(f"{video}: no such video: name a video, or a folder with left.mp4,"
                        " with --clip")
    folder = video.parent
    return Clip(video, _present(folder / "intrinsics.yml"), _present(folder / "places.yaml"),
                _labels(folder / "gestures.csv"))


def _present(path: Path) -> Path | None:
    return path if path.is_file() else None


def _labels(path: Path) -> tuple[Label, ...]:
    if not path.is_file():
        return ()
    columns = ("start_frame", "end_frame", "object_label")
    return tuple(Label(row.whole("start_frame"), row.whole("end_frame"), row.text("object_label"))
                 for row in csv_table.read(path, columns))
