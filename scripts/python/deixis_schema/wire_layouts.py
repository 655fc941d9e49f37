"""Turns .lcm files into the C++ table by which messages are checked before they are decoded.

    python3 -m deixis_schema.wire_layouts --output wire_layouts.cpp lcmtypes/*.lcm

What the table means stands in common/messages/wire_layout.h. Refused is what no check can bound: types
that contain themselves, arrays that vary in more than one dimension, elements that take no bytes.
Exit code 0 = written, 1 = a fault in a file, 2 = wrong usage.
"""
from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from math import prod
from pathlib import Path

from .fingerprint import fingerprint
from .lcm_file import INTEGERS, PRIMITIVES, Parser, SchemaError

_BYTES = {"byte": 1, "boolean": 1, "int8_t": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8, "float": 4, "double": 8}
_SMALLEST_STRING = 5  # its length and the NUL
_MOST_SLOTS = 8  # as in wire_layout.h
_LARGEST = 1 << 20  # of any fixed size: far beyond any honest type, safe in every product


@dataclass
class Step:
    """One step over the wire, as in wire_layout.h; `nested` is the full name of a struct."""

    item: str
    size: int
    count: int = 1
    slot: int = -1
    nested: str = ""
    about: str = ""

    @property
    def is_plain(self):
        """True for bytes that any value may have and that are always there."""
        return self.item == "kBytes" and self.slot < 0


@dataclass
class Layout:
    """All steps of a struct, and how many bytes it takes at least."""

    steps: list[Step]
    smallest: int

    @property
    def is_plain(self):
        """True when it is one run of bytes without a length or a meaning."""
        return len(self.steps) == 1 and self.steps[0].is_plain


class Layouts:
    """The layouts of all structs by full name, nested ones first."""

    def __init__(self, structs):
        self._structs = structs
        self.by_name: dict[str, Layout] = {}
        for struct in structs.values():
            self._lay_out(struct, ())

    def _lay_out(self, struct, outer):
        if struct.full_name in outer:
            _refuse(struct, struct.line, f"'{struct.full_name}' contains itself")
        if struct.full_name not in self.by_name:
            for item in struct.fields:
                if item.type not in PRIMITIVES:
                    if item.type not in self._structs:
                        _refuse(struct, item.line, f"type '{item.type}' of '{item.name}' is not known")
                    self._lay_out(self._structs[item.type], (*outer, struct.full_name))
            self.by_name[struct.full_name] = self._layout(struct)

    def _layout(self, struct):
        sizes = {size for item in struct.fields for size in item.dimensions if not size.isdigit()}
        slots: dict[str, int] = {}
        steps: list[Step] = []
        smallest = 0
        for item in struct.fields:
            step, least = self._step(struct, item, slots)
            if item.name in sizes:
                if item.type not in INTEGERS or item.dimensions:
                    _refuse(struct, item.line, f"the length '{item.name}' is no integer")
                slots[item.name] = len(slots)
                step.item, step.slot = "kLength", slots[item.name]
            smallest += 0 if step.slot >= 0 and step.item != "kLength" else least * step.count
            _append(steps, step)
        if len(slots) > _MOST_SLOTS or smallest > _LARGEST:
            _refuse(struct, struct.line, f"'{struct.full_name}' has too many lengths or is too large")
        return Layout(steps, smallest)

    def _step(self, struct, item, slots):
        """One element's step, and the fewest bytes that it takes."""
        fixed = [int(size) for size in item.dimensions if size.isdigit()]
        variable = [size for size in item.dimensions if not size.isdigit()]
        if len(variable) > 1:
            _refuse(struct, item.line, f"array '{item.name}' varies in more than one dimension")
        if variable and variable[0] not in slots:
            _refuse(struct, item.line, f"array '{item.name}' is sized by '{variable[0]}', which does not come before it")
        slot = slots[variable[0]] if variable else -1
        step = Step("", 0, prod(fixed), slot, about=item.name)
        if item.type == "string":
            step.item, least = "kString", _SMALLEST_STRING
        elif item.type in PRIMITIVES:
            step.item, step.size = ("kBoolean" if item.type == "boolean" else "kBytes"), _BYTES[item.type]
            least = step.size
        else:
            inner = self.by_name[item.type]
            least = inner.smallest
            if inner.is_plain:
                step.item, step.size = "kBytes", inner.smallest
            else:
                step.item, step.nested = "kStruct", item.type
        if not 0 < least * step.count <= _LARGEST:
            _refuse(struct, item.line, f"an element of '{item.name}' takes {least * step.count} bytes")
        return step, least


