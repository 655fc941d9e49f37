"""The video devices that the drivers of a system are to open, by their configuration."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from deixis_frontend.layout import Layout
from deixis_frontend.supervision.system_file import ServiceEntry, System

# Of the stereo driver: which of its sources are cameras, by the kind of frames.
_STEREO_SOURCES = {"two_cameras": ("source.left", "source.right"), "side_by_side": ("source.left",)}


def wanted_cameras(system: System, layout: Layout) -> dict[str, Path]:
    """Devices that services which are started by default are to open, and the files that say so."""
    started = system.with_needs(system.resolve(list(system.start)))
    wanted: dict[str, Path] = {}
    for entry in (system.services[name] for name in started):
        settings = _Settings(entry, system, layout)
        for source in _sources(entry, settings):
            if device := _device(source, settings):
                wanted[device] = settings.file
    return wanted


class _Settings:
    """Keys of a driver: those of the system file go before those of its own."""

    def __init__(self, entry: ServiceEntry, system: System, layout: Layout) -> None:
        self.file = layout.config_file(entry.config or f"{entry.service}.yaml", system.path.parent)
        self._overrides = entry.settings
        self._content = _content(self.file)

    def value(self, key: str, default: str) -> str:
        """What the key says, the default where none of them has it."""
        if key in self._overrides:
            return self._overrides[key]
        found = self._content
        for part in key.split("."):
            found = found.get(part) if isinstance(found, dict) else None
        return default if found is None else str(found)


def _content(file: Path) -> Any:
    """Of a driver's file; what is wrong with it, the driver itself tells."""
    try:
        return yaml.safe_load(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError, yaml.YAMLError):
        return None


def _sources(entry: ServiceEntry, settings: _Settings) -> tuple[str, ...]:
    if entry.program == "deixis-camera-driver":
        return ("source",)
    if entry.program == "deixis-stereo-driver":
        return _STEREO_SOURCES.get(settings.value("source.kind", "two_cameras"), ())
    return ()


def _device(source: str, settings: _Settings) -> str | None:
    if settings.value(f"{source}.kind", "device") != "device":
        return None
    path = settings.value(f"{source}.path", "0")
    return f"/dev/video{path}" if path.isdigit() else path
