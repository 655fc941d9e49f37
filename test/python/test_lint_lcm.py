"""Feeds lint_lcm one good file, broken one way per test."""
import subprocess
import sys

import pytest

GOOD = """\
// Something with a name.
package deixis;

struct thing_t
{
  // Capture time, microseconds.
  int64_t utime;

  // Counts messages.
  int64_t sequence;

  // What it is; one of the constants below.
  int8_t kind;
  // Kinds.
  const int8_t RED = 0, BLUE = 1;

  // Number of weights.
  int32_t n_weights;
  // Weights, kilograms.
  double weights_kg[n_weights];
}
"""


@pytest.fixture
def lint(repository, tmp_path):
    def run(text=GOOD, name="deixis_thing_t.lcm", extra=None):
        (tmp_path / name).write_text(text, encoding="utf-8")
        for other, content in (extra or {}).items():
            (tmp_path / other).write_text(content, encoding="utf-8")
        return subprocess.run([sys.executable, repository / "scripts" / "lint_lcm", tmp_path],
                              capture_output=True, text=True, check=False)
    return run


def test_accepts_the_types_of_the_project(repository):
    result = subprocess.run([sys.executable, repository / "scripts" / "lint_lcm"], capture_output=True, text=True,
                            check=False)
    assert (result.returncode, result.stdout) == (0, "")


def test_accepts_the_good_sample(lint):
    result = lint()
    assert (result.returncode, result.stdout) == (0, "")


@pytest.mark.parametrize("old, new, line, message", [
    ("  // Weights, kilograms.\n", "", 19, "field 'weights_kg' has no comment"),
    ("  // Kinds.\n", "", 14, "constant 'RED' has no comment"),
    ("int64_t utime", "int32_t utime", 4, "int64_t utime must be its first field"),
    ("  // Capture time, microseconds.\n  int64_t utime;\n", "", 4, "int64_t utime must be its first field"),
    ("int64_t sequence", "int64_t number", 4, "int64_t sequence must be its second field"),
    ("int32_t n_weights", "uint32_t n_weights", 18, "type 'uint32_t' of 'n_weights' is no primitive type"),
    ("int8_t kind", "int kind", 13, "type 'int' of 'kind'"),
    ("int8_t kind", "deixis.colour_t kind", 13, "type 'deixis.colour_t' of 'kind' is not known"),
    ("int8_t kind", "int8_t class", 13, "field 'class' is reserved in C++, Python, Java"),
    ("int8_t kind", "int8_t lambda", 13, "field 'lambda' is reserved in Python"),
    ("int8_t kind", "int8_t final", 13, "field 'final' is reserved in Java"),
    ("int8_t kind", "int8_t template", 13, "field 'template' is reserved in C++"),
    ("int8_t kind", "int8_t encode", 13, "field 'encode' is reserved in the generated code"),
    ("int8_t kind", "int8_t Kind", 13, "field 'Kind' must be snake_case"),
    ("int8_t kind", "int8_t sequence", 13, "field 'sequence' is declared twice"),
    ("const int8_t", "const int32_t", 15, "constant 'RED' must be int8_t"),
    ("BLUE = 1", "Blue = 1", 15, "constant 'Blue' must be UPPER_CASE"),
    ("weights_kg[n_weights]", "weights_kg[n_parts]", 20, "sized by 'n_parts', which is no field declared before"),
    ("weights_kg[n_weights]", "masses_kg[n_weights]", 20, "'n_weights' must be n_<array>"),
    ("n_weights", "count", 20, "the size must be named n_<array>"),
    ("weights_kg[n_weights]", "weights_kg[n_weights][n_weights]", 20, "varies in two dimensions"),
    ("int32_t n_weights", "double n_weights", 20, "sized by 'n_weights', which is no integer"),
    ("  // Weights, k", "  // Colour.\n  int8_t colour;\n  // Weights, k", 22, "must stand just before array"),
    ("struct thing_t", "struct thing2_t", 4, "must be in file deixis_thing2_t.lcm"),
    ("int8_t kind;", "int8_t kind", 15, "expected ';', found 'const'"),
    ("}\n", "", 20, "file ends"),
])
def test_rejects(lint, tmp_path, old, new, line, message):
    assert old in GOOD
    result = lint(GOOD.replace(old, new))
    assert result.returncode == 1
    assert any(fault.startswith(f"{tmp_path}/deixis_thing_t.lcm:{line}: ") and message in fault
               for fault in result.stdout.splitlines()), result.stdout


def test_a_comment_behind_the_field_before_does_not_count(lint):
    result = lint(GOOD.replace("int64_t sequence;\n\n  // What it is; one of the constants below.\n",
                               "int64_t sequence;  // Counts.\n"))
    assert "field 'kind' has no comment" in result.stdout


def test_types_inside_others_need_no_time(lint):
    part = "package deixis;\nstruct part_t\n{\n  // Mass, kilograms.\n  double mass_kg;\n}\n"
    assert "deixis_part_t.lcm:2: struct 'part_t' is sent on a channel" in lint(extra={"deixis_part_t.lcm": part}).stdout
    user = GOOD.replace("int8_t kind;", "int8_t kind;\n\n  // A part.\n  deixis.part_t part;")
    assert lint(user, extra={"deixis_part_t.lcm": part}).returncode == 0


def test_vendored_files_may_break_conventions_but_not_the_languages(lint):
    vendored = "package other;\nstruct thing_t\n{\n  int32_t nData;\n  byte data[nData];\n}\n"
    assert lint(extra={"other_thing_t.lcm": vendored}).returncode == 0
    broken = vendored.replace("int32_t", "uint32_t").replace("data[", "union[")
    result = lint(extra={"other_thing_t.lcm": broken})
    assert result.returncode == 1
    assert "other_thing_t.lcm:4: type 'uint32_t'" in result.stdout
    assert "other_thing_t.lcm:5: field 'union' is reserved in C++" in result.stdout


def test_an_empty_folder_is_no_success(repository, tmp_path):
    result = subprocess.run([sys.executable, repository / "scripts" / "lint_lcm", tmp_path], capture_output=True,
                            text=True, check=False)
    assert result.returncode == 2