def _append(steps, step):
    """Adds a step; plain bytes behind plain bytes are one step."""
    if step.is_plain and steps and steps[-1].is_plain:
        last = steps[-1]
        steps[-1] = Step("kBytes", last.size * last.count + step.size * step.count,
                         about=f"{last.about.split(' ... ')[0]} ... {step.about}")
    else:
        steps.append(step)


def _refuse(struct, line, message):
    raise SchemaError(line, message, struct.path)


def _signed(number):
    return number - (1 << 64) if number >> 63 else number


def cpp_table(structs):
    """The text of the C++ file that holds the layouts of `structs` (full name -> Struct)."""
    layouts = Layouts(structs).by_name
    marks = {name: _signed(fingerprint(struct, structs)) for name, struct in structs.items()}
    order = sorted(layouts, key=marks.__getitem__)
    rows, entries = [], []
    for name in order:
        layout = layouts[name]
        rank = f"{len(rows)}, {len(layout.steps)}"
        entries.append(f'    {{static_cast<std::int64_t>(0x{marks[name] & (1 << 64) - 1:016x}), "{name}", {rank},'
                       f" {layout.smallest}}},\n")
        rows += [f"    {_row(step, order)}  // {name}: {step.about}\n" for step in layout.steps]
    return _FILE.format(n_steps=len(rows), steps="".join(rows), n_layouts=len(entries), layouts="".join(entries))


def _row(step, order):
    size = order.index(step.nested) if step.nested else step.size
    return f"{{WireItem::{step.item}, {step.slot}, {size}, {step.count}}},"


_FILE = """\
// Generated from the .lcm files by scripts/python/deixis_schema.
#include <array>

#include "common/messages/wire_layout.h"

namespace deixis::messages {{
namespace {{

constexpr std::array<WireStep, {n_steps}> kSteps = {{{{
{steps}}}}};

// Ordered by fingerprint.
constexpr std::array<WireLayout, {n_layouts}> kLayouts = {{{{
{layouts}}}}};

}}  // namespace

WireTable GeneratedWireTable() {{ return {{kSteps.data(), kLayouts.data(), kLayouts.size()}}; }}

}}  // namespace deixis::messages
"""


def main():
    """Reads the files, writes the table."""
    parser = argparse.ArgumentParser(description="Turns .lcm files into the table that messages are checked by.")
    parser.add_argument("--output", type=Path, required=True, help="the C++ file to write")
    parser.add_argument("files", nargs="+", type=Path, help=".lcm files, all that the types need")
    arguments = parser.parse_args()
    structs = {}
    for path in arguments.files:
        try:
            structs.update({struct.full_name: struct for struct in Parser(path).structs()})
        except SchemaError as error:
            return _fail(f"{path}:{error.args[0]}: {error.args[1]}")
        except (OSError, UnicodeDecodeError) as error:
            return _fail(f"{path}: {error}")
    try:
        text = cpp_table(structs)
    except SchemaError as error:
        return _fail("{2}:{0}: {1}".format(*error.args))
    try:
        arguments.output.parent.mkdir(parents=True, exist_ok=True)
        arguments.output.write_text(text, encoding="utf-8")
    except OSError as error:
        return _fail(str(error))
    return 0


def _fail(message):
    print(f"wire_layouts: {message}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
