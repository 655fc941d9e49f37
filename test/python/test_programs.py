"""Programs that the front end runs to their end, and the files that it finds for them."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from bench import becomes_true, is_alive, killed_after

from deixis_frontend import layout as layouts
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.programs import program_lines, run_program


@pytest.fixture
def layout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Layout:
    """Programs and configuration in a folder of their own."""
    monkeypatch.delenv("DEIXIS_CONFIG_DIR", raising=False)
    (tmp_path / "config").mkdir()
    return replace(layouts.find(), programs=tmp_path, config=tmp_path / "config")


def write_program(layout: Layout, script: str) -> None:
    path = layout.programs / "deixis-x"
    path.write_text(f"#!/bin/sh\n{script}\n", encoding="ascii")
    path.chmod(0o755)


def test_a_program_gets_its_arguments_and_the_configuration_folder(layout: Layout) -> None:
    write_program(layout, 'echo "$1 of $# in $DEIXIS_CONFIG_DIR"')
    assert run_program(layout, "deixis-x", "a b", "c") == f"a b of 2 in {layout.config}\n"
    mine = replace(layout, own_config=Path("/elsewhere"))
    assert run_program(mine, "deixis-x", "a") == "a of 1 in /elsewhere\n"


def test_a_program_that_crashes_is_said_to(layout: Layout) -> None:
    write_program(layout, "echo '20 %' >&2; kill -SEGV $$")
    with pytest.raises(UserError, match="^deixis-x failed: ended by Segmentation fault; before that: 20 %$"):
        run_program(layout, "deixis-x")


def test_a_hint_below_the_error_is_passed_over(layout: Layout) -> None:
    write_program(layout, "echo '--x: unknown option' >&2; echo 'Run with --help for more"
                          " information.' >&2; exit 2")
    with pytest.raises(UserError, match="^deixis-x failed: --x: unknown option$"):
        run_program(layout, "deixis-x")


def test_a_program_that_names_itself_is_named_once(layout: Layout) -> None:
    write_program(layout, "echo 'deixis-x: no such joint' >&2; exit 1")
    with pytest.raises(UserError, match="^deixis-x failed: no such joint$"):
        run_program(layout, "deixis-x")


def test_lines_come_while_the_program_runs_however_much_it_warns(layout: Layout) -> None:
    go_on = layout.programs / "go_on"
    write_program(layout, f"echo one; until test -e {go_on}; do sleep 0.02; done;"
                          " head -c 300000 /dev/zero | tr '\\0' '\\n' >&2; echo 'a warning' >&2;"
                          " echo two")
    lines = program_lines(layout, "deixis-x")
    assert next(lines) == "one\n"
    go_on.touch()
    assert list(lines) == ["two\n"]


def test_a_program_ends_when_its_lines_are_not_wanted_any_more(layout: Layout) -> None:
    write_program(layout, "echo $$; exec sleep 60")
    lines = program_lines(layout, "deixis-x")
    pid = int(next(lines))
    lines.close()
    assert not is_alive(pid)


def test_a_program_ends_with_the_front_end(layout: Layout) -> None:
    write_program(layout, "echo $$; exec sleep 60")
    script = ("import sys; from dataclasses import replace; from pathlib import Path;"
              " from deixis_frontend import layout, programs;"
              " where = replace(layout.find(), programs=Path(sys.argv[1]));"
              " [print(line, flush=True) for line in programs.program_lines(where, 'deixis-x')]")
    with subprocess.Popen([sys.executable, "-c", script, layout.programs], text=True,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
                          stdout=subprocess.PIPE) as front_end:
        assert front_end.stdout is not None
        with killed_after(30.0, front_end):
            pid = int(front_end.stdout.readline())
        front_end.kill()
    assert becomes_true(lambda: not is_alive(pid))


def test_the_users_configuration_folder_goes_first(
        layout: Layout, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "system.yaml").touch()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DEIXIS_CONFIG_DIR", "mine")
    mine = layouts.find()
    assert mine.find_config("system.yaml") == tmp_path / "mine" / "system.yaml"
    assert mine.find_config("viewer.yaml") == mine.config / "viewer.yaml"
    assert mine.environment()["DEIXIS_CONFIG_DIR"] == str(tmp_path / "mine")
    monkeypatch.setenv("DEIXIS_CONFIG_DIR", "nowhere")
    with pytest.raises(UserError, match="DEIXIS_CONFIG_DIR=nowhere: no such folder"):
        layouts.find()


def test_the_last_line_of_a_program_that_fails_is_told(layout: Layout) -> None:
    write_program(layout, "echo first >&2; echo 'speed: must be positive' >&2; exit 1")
    with pytest.raises(UserError, match="^deixis-x failed: speed: must be positive$"):
        run_program(layout, "deixis-x")


def test_a_program_that_fails_without_a_word_is_told_by_its_exit_code(layout: Layout) -> None:
    write_program(layout, "exit 7")
    with pytest.raises(UserError, match="^deixis-x failed: exit code 7$"):
        run_program(layout, "deixis-x")


def test_a_configuration_file_is_found_beside_its_mention_then_in_the_configuration_folder(
        layout: Layout, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    beside, caller = tmp_path / "beside", tmp_path / "caller"
    for folder in (beside, caller):
        folder.mkdir()
        (folder / f"{folder.name}.yaml").touch()
    monkeypatch.chdir(caller)
    assert layout.config_file("beside.yaml", beside) == beside / "beside.yaml"
    assert layout.config_file("beside.yaml", Path("../beside")).is_absolute()
    assert layout.config_file("caller.yaml", beside) == layout.config / "caller.yaml"
    assert layout.config_file("/nowhere/x.yaml", beside) == Path("/nowhere/x.yaml")
