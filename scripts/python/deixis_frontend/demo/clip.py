"""A clip: a video, or those of two cameras, and beside it what is known of the scene."""

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
    right: Path | None = None  # The right camera's video; with it goes `extrinsics`.
    extrinsics: Path | None = None

    @property
    def is_stereo(self) -> bool:
        """Whether depth can be made of it, and bodies fitted."""
        return bool(self.lens and self.right and self.extrinsics)

    @property
    def driver(self) -> str:
        """The service that plays it."""
        return "stereo_driver" if self.is_stereo else "camera_driver"

    @property
    def channel(self) -> str:
        """Where its pictures go."""
        return "STEREO" if self.is_stereo else "CAMERA"

    def watchers(self) -> dict[str, dict[str, str]]:
        """The services that look at its pictures, with their settings, the viewer apart."""
        if not self.is_stereo:
            return {"object_detector": self.detector_settings(), "hand_tracker": {}, "gesture_recogniser": {}}
        looks = {"image_channel": self.channel}
        return {"object_detector": {**looks, **self.detector_settings()}, "hand_tracker": looks,
                "gesture_recogniser": {"calibration_channel": "STEREO_CALIBRATION"}, "pose_fitter": {}}

    def driver_settings(self) -> dict[str, str]:
        """Settings with which its driver plays it."""
        if not self.is_stereo:
            return self._camera_settings()
        return {"source.kind": "two_cameras", "source.left.kind": "video", "source.left.path": str(self.video),
                "source.right.kind": "video", "source.right.path": str(self.right), "source.loop": "false",
                "calibration.intrinsics": str(self.lens), "calibration.extrinsics": str(self.extrinsics),
                "matcher.match_size": "people"}

    def _camera_settings(self) -> dict[str, str]:
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
    is_left = video.name == "left.mp4"  # Another video is none of the pair beside it.
    return Clip(video, _present(folder / "intrinsics.yml"), _present(folder / "places.yaml"),
                _labels(folder / "gestures.csv"), _present(folder / "right.mp4") if is_left else None,
                _present(folder / "extrinsics.yml"))


def _present(path: Path) -> Path | None:
    return path if path.is_file() else None


def _labels(path: Path) -> tuple[Label, ...]:
    if not path.is_file():
        return ()
    columns = ("start_frame", "end_frame", "object_label")
    return tuple(Label(row.whole("start_frame"), row.whole("end_frame"), row.text("object_label"))
                 for row in csv_table.read(path, columns))
