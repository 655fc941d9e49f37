"""Reads the JUnit files of ctest and pytest."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

# ctest calls a test "notrun" both when it skipped itself and when its program is missing.
_SKIPPED_ITSELF = ("SKIP_REGULAR_EXPRESSION_MATCHED", "SKIP_RETURN_CODE")


@dataclass(frozen=True)
class Totals:
    """How many tests passed, failed, were skipped."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Totals) -> Totals:
        return Totals(self.passed + other.passed, self.failed + other.failed,
                      self.skipped + other.skipped)

    @property
    def count(self) -> int:
        """All tests that there were."""
        return self.passed + self.failed + self.skipped

    def line(self) -> str:
        """The line that scripts/test ends with."""
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        return f"{self.passed} passed, {self.failed} failed{skipped}"


def read(junit: Path) -> Totals:
    """Totals of a JUnit file; raises ValueError when it is missing or torn."""
    try:
        root = ElementTree.parse(junit).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ValueError(f"{junit} cannot be read ({error})") from None
    outcomes = [_outcome(case) for case in root.iter("testcase")]
    return Totals(*(outcomes.count(kind) for kind in ("passed", "failed", "skipped")))


def _outcome(case: ElementTree.Element) -> str:
    status = case.get("status", "run")
    if case.find("failure") is not None or case.find("error") is not None or status == "fail":
        return "failed"
    if status == "notrun":
        skipped = case.find("skipped")
        message = skipped.get("message", "") if skipped is not None else ""
        return "skipped" if message in _SKIPPED_ITSELF else "failed"
    return "skipped" if status == "disabled" or case.find("skipped") is not None else "passed"
