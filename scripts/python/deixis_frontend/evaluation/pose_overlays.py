"""Pictures and films of fitted limbs over what the camera saw, drawn by the viewer itself."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.layout import Layout
from deixis_frontend.programs import run_program

_STILLS_S = 2.0  # between pictures


@dataclass(frozen=True)
class Overlay:
    """Where the film `<name>.mp4` and the pictures `<name>/picture_<utime>.png` of one recording go."""

    folder: Path
    name: str
    rate_hz: float

    def draw(self, layout: Layout, log: Path) -> None:
        """From a log with STEREO, its calibration, BODY_MODEL and BODY_POSES. UserError when the viewer fails."""
        pictures = self.folder / self.name
        pictures.mkdir(parents=True, exist_ok=True)
        for old in pictures.glob("picture_*.png"):
            old.unlink()
        settings = {"image_channel": "STEREO", "film": self.folder / f"{self.name}.mp4",
                    "film_rate_hz": f"{self.rate_hz:g}", "save_folder": pictures, "latest_period_s": 0,
                    "stills_period_s": _STILLS_S, "window": "false"}
        run_program(layout, "deixis-viewer", "--lcm-url", f"file://{log}?mode=r&speed=0",
                    *(word for key, value in settings.items() for word in ("--set", f"{key}={value}")))
