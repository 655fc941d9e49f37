"""Reads .lcm files: what structs they declare, member by member, with the lines for messages."""
import re
from dataclasses import dataclass, field
from pathlib import Path

INTEGERS = {"int8_t", "int16_t", "int32_t", "int64_t"}
PRIMITIVES = INTEGERS | {"byte", "float", "double", "string", "boolean"}

TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|[A-Za-z_][\w.]*|[-+]?[0-9][\w.+-]*|[{}\[\];,=]|\S", re.S)


class SchemaError(Exception):
    """A file that does not follow LCM's grammar; args: line, message."""


@dataclass
class Field:
    line: int
    type: str
    name: str
    dimensions: list
    commented: bool


@dataclass
class Constant:
    line: int
    type: str
    names: list
    commented: bool


@dataclass
class Struct:
    path: Path
    line: int
    package: str
    name: str
    fields: list = field(default_factory=list)
    constants: list = field(default_factory=list)

    @property
    def full_name(self):
        return f"{self.package}.{self.name}"


class Parser:
    """Reads one file: a package and its structs, each member with whether a comment stands above it."""

    def __init__(self, path):
        text = path.read_text(encoding="utf-8")
        self.path, self.tokens, self.comment_ends, self.code_lines = path, [], set(), set()
        for match in TOKEN.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            if match.group().startswith(("//", "/*")):
                if line not in self.code_lines:  # a comment behind code says nothing about what follows
                    self.comment_ends.add(line + match.group().count("\n"))
            else:
                self.tokens.append((line, match.group()))
                self.code_lines.add(line)
        self.position = 0

    @property
    def line(self):
        return self.tokens[min(self.position, len(self.tokens) - 1)][0] if self.tokens else 1

    def next(self, expected=None):
        if self.position >= len(self.tokens):
            raise SchemaError(self.line, f"file ends, expected {expected or 'more'}")
        line, token = self.tokens[self.position]
        if expected is not None and token != expected:
            raise SchemaError(line, f"expected '{expected}', found '{token}'")
        self.position += 1
        return token

    def peek(self):
        return self.tokens[self.position][1] if self.position < len(self.tokens) else None

    def name(self, pattern=r"[A-Za-z_]\w*"):
        line, token = self.line, self.next()
        if not re.fullmatch(pattern, token):
            raise SchemaError(line, f"expected a name, found '{token}'")
        return token

    def ends_list(self):
        """Takes the token behind a declarator: True for ';', False for ','."""
        if self.peek() == ",":
            self.next()
            return False
        self.next(";")
        return True

    def structs(self):
        self.next("package")
        package = self.name()
        self.next(";")
        while self.peek() is not None:
            line = self.line
            self.next("struct")
            struct = Struct(self.path, line, package, self.name())
            self.next("{")
            while self.peek() != "}":
                self.member(struct)
            self.next("}")
            yield struct

    def member(self, struct):
        line = self.line
        commented = (line - 1) in self.comment_ends
        if self.peek() == "const":
            self.next()
            constant = Constant(line, self.name(), [], commented)
            while True:
                constant.names.append(self.name())
                self.next("=")
                self.next()
                if self.ends_list():
                    break
            struct.constants.append(constant)
            return
        type_name = self.name(r"[A-Za-z_][\w.]*")
        while True:
            dimensions, name_line, name = [], self.line, self.name()
            while self.peek() == "[":
                self.next()
                dimensions.append(self.next())
                self.next("]")
            struct.fields.append(Field(name_line, type_name, name, dimensions, commented))
            if self.ends_list():
                break
