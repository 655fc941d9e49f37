"""The system file: what is read, and that every fault is named with file, line, key and cure."""

from __future__ import annotations

from pathlib import Path

import pytest

from deixis_frontend.errors import Refusal, UserError
from deixis_frontend.supervision.system_file import System, load

GOOD = """\
name: robot
start: [eyes]
log: {folder: logs, size_mb: 1, count: 2}
services:
  camera_driver:
    groups: [eyes]
    set: {source.kind: video, rate: 3}
    args: [--x, "1"]
  hand_tracker:
    after: [camera_driver]
    groups: [eyes]
    restart: never
"""


def read(folder: Path, text: str) -> System:
    path = folder / "system.yaml"
    path.write_text(text, encoding="utf-8")
    return load(path)


def faults(folder: Path, text: str) -> list[str]:
    with pytest.raises(Refusal) as refusal:
        read(folder, text)
    return [fault.replace(f"{folder}/", "") for fault in refusal.value.faults]


def test_the_shipped_file_is_read(repository: Path) -> None:
    system = load(repository / "config" / "system.yaml")
    assert system.resolve(list(system.start)) == [
        "object_detector", "hand_tracker", "gesture_recogniser", "camera_driver"]


def test_bodies_are_fitted_where_depth_is_seen_and_shown_when_asked_for(repository: Path) -> None:
    system = load(repository / "config" / "system.yaml")
    started = system.resolve(["stereo"])
    assert started.index("pose_fitter") < started.index("stereo_driver") == len(started) - 1
    assert system.services["stereo_driver"].settings["matcher.match_size"] == "people"
    assert "pose_fitter" not in system.resolve(["pointing"])
    shown = system.services["stereo_viewer"]
    assert (shown.program, shown.settings["image_channel"]) == ("deixis-viewer", "STEREO")


def test_everything_is_read(tmp_path: Path) -> None:
    system = read(tmp_path, GOOD)
    camera = system.services["camera_driver"]
    assert camera.program == "deixis-camera-driver"
    assert camera.settings == {"source.kind": "video", "rate": "3"}
    assert camera.args == ("--x", "1")
    assert system.services["hand_tracker"].restart == "never"
    assert (system.name, system.log.size_mb, system.groups()) == ("robot", 1, ["eyes"])


def test_those_that_others_wait_for_are_started_first(tmp_path: Path) -> None:
    system = read(tmp_path, "services: {b: {needs: [a]}, a: {}, c: {after: [b]}}")
    assert system.with_needs(["c", "b"]) == ["a", "b", "c"]


def test_unknown_names_list_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="there are eyes, camera_driver, hand_tracker"):
        read(tmp_path, GOOD).resolve(["ears"])


@pytest.mark.parametrize(("change", "to", "fault"), [
    ("restart: never", "restrt: never", "system.yaml:12: services.hand_tracker.restrt: unknown key:"
                                        " did you mean 'restart'?"),
    ("restart: never", "restart: sometimes", "system.yaml:12: services.hand_tracker.restart:"
                                             " 'sometimes' is not one of always, on_failure, never"),
    ("restart: never", "ready_within_s: soon", "system.yaml:12: services.hand_tracker."
                                               "ready_within_s: is not a number"),
    ("restart: never", "ready_within_s: -1", "system.yaml:12: services.hand_tracker."
                                             "ready_within_s: -1 is not from 0.1 to 600"),
    ("restart: never", "give_up_after: 2.5", "system.yaml:12: services.hand_tracker."
                                             "give_up_after: is not a whole number"),
    ("restart: never", "groups: [x]", "system.yaml:12: services.hand_tracker.groups: given twice:"
                                      " remove one"),
    ("start: [eyes]", "start: [ears]", "system.yaml:2: start: names 'ears', which is no service or"
                                       " group of this file"),
    ("start: [eyes]", "start: eyes", "system.yaml:2: start: is not a list: write [a, b]"),
    ("name: robot", "name: 'my robot'", "system.yaml:1: name: 'my robot' is not made of letters,"
                                        " digits, '_' and '-' alone"),
    ("after: [camera_driver]", "after: [camera]", "system.yaml:5: services: hand_tracker.after names"
                                                  " 'camera', which is no service here"),
    ("after: [camera_driver]", "after: [hand_tracker]", "system.yaml:5: services: hand_tracker waits"
                                                        " for itself by way of its 'after' and"
                                                        " 'needs'"),
    ("after: [camera_driver]", "service: camera_driver", "system.yaml:5: services: camera_driver and"
     " hand_tracker are the same service and instance: their states could not be told apart:"
     " give one an 'instance'"),
])
def test_a_fault_is_named_with_place_and_cure(tmp_path: Path, change: str, to: str,
                                              fault: str) -> None:
    assert faults(tmp_path, GOOD.replace(change, to)) == [fault]


def test_all_faults_are_named_at_once(tmp_path: Path) -> None:
    text = GOOD.replace("restart: never", "restart: x").replace("size_mb: 1", "size_mb: x")
    assert len(faults(tmp_path, text)) == 2


def test_what_is_not_yaml_is_named_with_its_line(tmp_path: Path) -> None:
    [fault] = faults(tmp_path, "name: robot\nservices: [a\n")
    assert fault.startswith("system.yaml:3: ") and "check indentation" in fault


@pytest.mark.parametrize("text", ["", "- a\n", "name: x\n"])
def test_files_without_services_are_refused(tmp_path: Path, text: str) -> None:
    assert len(faults(tmp_path, text)) == 1


@pytest.mark.parametrize("key", ["[a]", "{a: b}"])
def test_a_key_that_is_no_text_is_named(tmp_path: Path, key: str) -> None:
    [fault] = faults(tmp_path, f"? {key}\n: 1\n{GOOD}")
    assert fault.startswith("system.yaml:1: ?: a list or a mapping is no key")


@pytest.mark.parametrize("text", ["services: " + "[" * 5000, "{a: " * 5000, "- " * 5000])
def test_a_file_that_is_nested_too_deeply_is_refused(tmp_path: Path, text: str) -> None:
    [fault] = faults(tmp_path, text)
    assert "system.yaml: is nested too deeply" in fault


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(Refusal, match="no such file: name one with --system"):
        load(tmp_path / "nowhere.yaml")
