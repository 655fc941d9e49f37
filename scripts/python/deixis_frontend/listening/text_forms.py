"""Plain values as YAML for people and as JSON for programs."""

from __future__ import annotations

import base64
import json
import math
from typing import Any

import yaml


class _Dumper(getattr(yaml, "CSafeDumper", yaml.SafeDumper)):  # type: ignore[misc]
    """Lists of plain values stand on one line; nothing is referred to by anchors."""

    def ignore_aliases(self, _data: Any) -> bool:
        return True


def _represent_list(dumper: Any, items: list[Any]) -> Any:
    is_flat = not any(isinstance(item, (dict, list)) for item in items)
    return dumper.represent_sequence("tag:yaml.org,2002:seq", items, flow_style=is_flat)


_Dumper.add_representer(list, _represent_list)


def as_yaml(value: Any) -> str:
    """YAML in blocks; NaN and infinity as YAML has them (.nan, .inf), bytes as !!binary."""
    return yaml.dump(value, Dumper=_Dumper, sort_keys=False, allow_unicode=True,
                     default_flow_style=False, width=10**9)


def as_json(value: Any) -> str:
    """One line. What JSON has no number for is a text: "NaN", "Infinity", "-Infinity".

    Bytes are base64.
    """
    return json.dumps(_with_json_values(value), allow_nan=False)


def _with_json_values(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _with_json_values(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_with_json_values(part) for part in value]
    if isinstance(value, bytes):
        return base64.b64encode(value).decode("ascii")
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    return value
