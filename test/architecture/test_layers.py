"""The check of the layers: clean on this repository, and each fault is found."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from check_layers import check

FOLDERS = ("lcmtypes", "common", "common/skin", "config", "scripts", "test", "services",
           "services/hand_tracker", "services/viewer", "services/offline")


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A small tree without faults."""
    for folder in FOLDERS:
        (tmp_path / folder).mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / "README.md").touch()
    (tmp_path / "README.md").touch()
    (tmp_path / "services/hand_tracker/core").mkdir()
    write(tmp_path, "services/hand_tracker/core/tracker.h",
          '#include <Eigen/Core>\n#include "common/skin/skin.h"\n'
          '#include "services/hand_tracker/core/blob.h"\n')
    return tmp_path


def write(tree: Path, name: str, text: str) -> None:
    path = tree / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def test_this_repository_is_clean() -> None:
    assert check(Path(__file__).resolve().parents[2]) == []


def test_a_tree_without_faults_is_clean(tree: Path) -> None:
    assert check(tree) == []


@pytest.mark.parametrize("header", [
    "<lcm/lcm-cpp.hpp>", '"deixis/hands_t.hpp"', "<lcmtypes_cpp/deixis/hands_t.hpp>",
    "<sensor_msgs/Image.hpp>", "<yaml-cpp/yaml.h>", "<spdlog/spdlog.h>", '"common/transport/bus.h"',
    '"common/messages/codec.h"', '"common/logging/log.h"',
])
def test_a_core_that_knows_the_bus_is_found(tree: Path, header: str) -> None:
    write(tree, "services/hand_tracker/core/cues/cue.cpp", f"#include {header}\n")
    [fault] = check(tree)
    assert fault.startswith("services/hand_tracker/core/cues/cue.cpp: a core includes")


def test_a_service_outside_its_core_may_know_the_bus(tree: Path) -> None:
    write(tree, "services/hand_tracker/hand_tracker_service.h",
          '#include "common/transport/bus.h"\n')
    assert check(tree) == []


def test_common_that_names_a_service_is_found(tree: Path) -> None:
    write(tree, "common/skin/skin.h", "// one\n// For hand_tracker.\n")
    [fault] = check(tree)
    assert fault.startswith("common/skin/skin.h:2: common/ names the service hand_tracker")


def test_a_service_that_includes_another_one_is_found(tree: Path) -> None:
    write(tree, "services/viewer/a.cpp", '#include "services/hand_tracker/core/tracker.h"\n')
    [fault] = check(tree)
    assert "services/viewer/a.cpp: a service includes" in fault


def test_offline_may_include_all_services(tree: Path) -> None:
    write(tree, "services/offline/a.cpp", '#include "services/hand_tracker/core/tracker.h"\n')
    assert check(tree) == []


@pytest.mark.parametrize("name", ["services/viewer/utils/a.h", "common/skin/manager/a.h",
                                  "common/skin/common.h", "scripts/misc/x"])
def test_a_catch_all_is_found(tree: Path, name: str) -> None:
    write(tree, name, "")
    [fault] = check(tree)
    assert "the name tells nothing" in fault


def test_a_stray_entry_at_the_top_is_found(tree: Path) -> None:
    write(tree, "notes.txt", "")
    assert check(tree) == ["notes.txt: not one of the entries that the top level may hold"]


def test_hidden_files_and_what_is_built_are_no_stray_entries(tree: Path) -> None:
    write(tree, ".clang-format", "")
    write(tree, "build/release/x", "")
    write(tree, "output/demo/x", "")
    assert check(tree) == []


def test_with_git_what_is_not_tracked_is_no_stray_entry(tree: Path) -> None:
    git = shutil.which("git") or pytest.skip("no git here")
    for command in (["init", "-q"], ["add", "."]):
        subprocess.run([git, "-C", str(tree), *command], check=True)
    write(tree, "walk.lcmlog", "")
    write(tree, "config/utils/mine.yaml", "")
    assert check(tree) == []
    write(tree, "notes.txt", "")
    subprocess.run([git, "-C", str(tree), "add", "notes.txt"], check=True)
    assert check(tree) == ["notes.txt: not one of the entries that the top level may hold"]


@pytest.mark.parametrize("folder", FOLDERS)
def test_a_missing_readme_is_found(tree: Path, folder: str) -> None:
    (tree / folder / "README.md").unlink()
    assert check(tree) == [f"{folder}: no README.md"]
