"""Where the tests find the repository, the build and the modules under test.

DEIXIS_BUILD_DIR names the build whose generated types are tested (default: build/release).
"""
import os
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("DEIXIS_BUILD_DIR", REPOSITORY / "build" / "release")).resolve()
sys.path[:0] = [str(REPOSITORY / "scripts" / "python"), str(BUILD / "python")]


@pytest.fixture(scope="session")
def repository():
    return REPOSITORY


@pytest.fixture(scope="session")
def build():
    if not (BUILD / "python" / "deixis").is_dir():
        pytest.fail(f"no generated Python types in {BUILD}/python: build first, or set DEIXIS_BUILD_DIR")
    return BUILD
