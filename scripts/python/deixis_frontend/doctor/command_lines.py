"""Commands of the front end as cures, with the options that name the same bus and system."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.lcm_url import LcmUrl


@dataclass(frozen=True)
class CommandLines:
    """Writes command lines that run wherever they are pasted, also behind sudo."""

    launcher: Path  # `deixis`
    url: LcmUrl
    system_file: Path | None  # None: the default one

    def on_bus(self, command: str, *words: str) -> str:
        """A command that deals with the bus."""
        return shlex.join([str(self.launcher), command, *words, "-l", str(self.url)])

    def on_system(self, command: str, *words: str) -> str:
        """A command that deals with the supervisor."""
        option = ["--system", str(self.system_file)] if self.system_file else []
        return shlex.join([str(self.launcher), command, *words, *option])
