"""Training from a log with labels, and what is refused: each fault with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from deixis import hand_tracks_t, object_t, objects_t

from deixis_frontend import layout
from deixis_frontend.cli import main
from deixis_frontend.training.log_recordings import write_log_recording
from deixis_lcm import logs

FIRST_LINE = "start_s,apex_s,end_s,retract_end_s,hand,object_id\n"
GOOD = "1,2,3,4,right,5\n"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Five seconds with a lamp."""
    lamp = object_t()
    lamp.id, lamp.label, lamp.kind, lamp.has_box = 5, "lamp", object_t.PLACE, True
    lamp.box_px = [1.0, 2.0, 3.0, 4.0]
    things = objects_t()
    things.objects, things.n_objects = [lamp], 1
    path = tmp_path / "my walk.lcmlog"
    with logs.Writer(path) as file:
        file.write(0, "OBJECTS", things)
        for number in range(6):
            message = hand_tracks_t()
            message.utime = 1_000_000 * number
            file.write(message.utime, "HAND_TRACKS", message)
    return path


def train(log: Path, labels: str | Path, *more: str) -> int:
    """Runs the command; `labels` are what the file holds, or a path."""
    path = labels if isinstance(labels, Path) else log.with_name("labels.csv")
    if isinstance(labels, str):
        path.write_text(labels, encoding="ascii")
    output = [] if "--output" in more else ["--output", str(log.with_name("out") / "x.yaml")]
    return main(["train-gestures", "--data", str(log), "--labels", str(path), *output, *more])


def test_a_log_with_labels_becomes_a_recording(log: Path, tmp_path: Path) -> None:
    labels = tmp_path / "labels.csv"
    labels.write_text(FIRST_LINE + GOOD, encoding="ascii")
    write_log_recording(layout.find(), log, labels, tmp_path / "out")
    lines = (tmp_path / "out" / "my walk.recording").read_text(encoding="ascii").splitlines()
    assert lines[:4] == ["recording my_walk unknown", "object 5 lamp 1.0 2.0 3.0 4.0",
                         "gesture 1.0000 2.0000 3.0000 4.0000 right 5", "frame 0.000000"]


@pytest.mark.parametrize(("line", "fault"), [
    ("1,2,3,4,right,99", "object_id 99 is not among the objects of the recording (5)"),
    ("1,2,3,4,right,lamp", "object_id 'lamp' is not a whole number"),
    ("1,2,3,4,foot,5", "hand 'foot' is not one of left, right"),
    ("-5,2,3,4,right,5", "-5 s to 3 s is not within the recording (0 to 5.000 s)"),
    ("1,2,300,400,right,5", "1 s to 300 s is not within the recording"),
    ("2.5,2,3,4,right,5", "times are out of order: start_s < apex_s <= end_s <= retract_end_s"),
    ("nan,2,3,4,right,5", "start_s 'nan' is not a number"),
    ("1,2,3,4,right", "has not as many columns as the first line (6)"),
    ("1,2,3,4,right,5,6", "has not as many columns as the first line (6)"),
])
def test_wrong_labels_are_told_with_file_and_line(log: Path, line: str, fault: str,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    assert train(log, f"{FIRST_LINE}{GOOD}{line}\n") == 1
    assert f"deixis: {log.with_name('labels.csv')}:3: {fault}" in capsys.readouterr().err


def test_all_wrong_labels_are_told(log: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert train(log, f"{FIRST_LINE}1,2,3,4,right,99\n{GOOD}1,2,3,4,foot,5\n") == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[2] for line in lines] == ["2", "4"]


def test_labels_that_cannot_be_read_are_told(log: Path, tmp_path: Path,
                                             capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "binary").write_bytes(bytes(range(256)))
    for name in ("nofile", ".", "binary"):
        assert train(log, tmp_path / name) == 1
        [line] = capsys.readouterr().err.splitlines()
        assert str(tmp_path / name) in line
    assert train(log, "start_s,apex_s\n1,2\n") == 1
    assert "labels.csv:1: has no column end_s, retract_end_s" in capsys.readouterr().err


def test_what_is_no_log_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x.lcmlog").write_bytes(bytes(100))
    assert train(tmp_path / "x.lcmlog", FIRST_LINE + GOOD) == 1
    assert "x.lcmlog is no LCM log" in capsys.readouterr().err


@pytest.mark.parametrize(("output", "fault"), [
    ("/tmp", "is a folder"), ("", "is a folder"), ("/proc/x.yaml", "cannot be written"),
    ("somewhere/rest.yaml", "rest.yaml is the name of the model of rest")])
def test_an_output_that_cannot_be_written_is_refused(log: Path, output: str, fault: str,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    assert train(log, FIRST_LINE + GOOD, "--output", output) == 1
    [line] = capsys.readouterr().err.splitlines()
    assert fault in line and "--output" in line


def test_labels_go_with_logs_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert train(tmp_path, FIRST_LINE + GOOD, "--output", str(tmp_path / "x.yaml")) == 1
    assert "--labels goes with a log" in capsys.readouterr().err


def write_sequence(folder: Path, gestures: str) -> None:
    """A sequence folder as far as it is read before the labels are."""
    folder.mkdir()
    header = "start_frame,apex_frame,end_frame,hand,object_id,retract_end_frame,object_label\n"
    for name, text in {"sequence": "key,value\nfps,15\nframes,1\n", "joints": "",
                       "person": "key,value\nid,anna\n", "gestures": header + gestures,
                       "objects": "id,label,x,y,z,u_min,v_min,u_max,v_max\n"}.items():
        (folder / f"{name}.csv").write_text(text, encoding="ascii")


def test_a_person_that_is_not_there_cannot_be_left_out(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_sequence(tmp_path / "one", "")
    assert main(["train-gestures", "--data", str(tmp_path), "--exclude-person", "NOPE",
                 "--output", str(tmp_path / "x.yaml")]) == 1
    assert "nobody of that name is there: there are anna" in capsys.readouterr().err


def test_wrong_labels_of_a_sequence_are_told_with_file_and_line(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_sequence(tmp_path / "one", "1,2,3,foot,5,4,lamp\n")
    assert main(["train-gestures", "--data", str(tmp_path),
                 "--output", str(tmp_path / "x.yaml")]) == 1
    assert "one/gestures.csv:2: hand 'foot'" in capsys.readouterr().err


def test_the_model_has_the_name_of_its_file(log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def trainer(_where: object, _program: str, *options: str) -> str:
        given = dict(zip(options[::2], options[1::2]))
        folder = Path(given["--output"])
        folder.mkdir()
        (folder / f"{given['--name']}.yaml").write_text(f"name: {given['--name']}\n", "utf-8")
        (folder / "rest.yaml").write_text("name: rest\n", "utf-8")
        return ""

    monkeypatch.setattr("deixis_frontend.training.gestures.run_program", trainer)
    wave = log.with_name("models") / "wave.yaml"
    wave.parent.mkdir()
    assert train(log, FIRST_LINE + GOOD, "--output", str(wave)) == 0
    assert wave.read_text("utf-8") == "name: wave\n"
    assert wave.with_name("rest.yaml").read_text("utf-8") == "name: rest\n"
