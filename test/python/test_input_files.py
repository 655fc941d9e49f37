"""What cannot be read to an end is refused before anything waits for it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from deixis_frontend import csv_table
from deixis_frontend.cli import main
from deixis_frontend.errors import UserError


@pytest.fixture
def pipe(tmp_path: Path) -> Path:
    """A pipe into which nobody writes."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


@pytest.mark.parametrize("words", [
    ["start", "--system"], ["status", "--system"], ["log", "--system"], ["replay"]])
def test_pipes_and_devices_are_no_files_to_read(
        words: list[str], pipe: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path, kind in ((pipe, "a pipe"), (Path("/dev/zero"), "a device"),
                       (pipe.parent, "a folder")):
        assert main([*words, str(path)]) == 1
        assert f"deixis: {path} is {kind}: name a regular file" in capsys.readouterr().err


def test_run_offline_refuses_a_pipe(pipe: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run-offline", str(pipe), str(pipe.parent / "out")]) == 1
    assert f"{pipe} is a pipe" in capsys.readouterr().err


def test_a_table_that_is_a_pipe_is_refused(pipe: Path) -> None:
    with pytest.raises(UserError, match="pipe is a pipe: name a regular file"):
        csv_table.read(pipe, ("start_s",))


def test_a_link_to_a_regular_file_is_one(tmp_path: Path,
                                         capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x").write_text("no log", encoding="ascii")
    (tmp_path / "link").symlink_to(tmp_path / "x")
    assert main(["replay", str(tmp_path / "link")]) == 1
    assert "is no LCM log" in capsys.readouterr().err
