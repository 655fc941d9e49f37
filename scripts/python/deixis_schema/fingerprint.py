"""Fingerprints of structs, as lcm-gen computes them (https://lcm-proj.github.io/lcm/content/lcm-type-ref.html)."""
from .lcm_file import PRIMITIVES

_MASK = (1 << 64) - 1
_FIXED, _VARIABLE = 0, 1


def fingerprint(struct, structs):
    """The fingerprint as an unsigned 64-bit number. `structs` maps full names to structs, which do not recurse."""
    value = _own(struct)
    for item in struct.fields:
        if item.type not in PRIMITIVES:
            value += fingerprint(structs[item.type], structs)
    value &= _MASK
    return (value << 1 & _MASK) | value >> 63


def _own(struct):
    value = 0x12345678
    for item in struct.fields:
        value = _add_text(value, item.name)
        if item.type in PRIMITIVES:
            value = _add_text(value, item.type)
        value = _add(value, len(item.dimensions))
        for size in item.dimensions:
            value = _add_text(_add(value, _FIXED if size.isdigit() else _VARIABLE), size)
    return value


def _add_text(value, text):
    value = _add(value, len(text))
    for byte in text.encode():
        value = _add(value, byte)
    return value


def _add(value, number):
    signed = value - (1 << 64) if value >> 63 else value  # the shift to the right keeps the sign
    return ((signed << 8) ^ (signed >> 55)) + number & _MASK
