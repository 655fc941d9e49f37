"""Strict reading of YAML: every fault is collected with file, line, key and cure."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from deixis_frontend.errors import Refusal
from deixis_frontend.input_files import require_regular

_KINDS = {str: "a text", int: "a whole number", float: "a number"}


def read(path: Path) -> Section:
    """The top-level section of a YAML file; raises Refusal when there is none."""
    require_regular(path)
    try:
        node = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except FileNotFoundError:
        raise Refusal([f"{path}: no such file: name one with --system"]) from None
    except (OSError, UnicodeDecodeError) as error:
        raise Refusal([f"{path}: cannot be read: {error}"]) from None
    except yaml.YAMLError as error:
        raise Refusal([_syntax_fault(path, error)]) from None
    except RecursionError:
        raise Refusal([f"{path}: is nested too deeply: a '[' or '{{' too many?"]) from None
    if not isinstance(node, yaml.MappingNode):
        raise Refusal([f"{path}: holds no 'key: value' lines: see the shipped config/system.yaml"])
    return Section(path, node, "", [])


class Section:
    """One mapping of the file. What is asked for counts as known; `finish` names the rest."""

    def __init__(self, path: Path, node: yaml.MappingNode, prefix: str, faults: list[str]) -> None:
        self._path = path
        self._prefix = prefix
        self._node = node
        self._known: list[str] = []
        self.faults = faults
        self._values: dict[str, yaml.Node] = {}
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                self._fault(key, "?", "a list or a mapping is no key: write a text before the ':'")
                continue
            if key.value in self._values:
                self._fault(key, str(key.value), "given twice: remove one")
            self._values[key.value] = value

    def text(self, key: str, default: str | None = None) -> str:
        """A text; without a default the key must be there."""
        return self._scalar(key, str, default, "")

    def number(self, key: str, default: float, low: float, high: float) -> float:
        """A number within [low, high]."""
        return self._within(key, self._scalar(key, float, default, default), low, high, default)

    def integer(self, key: str, default: int, low: int, high: int) -> int:
        """A whole number within [low, high]."""
        value = self._within(key, self._scalar(key, int, default, default), low, high, default)
        return int(value)

    def choice(self, key: str, default: str, allowed: tuple[str, ...]) -> str:
        """One word of a list."""
        value = self.text(key, default)
        if value not in allowed:
            self.fault(key, f"'{value}' is not one of {', '.join(allowed)}")
            return default
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        """A list of texts; empty when the key is not there."""
        node = self._take(key)
        if node is None:
            return ()
        if not isinstance(node, yaml.SequenceNode):
            self.fault(key, "is not a list: write [a, b]")
            return ()
        if any(not isinstance(item, yaml.ScalarNode) for item in node.value):
            self.fault(key, "holds something else than texts")
            return ()
        return tuple(item.value for item in node.value)

    def settings(self, key: str) -> dict[str, str]:
        """A flat mapping of texts, whatever its keys; empty when the key is not there."""
        section = self.section(key)
        return {name: section.text(name) for name in section.names()} if section else {}

    def section(self, key: str) -> Section | None:
        """The mapping below `key`; None when it is not there."""
        node = self._take(key)
        if node is None:
            return None
        if not isinstance(node, yaml.MappingNode):
            self.fault(key, "holds no 'key: value' lines")
            return None
        return Section(self._path, node, f"{self._prefix}{key}.", self.faults)

    def sections(self) -> Iterator[tuple[str, Section]]:
        """All entries of this section, each a section itself."""
        for key in self.names():
            section = self.section(key)
            if section:
                yield key, section

    def names(self) -> list[str]:
        """The keys that the file gives here."""
        return [str(key) for key in self._values]

    def fault(self, key: str, text: str) -> None:
        """Notes that `key` is wrong."""
        self._fault(self._values.get(key, self._node), key, text)

    def finish(self) -> None:
        """Notes every key that nobody asked for."""
        for key, node in self._values.items():
            if key not in self._known:
                self._fault(node, key, self._unknown(str(key)))

    def _unknown(self, key: str) -> str:
        near = difflib.get_close_matches(key, self._known, n=1)
        cure = f"did you mean '{near[0]}'?" if near else f"known are {', '.join(self._known)}"
        return f"unknown key: {cure}"

    def _take(self, key: str) -> yaml.Node | None:
        if key not in self._known:
            self._known.append(key)
        node = self._values.get(key)
        return None if node is not None and node.tag.endswith(":null") else node

    def _scalar(self, key: str, kind: type, default: Any, fallback: Any) -> Any:
        node = self._take(key)
        if node is None:
            if default is None:
                self.fault(key, "missing: it has no default")
                return fallback
            return default
        try:
            if isinstance(node, yaml.ScalarNode):
                return kind(node.value)
        except ValueError:
            pass  # The fault is noted below, for every way in which the value is not of its kind.
        self.fault(key, f"is not {_KINDS[kind]}")
        return default if default is not None else fallback

    def _within(self, key: str, value: float, low: float, high: float, default: float) -> float:
        if low <= value <= high:
            return value
        self.fault(key, f"{value:g} is not from {low:g} to {high:g}")
        return default

    def _fault(self, node: yaml.Node, key: str, text: str) -> None:
        line = node.start_mark.line + 1
        self.faults.append(f"{self._path}:{line}: {self._prefix}{key}: {text}")


def _syntax_fault(path: Path, error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None)
    place = f"{path}:{mark.line + 1}" if mark else str(path)
    problem = getattr(error, "problem", None) or "not YAML"
    return (f"{place}: {problem}: check indentation, colons and quotes of this line"
            " and the one before")
