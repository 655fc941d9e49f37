"""What is wrong on the command line is told at once, in one line, before any work."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from bench import heed_interrupts
from deixis import objects_t
from front_end import run, write_log

from deixis_frontend.cli import main


@pytest.mark.parametrize("arguments", [
    "record --seconds nan", "record --seconds -1", "record --seconds 0", "demo --seconds nan",
    "demo --seconds -1", "demo --seconds 0", "replay x --speed inf", "replay x --speed 0",
    "replay x --channels (", "log -n -5", "log -n many", "evaluate pointing --data x --seeds 0",
    "evaluate pointing --data x --seeds -1", "evaluate live --rate 0",
    "evaluate live --seconds inf", "echo --seconds 0", "echo --count 0", "echo --field [",
    "hz --window 0", "delay --window nan", "topics --seconds -1", "doctor --seconds inf",
    "export x --mcap y --channels (", "procman --output x --wait-ms -1",
    "train-gestures --data x --output y --noise-px -1",
    "train-gestures --data x --output y --noise-px nan", "body --sex male --stature inf",
    "body --sex male --percentile 101",
])
def test_numbers_that_make_no_sense_are_wrong_usage(arguments: str,
                                                    capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(arguments.split())
    assert end.value.code == 2
    assert "argument --" in capsys.readouterr().err.replace("-n/", "")


def test_recording_needs_expressions_that_are_some(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["record", "("])
    assert end.value.code == 2
    assert "'(' is no regular expression" in capsys.readouterr().err


@pytest.mark.parametrize("words", [
    ["echo", ""], ["hz", "A", ""], ["delay", ""], ["record", ""], ["replay", "x", "--channels", ""],
    ["export", "x", "--mcap", "y", "--channels", ""]])
def test_no_channel_at_all_is_wrong_usage(words: list[str],
                                          capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(words)
    assert end.value.code == 2
    assert "'' is no channel: name one, or '.*' for all" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["record", "echo", "hz"])
def test_expressions_that_cannot_stand_within_others_are_refused(
        command: str, url: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command, "(?i)camera", "B", "-l", url]) == 1
    [line] = capsys.readouterr().err.splitlines()
    assert "write for example (?i:name)" in line


def test_packages_that_a_command_needs_are_named(tmp_path: Path) -> None:
    code = ("import sys; sys.modules['mcap'] = None; from deixis_frontend.cli import main;"
            " sys.exit(main(sys.argv[1:]))")
    done = subprocess.run([sys.executable, "-c", code, "export", "x", "--mcap", tmp_path / "y"],
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
                          capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "lacks the module 'mcap'" in done.stderr and "foxglove-schemas-protobuf" in done.stderr


@pytest.mark.parametrize("arguments", [
    ["train-hands", "--data", ".", "--output"], ["evaluate", "hands", "--data", ".", "--json"],
    ["demo", "--no-build", "--output"], ["record", "--output"]])
def test_a_name_that_no_file_can_have_is_refused(arguments: list[str], tmp_path: Path,
                                                 monkeypatch: pytest.MonkeyPatch,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([*arguments, "x" * 300]) == 1
    assert "File name too long" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [
    ["evaluate", "pointing", "--data", "x"], ["evaluate", "hands", "--data", "x"],
    ["evaluate", "events", "--data", "x"], ["evaluate", "live"]])
@pytest.mark.parametrize(("target", "fault"), [
    (".", "is a folder: name a file"), ("/proc/x.json", "cannot be written"),
    ("/dev/null/x.json", "cannot be written")])
def test_figures_that_cannot_be_written_are_refused_before_the_run(
        arguments: list[str], target: str, fault: str, tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([*arguments, "--json", target]) == 1
    [line] = capsys.readouterr().err.splitlines()
    assert line.startswith("deixis: ") and fault in line and "--json" in line


@pytest.mark.parametrize("part", ["pointing", "hands"])
def test_pictures_need_a_folder(part: str, tmp_path: Path,
                                capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").touch()
    assert main(["evaluate", part, "--data", "x", "--plots", str(tmp_path / "file")]) == 1
    assert "--plots" in (said := capsys.readouterr().err) and "is no folder" in said


def test_a_clip_without_truth_says_what_it_lacks(repository: Path,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "pointing", "--data", str(repository / "test/data/clips")]) == 1
    said = capsys.readouterr()
    assert "spread_01 (has no sequence.csv, joints.csv)" in said.out
    assert "deixis demo --clip" in said.err


def test_the_demo_needs_a_folder_for_its_output(tmp_path: Path,
                                                capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").touch()
    for output in (str(tmp_path / "file"), "/proc/x"):
        assert main(["demo", "--output", output]) == 1
        [line] = capsys.readouterr().err.splitlines()
        assert output in line and "--output" in line


BUFFERED = [{"PYTHONUNBUFFERED": ""}, {"PYTHONUNBUFFERED": "1"}]


@pytest.fixture
def objects_log(tmp_path: Path) -> Path:
    """Two messages, which every tool has something to say of."""
    message = objects_t()
    return write_log(tmp_path / "x.lcmlog", [(0, "OBJECTS", message.encode()),
                                             (1000, "OBJECTS", message.encode())])


@pytest.mark.parametrize("buffered", BUFFERED)
@pytest.mark.parametrize("command", [
    "--version", "--help", "echo --help", "status", "echo --log LOG", "hz --log LOG",
    "delay --log LOG", "topics --log LOG", "doctor --seconds 0.1", "export LOG --mcap MCAP",
    "replay LOG", "record -o NEW --seconds 1"])
def test_output_that_finds_no_room_is_told_in_one_line(
        command: str, buffered: dict[str, str], url: str, objects_log: Path) -> None:
    names = {"LOG": objects_log, "MCAP": objects_log.with_name("x.mcap"),
             "NEW": objects_log.with_name("new")}
    words = [names.get(word, word) for word in command.split()]
    done = into("/dev/full", words, url, buffered)
    assert done.stderr == "deixis: cannot write the output: No space left on device\n"
    assert done.returncode == 1
    assert not list(objects_log.parent.glob("*.part"))


@pytest.mark.parametrize("buffered", BUFFERED)
@pytest.mark.parametrize("command", ["--help", "echo --log LOG"])
def test_a_reader_that_has_gone_is_not_told(command: str, buffered: dict[str, str], url: str,
                                            objects_log: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    words = [objects_log if word == "LOG" else word for word in command.split()]
    done = into(writer, words, url, buffered)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, "")


def test_output_that_is_closed_is_not_wanted(url: str, objects_log: Path) -> None:
    done = run(url, ["sh", "-c", '"$@" >&-', "sh", sys.executable, "-m", "deixis_frontend", "echo",
                     "--log", objects_log])
    assert (done.returncode, done.stderr) == (0, "")


def into(output: str | int, words: list[object], url: str,
         variables: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """Runs a command with its output going there."""
    path = {"PYTHONPATH": os.pathsep.join(sys.path), "LCM_DEFAULT_URL": url}
    with open(output, "w", encoding="utf-8", closefd=isinstance(output, str)) as file:
        return subprocess.run([sys.executable, "-m", "deixis_frontend", *map(str, words)],
                              env={**os.environ, **path, **variables}, stdout=file,
                              stderr=subprocess.PIPE, text=True, check=False, timeout=60)


def test_an_early_interrupt_ends_without_a_word(tmp_path: Path) -> None:
    """The interrupt comes from within, while the command line is being loaded."""
    (tmp_path / "argparse.py").write_text(
        "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(30)\n",
        encoding="ascii")
    path = os.pathsep.join([str(tmp_path), *sys.path])
    done = subprocess.run([sys.executable, "-m", "deixis_frontend", "--version"], text=True,
                          env={**os.environ, "PYTHONPATH": path}, capture_output=True, timeout=20,
                          check=False, preexec_fn=heed_interrupts)
    assert (done.returncode, done.stdout, done.stderr) == (128 + signal.SIGINT, "", "")
