"""scripts/test: what the runners say is added up, and nothing that goes wrong counts as passed."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from deixis_testing.__main__ import run
from deixis_testing.suites import Suite
from deixis_testing.totals import Totals, read

CTEST = """<testsuite>
<testcase name="a" status="run"/>
<testcase name="b" status="fail"><failure message=""/></testcase>
<testcase name="c" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/></testcase>
<testcase name="d" status="notrun"><skipped message="Unable to find executable"/></testcase>
<testcase name="e" status="disabled"/>
</testsuite>"""
PYTEST = """<testsuites><testsuite>
<testcase name="a"/><testcase name="b"/>
<testcase name="c"><skipped message="why"/></testcase>
<testcase name="d"><error message="in a fixture"/></testcase>
</testsuite></testsuites>"""
PASSES = '<testsuite><testcase name="a" status="run"/></testsuite>'
EMPTY = '<testsuite tests="0"/>'


def suite(folder: Path, junit: str | None, exit_code: int = 0, name: str = "one",
          no_tests: tuple[int, ...] = ()) -> Suite:
    """A suite whose runner leaves `junit` behind and ends with `exit_code`."""
    path = folder / f"{name}.xml"
    write = f"open({str(path)!r}, 'w').write({junit!r});" if junit is not None else ""
    return Suite(name, [sys.executable, "-c", f"{write} exit({exit_code})"], path, no_tests)


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().out.splitlines()[-1]


@pytest.mark.parametrize(("text", "expected"), [
    (CTEST, Totals(passed=1, failed=2, skipped=2)),
    (PYTEST, Totals(passed=2, failed=1, skipped=1)),
])
def test_reads_both_runners(tmp_path: Path, text: str, expected: Totals) -> None:
    (tmp_path / "x.xml").write_text(text, encoding="utf-8")
    assert read(tmp_path / "x.xml") == expected


def test_sums_both_suites(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run([suite(tmp_path, CTEST, 8, "cpp"), suite(tmp_path, PYTEST, 1, "python")], is_filtered=False)
    assert last_line(capsys) == "3 passed, 3 failed, 3 skipped"


def test_says_nothing_of_skipped_ones_when_there_are_none(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([suite(tmp_path, PASSES)], is_filtered=False).failed == 0
    assert last_line(capsys) == "1 passed, 0 failed"


@pytest.mark.parametrize(("junit", "exit_code"), [
    (None, 0), (None, -11), ("<testsu", 0), (EMPTY, 0), (PASSES, 139)])
def test_a_broken_runner_is_a_failure(tmp_path: Path, junit: str | None, exit_code: int) -> None:
    assert run([suite(tmp_path, junit, exit_code)], is_filtered=False).failed == 1


def test_results_of_an_earlier_run_do_not_count(tmp_path: Path) -> None:
    (tmp_path / "one.xml").write_text(PASSES, encoding="utf-8")
    assert run([suite(tmp_path, None)], is_filtered=False) == Totals(failed=1)


def test_a_suite_without_tests_is_a_failure(tmp_path: Path) -> None:
    suites = [suite(tmp_path, PASSES), suite(tmp_path, EMPTY, 5, "two", no_tests=(5,))]
    assert run(suites, is_filtered=False) == Totals(passed=1, failed=1)


def test_a_filter_may_fit_one_suite_alone_but_not_none(tmp_path: Path) -> None:
    empty = suite(tmp_path, EMPTY, 0, "two")
    assert run([suite(tmp_path, PASSES), empty], is_filtered=True) == Totals(passed=1)
    assert run([empty], is_filtered=True) == Totals(failed=1)
