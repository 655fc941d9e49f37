"""`deixis procman`: what a procman sheriff reads says the same as the system file."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest
import sheriff_grammar
from bench import Bench

from deixis_frontend.cli import main
from deixis_frontend.layout import find


def text_of(bench: Bench, *arguments: str) -> str:
    output = bench.folder / "out.pmd"
    result = bench.deixis("procman", "--output", str(output), "--force", *arguments)
    assert result.returncode == 0, result.stderr
    return output.read_text(encoding="utf-8")


def read(bench: Bench, *arguments: str) -> sheriff_grammar.SheriffFile:
    return sheriff_grammar.read(text_of(bench, *arguments), "libbot2")


def test_a_command_says_all_that_the_entry_says(bench: Bench) -> None:
    (bench.folder / "other.yaml").write_text("", encoding="ascii")
    bench.write({"eyes": {"config": "other.yaml", "set": {"a.b": 'say "x" \\ y', "n": 2},
                          "args": ["--fast", "a b"], "restart": "always", "stop_within_s": 2.5},
                 "ears": {"restart": "never"}}, channel_prefix="robot/")
    [commands] = read(bench, "--deputy", "head").groups.values()
    eyes, ears = commands["eyes"], commands["ears"]
    words = shlex.split(str(eyes.pop("exec")))
    assert words[0] == "/usr/bin/env" and words[1] == f"--chdir={find().state}"
    assert words[2].startswith("DEIXIS_CONFIG_DIR=/")
    assert words[3:] == [
        str(bench.folder / "bin/deixis-fake"), "--lcm-url", bench.url, "--channel-prefix", "robot/",
        "--instance", "eyes", "--config", str(bench.folder / "other.yaml"),
        "--set", 'a.b=say "x" \\ y', "--set", "n=2", "--fast", "a b"]
    assert eyes == {"host": "head", "auto_respawn": "true", "stop_signal": 15,
                    "stop_time_allowed": 3}
    assert ears["auto_respawn"] == "false"


def test_the_bus_is_the_one_that_is_asked_for(bench: Bench) -> None:
    bench.write({"eyes": {}})
    url = "udpm://239.255.76.67:7777?ttl=1&recv_buf_size=9"
    [commands] = read(bench, "-l", url).groups.values()
    assert url in shlex.split(str(commands["eyes"]["exec"]))


def test_the_script_starts_in_order_and_waits_for_those_that_are_waited_for(bench: Bench) -> None:
    bench.write({"camera": {"after": ["eyes", "ears"]}, "eyes": {}, "ears": {"needs": ["base"]},
                 "base": {}, "viewer": {}}, start=["camera", "eyes", "ears"])
    scripts = read(bench, "--wait-ms", "700").scripts
    assert scripts["start"] == [
        ("start", "cmd", "eyes"), ("start", "cmd", "base"),
        ("wait", "cmd", "base", "running"), ("wait", "ms", "700"), ("start", "cmd", "ears"),
        ("wait", "cmd", "eyes", "running"), ("wait", "cmd", "ears", "running"),
        ("wait", "ms", "700"), ("start", "cmd", "camera")]
    assert scripts["stop"] == [("stop", "group", "bench")]


@pytest.mark.parametrize("sheriff", list(sheriff_grammar.ATTRIBUTES))
def test_every_sheriff_gets_the_words_it_knows(bench: Bench, sheriff: str) -> None:
    bench.write({"eyes": {}})
    text = text_of(bench, "--sheriff", sheriff, "--deputy", "head")
    [commands] = sheriff_grammar.read(text, sheriff).groups.values()
    assert commands["eyes"]["deputy" if sheriff == "procman" else "host"] == "head"
    for other in set(sheriff_grammar.ATTRIBUTES) - {sheriff, "libbot2"}:
        with pytest.raises(sheriff_grammar.GrammarError):
            sheriff_grammar.read(text + 'cmd "x" {}', other)


def test_the_shipped_system_can_be_written(repository: Path, build: Path, tmp_path: Path,
                                           monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DEIXIS_BUILD_DIR", str(build))
    output = tmp_path / "deixis.pmd"
    assert main(["procman", "--output", str(output), "--system",
                 str(repository / "config/system.yaml")]) == 0
    file = sheriff_grammar.read(output.read_text(encoding="utf-8"), "libbot2")
    assert "camera_driver" in file.groups["deixis"]
    assert file.scripts["start"][-1] == ("start", "cmd", "camera_driver")
    assert file.scripts["start stereo"][-1] == ("start", "cmd", "stereo_driver")


def test_what_procman_would_change_is_refused(bench: Bench) -> None:
    bench.write({"eyes": {"set": {"a": "$HOME"}}})
    result = bench.deixis("procman", "--output", str(bench.folder / "x.pmd"))
    assert result.returncode == 1 and "'a=$HOME' holds a '$'" in result.stderr
    assert not list(bench.folder.glob("x.pmd*"))


def test_what_procman_cannot_say_is_told(bench: Bench) -> None:
    bench.write({"eyes": {"restart": "on_failure"}})
    result = bench.deixis("procman", "--output", str(bench.folder / "x.pmd"))
    assert result.returncode == 0
    assert "eyes: procman knows no 'restart: on_failure'" in result.stderr


def test_a_file_that_is_there_stays_without_force(bench: Bench) -> None:
    bench.write({"eyes": {}})
    output = bench.folder / "x.pmd"
    output.write_text("old", encoding="ascii")
    result = bench.deixis("procman", "--output", str(output))
    assert result.returncode == 1 and "is there already" in result.stderr
    assert output.read_text(encoding="ascii") == "old"


@pytest.mark.parametrize("text", [
    'group "a" { cmd "b" { exec = "x" } }', 'group "a" { cmd "b" { host = "x"; } }',
    'group "a" { cmd "b" { exec = "x"; stop_signal = "2"; } }', 'script "a" { wait "b"; }',
    'group "a/b" { }', 'group "a" { cmd "b" { exec = "x; } }', 'script "s" {} script "s" {}',
    'group "a" { cmd "b" { exec = "x"; stop_time_allowed = 0; } }'])
def test_the_reader_refuses_what_a_sheriff_refuses(text: str) -> None:
    with pytest.raises(sheriff_grammar.GrammarError):
        sheriff_grammar.read(text, "libbot2")
