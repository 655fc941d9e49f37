"""Reads the configuration of a procman sheriff; takes nothing that a sheriff refuses."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

_TOKEN = re.compile(r"""\s+ | \#[^\n]* | (?P<text>"(?:[^"\\\n]|\\[^\n])*")
                        | (?P<word>[A-Za-z_][A-Za-z0-9_-]*) | (?P<number>[0-9]+)
                        | (?P<mark>[={};])""", re.VERBOSE)
_COMMON = {"exec": "text", "auto_respawn": "text", "group": "text"}
_STOPPING = {"stop_signal": "number", "stop_time_allowed": "number"}
ATTRIBUTES = {
    "libbot2": {**_COMMON, **_STOPPING, "host": "text"},
    "libbot2-early": {**_COMMON, "host": "text", "nickname": "text"},
    "procman": {**_COMMON, **_STOPPING, "deputy": "text"},
}


class GrammarError(ValueError):
    """The sheriff would refuse the file."""


@dataclass
class SheriffFile:
    """What a file says: commands by group and name, actions by script."""

    groups: dict[str, dict[str, dict[str, str | int]]] = field(default_factory=dict)
    scripts: dict[str, list[tuple[str, ...]]] = field(default_factory=dict)


def read(text: str, sheriff: str) -> SheriffFile:
    """Reads a file as the named sheriff does; raises GrammarError when it would not."""
    return _Parser(text, ATTRIBUTES[sheriff]).file()


class _Parser:
    def __init__(self, text: str, attributes: dict[str, str]) -> None:
        self._tokens = list(_tokens(text))
        self._attributes = attributes

    def file(self) -> SheriffFile:
        found = SheriffFile()
        while self._tokens:
            match self._take("word"):
                case "group":
                    name = self._name()
                    found.groups[name] = self._block(self._group)
                case "script":
                    name = self._take("text")
                    if name in found.scripts:
                        raise GrammarError(f"script {name} twice")
                    found.scripts[name] = self._block(self._script)
                case other:
                    raise GrammarError(f"unexpected {other}")
        return found

    def _block(self, inside):
        self._mark("{")
        found = inside()
        self._mark("}")
        return found

    def _group(self) -> dict[str, dict[str, str | int]]:
        commands = {}
        while self._next() == "word":
            if self._take("word") != "cmd":
                raise GrammarError("expected cmd")
            name = self._name()
            commands[name] = self._block(self._command)
            if not commands[name].get("exec"):
                raise GrammarError(f"{name} has no exec")
        return commands

    def _command(self) -> dict[str, str | int]:
        values: dict[str, str | int] = {}
        while self._next() == "word":
            key = self._take("word")
            if key not in self._attributes:
                raise GrammarError(f"attribute {key} is not known")
            self._mark("=")
            value = self._take(self._attributes[key])
            values[key] = int(value) if self._attributes[key] == "number" else value
            if values[key] == 0:
                raise GrammarError(f"{key} is not above 0")
            self._mark(";")
        return values

    def _script(self) -> list[tuple[str, ...]]:
        actions = []
        while self._next() == "word":
            actions.append(self._action(self._take("word")))
            self._mark(";")
        return actions

    def _action(self, verb: str) -> tuple[str, ...]:
        what = self._take("word")
        if verb in ("start", "stop", "restart") and what in ("cmd", "group"):
            action = (verb, what, self._take("text"))
            return (*action, "wait", self._status("wait")) if self._next() == "word" else action
        if verb == "wait" and what == "ms":
            return verb, what, self._take("number")
        if verb == "wait" and what in ("cmd", "group"):
            return verb, what, self._take("text"), self._status("status")
        raise GrammarError(f"no action {verb} {what}")

    def _status(self, word: str) -> str:
        if self._take("word") != word or (status := self._take("text")) not in (
                "running", "stopped"):
            raise GrammarError(f"expected {word} and a status")
        return status

    def _name(self) -> str:
        name = self._take("text")
        if "/" in name or not name.strip():
            raise GrammarError(f"'{name}' cannot be a name")
        return name

    def _mark(self, mark: str) -> None:
        if (found := self._take("mark")) != mark:
            raise GrammarError(f"expected {mark}, not {found}")

    def _next(self) -> str:
        return self._tokens[0][0] if self._tokens else "end"

    def _take(self, kind: str) -> str:
        if self._next() != kind:
            raise GrammarError(f"expected a {kind} at {self._tokens[:3]}")
        return self._tokens.pop(0)[1]


def _tokens(text: str):
    offset = 0
    while offset < len(text):
        found = _TOKEN.match(text, offset)
        if not found:
            raise GrammarError(f"no token begins with {text[offset:offset + 20]!r}")
        offset = found.end()
        if found.lastgroup == "text":
            yield "text", _unescaped(found["text"][1:-1])
        elif found.lastgroup:
            yield found.lastgroup, found[found.lastgroup]


def _unescaped(text: str) -> str:
    named = {"n": "\n", "r": "\r", "t": "\t"}
    return re.sub(r"\\(.)", lambda m: named.get(m[1], m[1]), text)
