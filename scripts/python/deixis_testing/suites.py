"""One suite of tests: a runner that writes a JUnit file."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from deixis_testing import totals
from deixis_testing.totals import Totals

PARALLEL_TESTS = 2
# Run here by themselves, so that each Python test counts as one.
_NOT_IN_CTEST = "^python_tests$"


@dataclass(frozen=True)
class Suite:
    """How one runner is called and which exit codes mean that its JUnit file tells everything."""

    name: str
    command: list[str]
    junit: Path
    no_tests_exit_codes: tuple[int, ...] = ()
    environment: dict[str, str] = field(default_factory=dict)

    def run(self, *, may_be_empty: bool) -> Totals:
        """Runs the suite; whatever goes wrong with the runner itself counts as one more failure."""
        print(f"== {self.name}", flush=True)
        self.junit.parent.mkdir(parents=True, exist_ok=True)
        self.junit.unlink(missing_ok=True)
        code = subprocess.run(self.command, env={**os.environ, **self.environment},
                              check=False).returncode
        if code in self.no_tests_exit_codes:
            return self._without_tests(may_be_empty=may_be_empty)
        try:
            result = totals.read(self.junit)
        except ValueError as error:
            return self._broken(Totals(), f"{error}; the runner ended with exit code {code}")
        if not result.count:
            return self._without_tests(may_be_empty=may_be_empty)
        if code and not result.failed:
            return self._broken(result, f"the runner ended with exit code {code}")
        return result

    def _without_tests(self, *, may_be_empty: bool) -> Totals:
        return Totals() if may_be_empty else self._broken(Totals(), "no test was run")

    def _broken(self, result: Totals, reason: str) -> Totals:
        print(f"{self.name}: {reason}: counted as one failed", file=sys.stderr, flush=True)
        return result + Totals(failed=1)


def cpp(root: Path, build: Path, name_filter: str | None) -> Suite:
    """The C++ tests, each GoogleTest case by itself."""
    junit = build / "test-results" / "cpp.xml"
    command = ["ctest", "--test-dir", str(build), "-j", str(PARALLEL_TESTS), "--output-on-failure",
               "--progress", "--output-junit", str(junit), "--exclude-regex", _NOT_IN_CTEST]
    if name_filter:
        command += ["--tests-regex", name_filter]
    return Suite("C++ tests", command, junit, environment=sanitiser_options(root))


def python(root: Path, build: Path, name_filter: str | None) -> Suite:
    """The Python tests."""
    junit = build / "test-results" / "python.xml"
    command = [sys.executable, "-m", "pytest", "-q", f"--junitxml={junit}",
               f"--rootdir={root}", f"-c{root / '.pytest.ini'}"]
    if name_filter:
        command += ["-k", name_filter]
    # pytest has an exit code of its own for "no test was collected".
    return Suite("Python tests", command, junit, no_tests_exit_codes=(5,),
                 environment={"DEIXIS_BUILD_DIR": str(build)})


def sanitiser_options(root: Path) -> dict[str, str]:
    """What the sanitisers are told; without effect on programs that were built without them."""
    suppressions = root / "test" / "support" / "lsan.supp"
    return {
        "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "detect_stack_use_after_return=1"),
        "LSAN_OPTIONS": os.environ.get("LSAN_OPTIONS",
                                       f"suppressions={suppressions}:print_suppressions=0"),
        "UBSAN_OPTIONS": os.environ.get("UBSAN_OPTIONS", "print_stacktrace=1"),
    }
