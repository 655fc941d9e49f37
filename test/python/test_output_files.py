"""Files that commands write: whole or not at all, and never over what they may not replace."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from deixis_frontend.errors import UserError
from deixis_frontend.output_files import UnfinishedFile, write_text


@pytest.fixture(params=["hard links", "no hard links"])
def file(request: pytest.FixtureRequest, tmp_path: Path,
         monkeypatch: pytest.MonkeyPatch) -> UnfinishedFile:
    """A complete one that may replace nothing, on disks of both kinds."""
    def refuse(*_: object) -> None:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    if request.param == "no hard links":
        monkeypatch.setattr(os, "link", refuse)
    file = UnfinishedFile(tmp_path / "x", "--output", may_replace=False)
    file.path.write_text("new", encoding="ascii")
    return file


def test_a_kept_file_has_its_name_only(file: UnfinishedFile) -> None:
    with file:
        file.keep()
    assert list(file.target.parent.iterdir()) == [file.target]
    assert file.target.read_text(encoding="ascii") == "new"


def test_a_file_that_came_meanwhile_stays_and_ours_is_not_lost(file: UnfinishedFile) -> None:
    file.target.write_text("old", encoding="ascii")
    with file, pytest.raises(UserError, match=f"has come meanwhile.*kept in {file.path}"):
        file.keep()
    assert file.target.read_text(encoding="ascii") == "old"
    assert file.path.read_text(encoding="ascii") == "new"


def test_what_was_taken_away_meanwhile_is_told_and_leaves_no_empty_file(
        file: UnfinishedFile) -> None:
    file.path.unlink()
    with pytest.raises(UserError, match="x cannot be written: No such file or directory"):
        file.keep()
    assert not list(file.target.parent.iterdir())


def test_what_is_not_kept_is_taken_away(file: UnfinishedFile) -> None:
    with file:
        pass
    assert not list(file.target.parent.iterdir())


def test_a_text_that_finds_no_room_leaves_the_old_one(tmp_path: Path,
                                                      monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "x"
    write_text(target, "old", "--output")

    def fill_the_disk(path: Path, text: str, **_: object) -> None:
        path.write_bytes(text[:1].encode())
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", fill_the_disk)
    with pytest.raises(UserError, match="x cannot be written: No space left on device: name another"):
        write_text(target, "new", "--output")
    assert target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_text_may_go_to_a_device(tmp_path: Path) -> None:
    (tmp_path / "nowhere").symlink_to("/dev/null")
    write_text(tmp_path / "nowhere", "new", "--output")
    assert list(tmp_path.iterdir()) == [tmp_path / "nowhere"]
