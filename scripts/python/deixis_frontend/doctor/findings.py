"""What a check found: how bad it is, in one line, and the command that cures it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from deixis_frontend.bus import missing_module
from deixis_frontend.errors import UserError
from deixis_frontend.printable import printable

OK, WARNING, PROBLEM = "ok", "warning", "problem"
Command = tuple[str, ...]


@dataclass(frozen=True)
class Finding:
    """One line. `fixes` are commands that --fix may run, as root; `cure` is for people to run."""

    level: str
    check: str
    text: str
    cure: str = ""
    fixes: tuple[Command, ...] = ()

    def line(self) -> str:
        """For people; one line on a terminal whatever was heard on the bus."""
        cure = f"; cure: `{self.cure}`" if self.cure else ""
        return printable(f"{self.level:<8} {self.check}: {self.text}{cure}")

    def facts(self) -> dict[str, Any]:
        """For programs."""
        facts = asdict(self)
        del facts["fixes"]
        return {**facts, "can_be_fixed": bool(self.fixes)}


Check = Callable[[], list[Finding]]


def examine(name: str, check: Check) -> list[Finding]:
    """What the check finds; what keeps it from looking is a problem of its own."""
    try:
        return check()
    except UserError as error:
        return [Finding(PROBLEM, name, line) for line in str(error).splitlines()]
    except ModuleNotFoundError as error:
        return [Finding(PROBLEM, name, missing_module(str(error.name)))]
