"""Log files that are moved aside: no line lost, none torn, and a full disk does no harm."""

from __future__ import annotations

from pathlib import Path

import pytest

from deixis_frontend.supervision.rotating_log import RotatingLog


def everything(folder: Path) -> bytes:
    """All that was written, oldest first."""
    files = sorted(folder.glob("x.log*"), key=lambda path: path.suffix.removeprefix(".log"))
    numbered = sorted((p for p in files if p.suffix != ".log"), key=lambda p: -int(p.suffix[1:]))
    return b"".join(path.read_bytes() for path in [*numbered, folder / "x.log"])


def test_keeps_the_newest_files(tmp_path: Path) -> None:
    log = RotatingLog(tmp_path / "x.log", 10, 2)
    for line in (b"aaaaaaa\n", b"bbbbbbb\n", b"ccccccc\n", b"ddddddd\n"):
        log.write(line)
    assert everything(tmp_path) == b"bbbbbbb\nccccccc\nddddddd\n"
    assert (tmp_path / "x.log").read_bytes() == b"ddddddd\n"


@pytest.mark.parametrize("piece", [1, 3, 7, 64, 1000])
def test_loses_and_tears_no_line_however_it_is_cut(tmp_path: Path, piece: int) -> None:
    data = b"".join(b"line %d\n" % number for number in range(100))
    log = RotatingLog(tmp_path / "x.log", 64, 99)
    for begin in range(0, len(data), piece):
        log.write(data[begin: begin + piece])
    assert everything(tmp_path) == data
    assert all(path.read_bytes().endswith(b"\n") for path in tmp_path.iterdir())


def test_a_line_without_end_does_not_grow_for_ever(tmp_path: Path) -> None:
    log = RotatingLog(tmp_path / "x.log", 10, 2)
    for _ in range(100):
        log.write(b"xxxxx")
    assert max(path.stat().st_size for path in tmp_path.iterdir()) <= 30


def test_goes_on_in_the_file_that_is_there(tmp_path: Path) -> None:
    RotatingLog(tmp_path / "x.log", 100, 2).write(b"a\n")
    RotatingLog(tmp_path / "x.log", 100, 2).write(b"b\n")
    assert everything(tmp_path) == b"a\nb\n"


def test_a_full_disk_loses_lines_and_goes_on(tmp_path: Path) -> None:
    (tmp_path / "x.log").symlink_to("/dev/full")
    log = RotatingLog(tmp_path / "x.log", 100, 2)
    log.write(b"lost\n")
    assert log.lost_bytes == 5
    (tmp_path / "x.log").unlink()
    log.write(b"kept\n")
    assert everything(tmp_path) == b"kept\n"
