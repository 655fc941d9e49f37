"""Tables as CSV files: what is wrong is told with file and line."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.errors import UserError
from deixis_frontend.input_files import require_regular


@dataclass(frozen=True)
class Row:
    """One line of a table."""

    place: str  # file:line
    values: dict[str, str]

    def text(self, column: str) -> str:
        """What stands in the column."""
        return self.values[column]

    def number(self, column: str) -> float:
        """A finite number."""
        try:
            value = float(self.values[column])
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise self.fault(f"{column} '{self.values[column]}' is not a number")
        return value

    def whole(self, column: str) -> int:
        """A whole number."""
        try:
            return int(self.values[column])
        except ValueError:
            raise self.fault(
                f"{column} '{self.values[column]}' is not a whole number") from None

    def choice(self, column: str, allowed: tuple[str, ...]) -> str:
        """One word of a list."""
        word = self.values[column]
        if word not in allowed:
            raise self.fault(f"{column} '{word}' is not one of {', '.join(allowed)}")
        return word

    def fault(self, text: str) -> UserError:
        """An error that names this line."""
        return UserError(f"{self.place}: {text}")


def read(path: Path, columns: tuple[str, ...]) -> list[Row]:
    """All lines; raises UserError when the file cannot be read or a line lacks one of `columns`."""
    require_regular(path)
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            return _rows(path, csv.DictReader(file, strict=True), columns)
    except OSError as error:
        raise UserError(f"{path} cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path} is no CSV file: {error}") from None


def _rows(path: Path, reader: csv.DictReader[str], columns: tuple[str, ...]) -> list[Row]:
    present = reader.fieldnames or []
    missing = [name for name in columns if name not in present]
    if missing:
        raise UserError(f"{path}:1: has no column {', '.join(missing)}:"
                        f" the first line must name {','.join(columns)}")
    rows = []
    for values in reader:
        row = Row(f"{path}:{reader.line_num}", values)
        cells = sum(value is not None for key, value in values.items() if key is not None)
        if cells != len(present) or None in values:
            raise row.fault(f"has not as many columns as the first line ({len(present)})")
        rows.append(row)
    return rows
