"""Scoring of recognised gestures, and the recordings that the evaluation runs on."""

from pathlib import Path

import pytest

pytest.importorskip("numpy")

from deixis_frontend.evaluation.gesture_scores import RecognisedGesture, Score, score_sequence, summarise
from deixis_frontend.evaluation.sequences import LabelledGesture, SceneObject, read_sequences
from deixis_frontend.training.recordings import header, write_recordings

FPS = 10.0
GESTURE = LabelledGesture(10, 20, 40, 50, "right", 3, "cup")


def event(time_s: float, object_id: int = 3, outcome: str = "object") -> RecognisedGesture:
    return RecognisedGesture(time_s, "right", outcome, object_id)


def score(*events: RecognisedGesture, names_objects: bool = True) -> Score:
    return score_sequence([GESTURE], events, FPS, 200, names_objects=names_objects)


def test_a_recognition_counts_until_half_a_second_after_the_hold():
    assert score(event(1.0)).correct == 1
    assert score(event(4.5)).correct == 1
    late = score(event(4.7))
    assert (late.correct, late.deletions, late.insertions) == (0, 1, 1)


def test_the_wrong_object_is_a_substitution():
    wrong = score(event(2.5, object_id=4))
    assert (wrong.correct, wrong.substitutions, wrong.deletions) == (0, 1, 0)
    assert wrong.wer_percent == 100.0


def test_time_alone_decides_where_no_object_is_named():
    assert score(event(2.5, -1, "no_object"), names_objects=False).correct == 1


def test_a_second_event_in_a_gesture_is_an_insertion_but_no_false_alarm_of_free_motion():
    twice = score(event(2.5), event(3.5))
    assert (twice.correct, twice.insertions, twice.free_alarms) == (1, 1, 0)


def test_alarms_outside_gestures_are_counted_by_the_minute_of_free_motion():
    alarm = score(event(12.0))
    assert alarm.free_alarms == 1
    assert alarm.false_alarms_per_min == pytest.approx(1 / (16.0 / 60.0))


def test_nothing_recognised_is_a_deletion():
    assert score().deletions == 1


def test_the_summary_has_the_means_and_the_delay():
    summary = summarise([score(event(2.5)), score()])
    assert summary["correct"] == 0.5
    assert summary["recognition_percent"] == 50.0
    assert summary["decision_delay_median_s"] == pytest.approx(0.5)


def write_sequence(folder: Path) -> None:
    folder.mkdir()
    (folder / "sequence.csv").write_text("key,value\nkind,pointing\nfps,10\nframes,2\n")
    (folder / "person.csv").write_text("key,value\nid,anna\n")
    places = {"r_hand": (300, 200), "l_hand": (340, 210), "nose": (320, 100), "chin": (320, 120),
              "head_top": (320, 60)}
    rows = [f"{frame},0,{name},0,{v / 100},2,{u},{v},1" for frame in range(2)
            for name, (u, v) in places.items()]
    (folder / "joints.csv").write_text("frame,time_s,joint,x,y,z,u,v,visible\n" + "\n".join(rows) + "\n")
    (folder / "objects.csv").write_text(
        "id,label,x,y,z,u_min,v_min,u_max,v_max\n3,cup,0,0,2,10,20,40,60\n")
    (folder / "gestures.csv").write_text(
        "start_frame,apex_frame,end_frame,hand,object_id,retract_end_frame,object_label\n"
        "0,1,1,right,3,1,cup\n")


def test_sequences_become_recordings(tmp_path: Path):
    write_sequence(tmp_path / "spread_01")
    write_sequence(tmp_path / "my walk")
    (tmp_path / "notes").mkdir()
    sequences, skipped = read_sequences(tmp_path)
    assert [s.reason for s in skipped] == ["has no sequence.csv, joints.csv"]
    write_recordings(sequences, tmp_path / "out")
    lines = (tmp_path / "out" / "spread_01.recording").read_text().splitlines()
    assert lines[0] == "recording spread_01 anna"
    assert "\n".join(lines).replace("spread_01", "my_walk") == (
        tmp_path / "out" / "my walk.recording").read_text().strip()
    assert "object 3 cup 10.0 20.0 30.0 40.0" in lines
    assert "hand 0 right 300.00 200.00 0 1 1" in lines


def test_blanks_in_names_do_not_shift_the_words_of_a_recording():
    cup = SceneObject(3, "tea  cup", (0.0, 0.0, 2.0), (1.0, 2.0, 3.0, 4.0))
    assert header("my walk", "anna maria", [cup]) == [
        "recording my_walk anna_maria", "object 3 tea_cup 1.0 2.0 3.0 4.0"]
    assert header("x", " ", []) == ["recording x unknown"]
