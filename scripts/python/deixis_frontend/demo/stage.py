"""Where and how the demonstration is played."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.demo.clip import Clip
from deixis_frontend.layout import Layout

# Bodies come later than hands on a small machine that does all of it; they shall be in the pictures all the same.
_PATIENCE = {"history.max_delay_s": "1.5", "history.max_images": "60"}


@dataclass(frozen=True)
class Stage:
    """The programs, a folder for everything that comes out, how pictures are shown."""

    layout: Layout
    folder: Path
    has_window: bool

    @property
    def pictures(self) -> Path:
        """Folder of the pictures with what was seen in them."""
        return self.folder / "pictures"

    def viewer_settings(self, clip: Clip) -> dict[str, str]:
        """Settings with which the viewer saves the pictures."""
        shown = {"save_folder": str(self.pictures), "window": str(self.has_window).lower()}
        return {**shown, "image_channel": clip.channel, **(_PATIENCE if clip.is_stereo else {})}

    def clear(self) -> None:
        """Makes the folders; takes away the pictures of an earlier demonstration."""
        self.pictures.mkdir(parents=True, exist_ok=True)
        for picture in self.pictures.glob("*.png"):
            picture.unlink()
