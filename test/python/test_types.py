"""The generated Python types: the fingerprints of the checked-in table, and every type there and back."""
import importlib
import math

import pytest
from conftest import REPOSITORY

from deixis_schema.lcm_file import Parser


def read_structs():
    return {struct.full_name: struct
            for path in sorted((REPOSITORY / "lcmtypes").glob("*.lcm")) for struct in Parser(path).structs()}


STRUCTS = read_structs()


@pytest.fixture(scope="session")
def type_of(build):  # pylint: disable=unused-argument
    def find(full_name):
        package, name = full_name.split(".")
        return getattr(importlib.import_module(package), name)
    return find


class Filler:
    """Fills messages with values that differ from field to field and from zero."""

    def __init__(self, type_of):
        self.type_of, self.count = type_of, 0

    def message(self, full_name):
        struct, message = STRUCTS[full_name], self.type_of(full_name)()
        sizes = {size for item in struct.fields for size in item.dimensions if not size.isdigit()}
        for item in struct.fields:
            if item.name in sizes:
                setattr(message, item.name, 3)
            else:
                setattr(message, item.name, self.array(message, item.type, item.dimensions))
        return message

    def array(self, message, type_name, dimensions):
        if not dimensions:
            return self.value(type_name)
        length = int(dimensions[0]) if dimensions[0].isdigit() else getattr(message, dimensions[0])
        if type_name == "byte" and len(dimensions) == 1:
            return bytes((0, 127, 255, 128, 10)[i % 5] for i in range(length))
        return [self.array(message, type_name, dimensions[1:]) for _ in range(length)]

    def value(self, type_name):
        self.count += 1
        count = self.count
        if type_name in STRUCTS:
            return self.message(type_name)
        return {"boolean": count % 2 == 0, "byte": count % 256, "string": f"Wert {count} é 手",
                "float": math.ldexp(count, -3), "double": count / 3, "int8_t": -(count % 128),
                "int16_t": -(2**15) + count, "int32_t": -(2**31) + count, "int64_t": -(2**63) + count}[type_name]


def flatten(value):
    """The value as nested tuples that compare by content."""
    if hasattr(value, "__slots__"):
        return tuple(flatten(getattr(value, name)) for name in value.__slots__)
    if isinstance(value, (list, tuple)):
        return tuple(flatten(item) for item in value)
    return value


def test_fingerprints_are_those_of_the_checked_in_table(repository, type_of):
    lines = (repository / "test" / "lcmtypes" / "fingerprints.txt").read_text(encoding="utf-8").splitlines()
    table = dict(line.split() for line in lines if line and not line.startswith("#"))
    # pylint: disable=protected-access
    assert {name: type_of(name)._get_packed_fingerprint().hex() for name in STRUCTS} == table


def test_packages_hold_no_type_without_a_file(build):
    generated = {f"{path.parent.name}.{path.stem}" for path in (build / "python").glob("*/*.py")
                 if path.stem != "__init__"}
    assert generated == set(STRUCTS)


@pytest.mark.parametrize("name", STRUCTS)
def test_default_message_goes_there_and_back(name, type_of):
    message = type_of(name)()
    assert flatten(type_of(name).decode(message.encode())) == flatten(message)


@pytest.mark.parametrize("name", STRUCTS)
def test_filled_message_goes_there_and_back(name, type_of):
    message = Filler(type_of).message(name)
    decoded = type_of(name).decode(message.encode())
    assert flatten(decoded) == flatten(message)
    assert decoded.encode() == message.encode()


@pytest.mark.parametrize("name", STRUCTS)
def test_constants_of_one_enumeration_differ(name, type_of):
    for constant in STRUCTS[name].constants:
        values = [getattr(type_of(name), key) for key in constant.names]
        assert len(set(values)) == len(values)
