"""The generator of the table that messages are checked by: what it writes and what it refuses."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

PART = "package own;\nstruct part_t\n{\n  double x[2];\n  int8_t kind;\n}\n"
WHOLE = """package own;
struct whole_t
{
  int64_t utime;
  own.part_t first;
  string name;
  int16_t n_parts;
  own.part_t parts[n_parts];
  boolean flags[2][n_parts];
}
"""


@pytest.fixture
def generate(repository: Path, tmp_path: Path):
    """Runs the generator as the build does, with the system's own Python where there is one."""
    own = Path("/usr/bin/python3")
    python = own if own.exists() else sys.executable

    def run(*texts: str) -> tuple[subprocess.CompletedProcess[str], str]:
        files = [tmp_path / f"own_{text.split('struct ')[1].split()[0]}.lcm" for text in texts]
        for file, text in zip(files, texts, strict=True):
            file.write_text(text, encoding="ascii")
        output = tmp_path / "made" / "table.cpp"
        done = subprocess.run(
            [python, "-m", "deixis_schema.wire_layouts", "--output", output, *files],
            capture_output=True, text=True, check=False,
            env={**os.environ, "PYTHONPATH": str(repository / "scripts/python")})
        return done, output.read_text(encoding="utf-8") if output.exists() else ""
    return run


def test_plain_bytes_become_one_step_and_lengths_multiply(generate) -> None:
    done, table = generate(PART, WHOLE)
    assert (done.returncode, done.stderr) == (0, "")
    steps = [line.split("//")[0].strip() for line in table.splitlines() if "own.whole_t: " in line]
    assert steps == [
        "{WireItem::kBytes, -1, 25, 1},",
        "{WireItem::kString, -1, 0, 1},",
        "{WireItem::kLength, 0, 2, 1},",
        "{WireItem::kBytes, 0, 17, 1},",
        "{WireItem::kBoolean, 0, 1, 2},",
    ]
    assert '"own.whole_t", ' in table and ", 32}," in table  # at least: 25, a text's 5, a length's 2


@pytest.mark.parametrize("old, new, line, message", [
    ("own.part_t first", "own.whole_t first", 2, "'own.whole_t' contains itself"),
    ("own.part_t first", "own.other_t first", 5, "type 'own.other_t' of 'first' is not known"),
    ("flags[2][n_parts]", "flags[n_parts][n_parts]", 9, "varies in more than one dimension"),
    ("flags[2]", "flags[0]", 9, "an element of 'flags' takes 0 bytes"),
    ("flags[2]", "flags[9999999]", 9, "takes 9999999 bytes"),
    ("flags[2][n_parts]", "flags[n_flags]", 9, "sized by 'n_flags', which does not come before it"),
    ("int16_t n_parts", "double n_parts", 7, "the length 'n_parts' is no integer"),
    ("string name;", "string name", 7, "expected ';'"),
])
def test_refuses_what_no_check_can_bound(generate, old: str, new: str, line: int,
                                         message: str) -> None:
    assert old in WHOLE
    done, table = generate(PART, WHOLE.replace(old, new))
    assert (done.returncode, table) == (1, "")
    assert done.stderr.count("\n") == 1
    assert f"own_whole_t.lcm:{line}: " in done.stderr and message in done.stderr


def test_refuses_structs_that_contain_each_other(generate) -> None:
    done, _ = generate("package own;\nstruct a_t { own.b_t b; }\n",
                       "package own;\nstruct b_t { own.a_t a; }\n")
    assert done.returncode == 1 and "contains itself" in done.stderr


def test_wrong_usage_ends_with_two(generate) -> None:
    done, _ = generate()
    assert done.returncode == 2
