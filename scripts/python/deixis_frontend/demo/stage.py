"""Where and how the demonstration is played."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.layout import Layout


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

    @property
    def viewer_settings(self) -> dict[str, str]:
        """Settings with which the viewer saves the pictures."""
        return {"save_folder": str(self.pictures), "window": str(self.has_window).lower()}

    def clear(self) -> None:
        """Makes the folders; takes away the pictures of an earlier demonstration."""
        self.pictures.mkdir(parents=True, exist_ok=True)
        for picture in self.pictures.glob("*.png"):
            picture.unlink()
