"""The supervisor with fake services: start, crash, give up, stop, and its own death."""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from bench import Bench, becomes_true, has_read, is_alive

from deixis_frontend import layout
from deixis_frontend.commands import restart, stop, system_option
from deixis_frontend.errors import UserError
from deixis_frontend.supervision import control_client, system_file


def kill_and_wait_until_back(bench: Bench, name: str) -> float:
    """Kills a service; returns the seconds until a new process of it runs."""
    pid = bench.service(name)["pid"]
    began = time.monotonic()
    os.kill(pid, signal.SIGKILL)

    def is_back() -> bool:
        now = bench.service(name)
        return now["state"] == "running" and now["pid"] not in (None, pid)

    assert becomes_true(is_back, 5.0), bench.log(name)
    return time.monotonic() - began


def supervisor_pid(bench: Bench) -> int:
    return int(bench.status()["supervisor_pid"])


def test_start_returns_when_all_are_ready(bench: Bench) -> None:
    bench.write({"a": {"set": {"ready_after_s": 0.3}}, "b": {"after": ["a"]}})
    started = bench.deixis("start")
    assert started.returncode == 0, started.stderr
    assert [line.split()[:2] for line in started.stdout.splitlines()] == [
        ["a", "running"], ["b", "running"]]
    assert [service["state"] for service in bench.status()["services"]] == ["running"] * 2
    assert bench.deixis("stop").returncode == 0
    assert bench.deixis("status").returncode == 3


def test_columns_are_in_line_whatever_the_names(bench: Bench) -> None:
    long_name = "a_service_with_quite_a_long_name"
    bench.write({"a": {}, long_name: {}})
    for command, state in (("start", "running"), ("stop", "stopped")):
        lines = bench.deixis(command).stdout.splitlines()
        assert [line.index(state) for line in lines] == [len(long_name) + 1] * 2


def test_stop_does_not_bring_up_what_is_over(bench: Bench) -> None:
    bench.write({"a": {"set": {"state": 2, "text": "no light"}}, "b": {"set": {
        "say": "no camera", "exit_after_s": 0, "exit_code": 2}}})
    assert "no camera" in bench.deixis("start").stdout
    assert sorted(bench.deixis("stop").stdout.split()) == ["a", "b", "stopped", "stopped"]


def test_degraded_counts_as_ready_and_says_why(bench: Bench) -> None:
    bench.write({"a": {"set": {"state": 2, "text": "no light"}}})
    assert bench.deixis("start").returncode == 0
    assert "a: no light" in bench.deixis("status").stdout


def test_status_shows_rates_ages_cpu_and_memory(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    assert becomes_true(lambda: bench.service("a")["cpu_percent"] is not None)
    facts = bench.service("a")
    assert facts["processing_ms"] == {"p50": 1.5, "p99": 2.5}
    assert facts["age_ms"] == {"p50": None, "p99": None}
    assert facts["memory_mb"] > 1
    assert facts["uptime_s"] < 30


def test_start_without_names_takes_those_of_the_file(bench: Bench) -> None:
    bench.write({"a": {"groups": ["one"]}, "b": {"groups": ["two"]}}, start=["two"])
    bench.deixis("start")
    assert [s["state"] for s in bench.status()["services"]] == ["stopped", "running"]


def test_starts_what_a_service_needs(bench: Bench) -> None:
    bench.write({"b": {"needs": ["a"]}, "a": {}})
    started = bench.deixis("start", "b")
    assert [line.split()[0] for line in started.stdout.splitlines()] == ["a", "b"]


def test_does_not_start_what_lacks_what_it_needs(bench: Bench) -> None:
    bench.write({"a": {"program": "deixis-nowhere"}, "b": {"needs": ["a"]}})
    started = bench.deixis("start")
    assert started.returncode == 1
    assert "needs a, which is not running" in started.stdout


def test_killed_service_is_back_within_two_seconds_and_others_run_on(bench: Bench) -> None:
    bench.write({"a": {}, "b": {}})
    bench.deixis("start")
    untouched = bench.service("b")["pid"]
    for _ in range(4):
        assert kill_and_wait_until_back(bench, "a") < 2.0
    assert bench.service("a")["restarts"] == 4
    assert "killed by SIGKILL" in bench.service("a")["last_error"]
    assert bench.service("b")["pid"] == untouched


def test_gives_up_on_a_service_that_never_gets_ready(bench: Bench) -> None:
    bench.write({"a": {"give_up_after": 2, "set": {
        "say": "config/a.yaml:3: speed: must be positive", "exit_after_s": 0, "exit_code": 1}}})
    started = bench.deixis("start")
    assert started.returncode == 1
    assert "exit code 1: config/a.yaml:3: speed: must be positive" in started.stdout
    assert bench.service("a")["restarts"] == 1
    assert bench.service("a")["state"] == "failed"
    assert bench.deixis("status").returncode == 1


def test_does_not_try_wrong_usage_twice(bench: Bench) -> None:
    bench.write({"a": {"args": ["--no-such-option"]}})
    assert "exit code 2" in bench.deixis("start").stdout
    assert bench.service("a")["restarts"] == 0


def test_missing_program_names_the_cure(bench: Bench) -> None:
    bench.write({"a": {"program": "deixis-nowhere"}})
    assert "run scripts/build" in bench.deixis("start").stdout


def test_readiness_has_a_time_limit(bench: Bench) -> None:
    bench.write({"a": {"ready_within_s": 0.5, "give_up_after": 1, "set": {"ready_after_s": 60}}})
    started = bench.deixis("start")
    assert started.returncode == 1
    assert "not ready within 0.5 s" in started.stdout
    assert bench.service("a")["pid"] is None


def test_service_that_ends_by_itself_has_finished(bench: Bench) -> None:
    bench.write({"a": {"set": {"exit_after_s": 0.5}}})
    bench.deixis("start")
    assert becomes_true(lambda: bench.service("a")["state"] == "finished")


def test_status_of_another_process_does_not_make_a_service_ready(bench: Bench) -> None:
    bench.write({"a": {}, "b": {"instance": "x", "ready_within_s": 1.5, "give_up_after": 1,
                                "set": {"ready_after_s": 60}}})
    bench.deixis("start", "a")
    starting = bench.begin("start", "b")
    with bench.stranger("x"):
        output, _ = starting.communicate(timeout=20)
    assert "not ready within 1.5 s" in output


def test_stop_ends_children_too(bench: Bench, tmp_path: Path) -> None:
    child = tmp_path / "child"
    bench.write({"a": {"set": {"child": str(child)}}})
    bench.deixis("start")
    pid = int(child.read_text(encoding="ascii"))
    assert is_alive(pid)
    bench.deixis("stop", "a")
    assert becomes_true(lambda: not is_alive(pid))


def test_stop_kills_what_does_not_listen(bench: Bench) -> None:
    bench.write({"a": {"stop_within_s": 0.3, "set": {"ignore_stop": 1}}})
    bench.deixis("start")
    pid = bench.service("a")["pid"]
    assert bench.deixis("stop").returncode == 0
    assert not is_alive(pid)
    assert "did not stop within 0.3 s: killed" in bench.log("a")


def test_stop_of_one_leaves_the_other(bench: Bench) -> None:
    bench.write({"a": {}, "b": {}})
    bench.deixis("start")
    bench.deixis("stop", "a")
    assert [s["state"] for s in bench.status()["services"]] == ["stopped", "running"]


def test_restart_takes_the_system_file_as_it_is_now(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    bench.write({"a": {"set": {"text": "new", "state": 2}}})
    restarted = bench.deixis("restart")
    assert restarted.returncode == 0, restarted.stderr
    assert bench.service("a")["text"] == "new"


def test_restart_leaves_out_what_the_system_file_has_no_more(bench: Bench) -> None:
    bench.write({"a": {}, "b": {}})
    bench.deixis("start")
    bench.write({"b": {}, "c": {}})
    restarted = bench.deixis("restart")
    assert restarted.returncode == 0, restarted.stderr
    assert "a is stopped: it is not in" in restarted.stdout
    assert [(s["name"], s["state"]) for s in bench.status()["services"]] == [
        ("b", "running"), ("c", "stopped")]


def test_restart_starts_nothing_when_nothing_is_left_of_what_ran(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    bench.write({"b": {}}, start=["b"])
    restarted = bench.deixis("restart")
    assert restarted.returncode == 0, restarted.stderr
    assert "a is stopped: it is not in" in restarted.stdout
    assert bench.deixis("status").returncode == 3


@pytest.mark.parametrize("command", [stop, restart])
def test_a_supervisor_that_does_not_end_is_told(
        bench: Bench, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
        command: ModuleType) -> None:
    class Stubborn(system_option.Client):
        """The client of a supervisor that obeys, but does not end."""

        def is_supervised(self) -> bool:
            return True

        def command(self, command: str, *_: object) -> dict[str, Any]:
            return {"ok": True, "stopped": ["a"], "status": {
                "lcm_url": bench.url, "file": str(bench.system_file.resolve())}}

        def wait_until_gone(self, seconds: float = 10.0) -> bool:
            return False

    bench.write({"a": {}})
    monkeypatch.setattr(system_option, "Client", Stubborn)
    asked = argparse.Namespace(system=bench.system_file, names=[], lcm_url=None)
    assert command.run(asked) == 1
    assert "the supervisor has not ended: see" in capsys.readouterr().err


def test_a_configuration_file_is_looked_for_beside_the_system_file(
        bench: Bench, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for folder in (bench.folder, tmp_path):
        (folder / "mine.yaml").touch()
    monkeypatch.chdir(tmp_path)
    bench.write({"a": {"config": "mine.yaml"}})
    bench.deixis("start")
    assert f"--config {bench.folder / 'mine.yaml'}\n" in bench.log("a")


def test_restart_of_one_gives_it_a_new_process(bench: Bench) -> None:
    bench.write({"a": {}, "b": {}})
    bench.deixis("start")
    before = bench.status()["services"]
    bench.deixis("restart", "a")
    after = bench.status()["services"]
    assert before[0]["pid"] != after[0]["pid"]
    assert before[1]["pid"] == after[1]["pid"]


def test_a_system_file_that_has_changed_meanwhile_is_told(bench: Bench) -> None:
    bench.write({"a": {}})
    assert "has changed" not in bench.deixis("start").stderr
    bench.write({"a": {}, "b": {}})
    result = bench.deixis("start", "b")
    assert result.returncode == 1
    assert "has changed since the system was started" in result.stderr
    assert "`deixis restart` without names takes the changes" in result.stderr
    assert "has changed" not in bench.deixis("restart").stderr
    assert "has changed" not in bench.deixis("start", "b").stderr


def test_two_starts_at_once_make_one_supervisor(bench: Bench) -> None:
    bench.write({"a": {}})
    both = [bench.begin("start") for _ in range(2)]
    outputs = [process.communicate(timeout=30)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0], outputs
    assert bench.log("a").count("started, pid") == 1


@pytest.mark.parametrize("command", [("start",), ("start", "--foreground"), ("stop",),
                                     ("stop", "a"), ("restart",), ("restart", "a")])
def test_a_system_that_was_started_from_another_file_is_left_alone(
        bench: Bench, command: tuple[str, ...]) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    before = bench.service("a")["pid"]
    first, bench.system_file = bench.system_file, bench.folder / "other.yaml"
    bench.write({"a": {}})
    refused = bench.deixis(*command)
    assert refused.returncode == 1
    assert refused.stderr == (f"deixis: the running system 'bench' was started from {first}:"
                              f" use --system {first}, or give one of them another name\n")
    assert bench.service("a")["pid"] == before and is_alive(before)


def test_status_says_when_another_file_is_meant(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    assert bench.deixis("status").stdout.startswith("bench on ")
    first, bench.system_file = bench.system_file, bench.folder / "other.yaml"
    bench.write({"a": {}})
    shown = bench.deixis("status")
    assert shown.returncode == 0
    assert shown.stdout.startswith(f"bench from {first} on ")


def test_a_system_whose_file_is_gone_can_be_stopped_by_its_pid(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    bench.system_file = bench.system_file.rename(bench.folder / "other.yaml")
    refused = bench.deixis("stop")
    assert refused.returncode == 1
    assert f"there no more: `kill {supervisor_pid(bench)}` stops it" in refused.stderr


def test_the_supervisors_log_tells_who_stopped_it(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    pid = supervisor_pid(bench)
    stopping = bench.begin("stop")
    stopping.communicate(timeout=30)
    assert becomes_true(lambda: "ended" in bench.log("supervisor"))
    started, _, asked, ended = bench.log("supervisor").splitlines()
    assert f"supervisor: started, pid {pid}, from {bench.system_file}, on " in started
    assert "supervisor: asked to stop everything by" in asked
    assert f" pid {stopping.pid}, system file {bench.system_file}" in asked
    assert ended.endswith("supervisor: ended")


def test_services_end_when_the_supervisor_is_killed(bench: Bench, tmp_path: Path) -> None:
    child = tmp_path / "child"
    bench.write({"a": {"set": {"child": str(child)}},
                 "b": {"stop_within_s": 0.3, "set": {"ignore_stop": 1}}})
    bench.deixis("start")
    pids = [*(service["pid"] for service in bench.status()["services"]),
            int(child.read_text(encoding="ascii"))]
    os.kill(supervisor_pid(bench), signal.SIGKILL)
    assert becomes_true(lambda: not any(map(is_alive, pids)), 8.0)
    assert bench.deixis("start", "a").returncode == 0


def test_start_after_a_killed_supervisor_waits_for_its_services_to_end(bench: Bench) -> None:
    bench.write({"a": {"stop_within_s": 0.3, "set": {"ignore_stop": 1}}})
    bench.deixis("start")
    old = bench.service("a")["pid"]
    os.kill(supervisor_pid(bench), signal.SIGKILL)
    started = bench.deixis("start")
    assert started.returncode == 0, started.stdout + started.stderr
    assert not is_alive(old)


def test_a_supervisor_whose_folder_is_deleted_can_be_reached_again(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    before = bench.service("a")["pid"]
    shutil.rmtree(bench.folder / "run")
    assert becomes_true(lambda: bench.deixis("status").returncode == 0)
    assert bench.service("a")["pid"] == before
    assert bench.deixis("start").returncode == 0
    assert bench.log("a").count("started, pid") == 1
    assert bench.deixis("stop").returncode == 0
    assert not is_alive(before)


def test_of_two_supervisors_after_a_deleted_folder_the_first_one_ends(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    old_supervisor, old = supervisor_pid(bench), bench.service("a")["pid"]
    os.kill(old_supervisor, signal.SIGSTOP)  # It is to notice later than the second one starts.
    shutil.rmtree(bench.folder / "run")
    assert bench.deixis("start").returncode == 0
    os.kill(old_supervisor, signal.SIGCONT)
    assert becomes_true(lambda: not is_alive(old_supervisor) and not is_alive(old))
    assert bench.service("a")["state"] == "running"


def test_a_supervisor_that_hangs_is_told(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    pid = supervisor_pid(bench)
    monkeypatch.setenv("DEIXIS_RUN_DIR", str(bench.folder / "run"))
    monkeypatch.setattr(control_client, "_ANSWERS_WITHIN_S", 0.3)
    client = control_client.Client(system_file.load(bench.system_file), layout.find())
    os.kill(pid, signal.SIGSTOP)
    try:
        for command in ("status", "stop"):
            with pytest.raises(UserError, match=f"pid {pid}.* has not answered for 0.3 s: .*CONT"):
                client.command(command, [])
    finally:
        os.kill(pid, signal.SIGCONT)


@pytest.mark.parametrize(("folder", "fault"), [
    ("/tmp/" + 100 * "x", "path of the control socket is too long"),
    ("/proc/x", "/proc/x for locks and sockets cannot be made"),
    ("/dev/null", "/dev/null for locks and sockets cannot be made")])
def test_a_run_folder_that_will_not_do_is_refused_at_once(bench: Bench, folder: str,
                                                          fault: str) -> None:
    bench.write({"a": {}})
    started = bench.deixis("start", DEIXIS_RUN_DIR=folder)
    [line] = started.stderr.splitlines()
    assert started.returncode == 1
    assert fault in line and "DEIXIS_RUN_DIR" in line


@pytest.mark.parametrize("folder", ["/proc/nope", "/dev/null"])
def test_a_log_folder_that_cannot_be_written_is_refused_at_once(bench: Bench, folder: str) -> None:
    bench.write({"a": {}}, log={"folder": folder})
    started = bench.deixis("start")
    [line] = started.stderr.splitlines()
    assert started.returncode == 1
    assert f"{folder}/supervisor.log cannot be written" in line and "log.folder" in line


@pytest.mark.parametrize("url", ["memq://", "file:///tmp/x.lcmlog"])
def test_a_url_that_leads_to_no_other_process_is_refused_at_once(bench: Bench, url: str) -> None:
    bench.write({"a": {}})
    started = bench.deixis("start", LCM_DEFAULT_URL=url)
    assert started.returncode == 1
    assert "leads to no other process" in started.stderr
    assert bench.deixis("status").returncode == 3


def test_a_service_that_is_stopped_by_a_signal_is_silent_until_it_is_restarted(
        bench: Bench) -> None:
    bench.write({"a": {"stop_within_s": 0.3, "restart_when_silent_s": 0}})
    bench.deixis("start")
    os.kill(bench.service("a")["pid"], signal.SIGSTOP)
    assert becomes_true(lambda: bench.service("a")["state"] == "silent")
    assert bench.deixis("status").returncode == 1
    assert bench.deixis("restart", "a").returncode == 0
    assert bench.service("a")["state"] == "running"


def test_the_system_file_of_the_users_configuration_folder_is_taken(bench: Bench) -> None:
    bench.write({"a": {}})
    started = bench.deixis_bare("start", DEIXIS_CONFIG_DIR=str(bench.folder))
    assert started.returncode == 0, started.stderr
    assert bench.service("a")["state"] == "running"


def test_signal_to_the_supervisor_stops_all(bench: Bench) -> None:
    bench.write({"a": {}})
    bench.deixis("start")
    pid = bench.service("a")["pid"]
    os.kill(supervisor_pid(bench), signal.SIGTERM)
    assert becomes_true(lambda: not is_alive(pid) and bench.deixis("status").returncode == 3)


def test_output_is_kept_in_rotated_logs(bench: Bench) -> None:
    bench.write({"a": {"set": {"spam": 1000}}},
                log={"folder": str(bench.logs), "size_mb": 0.02, "count": 2})
    bench.deixis("start")
    assert becomes_true(lambda: (bench.logs / "a.log.2").exists())
    sizes = {path.name: path.stat().st_size for path in bench.logs.glob("a.log*")}
    assert set(sizes) == {"a.log", "a.log.1", "a.log.2"}
    assert all(size <= 20_000 for size in sizes.values())


def test_log_shows_the_last_lines_with_and_without_a_supervisor(bench: Bench) -> None:
    bench.write({"a": {"set": {"say": "hello"}}, "b": {}})
    bench.deixis("start")
    assert "a | hello" in bench.deixis("log").stdout
    bench.deixis("stop")
    assert "hello" in bench.deixis("log", "a", "-n", "5").stdout
    assert bench.deixis("log", "-n", "1", "a").stdout.count("\n") == 1


def test_what_a_service_says_steers_no_terminal(bench: Bench) -> None:
    bench.write({"a": {"set": {"say": "\x1b[2Jx\ty", "exit_after_s": 0, "exit_code": 4},
                       "restart": "never"}})
    for command in ("start", "status", "log"):
        result = bench.deixis(command)
        assert "\\x1b[2Jx" in result.stdout, result.stderr
        assert "\x1b" not in result.stdout + result.stderr


def test_log_follows_through_a_rotation(bench: Bench) -> None:
    bench.write({"a": {"set": {"spam": 300}}},
                log={"folder": str(bench.logs), "size_mb": 0.02, "count": 5})
    bench.deixis("start")
    shown = bench.folder / "shown"
    with shown.open("w", encoding="utf-8") as output:
        following = bench.begin("log", "-f", "-n", "0", output=output)
    assert becomes_true(lambda: has_read(following.pid, bench.logs / "a.log"))
    bench.deixis("restart", "a")
    assert (bench.logs / "a.log.2").exists()
    assert becomes_true(lambda: has_read(following.pid, bench.logs / "a.log"))
    following.send_signal(signal.SIGINT)
    following.wait(timeout=10)
    assert shown.read_text(encoding="utf-8").count("x" * 99) == 300


def test_without_multicast_start_names_the_cure(bench: Bench, without_multicast: list[str]) -> None:
    bench.write({"a": {}})
    started = bench.deixis_below(without_multicast, "start")
    assert started.returncode == 1
    assert "ip route add 224.0.0.0/4 dev lo" in started.stderr
    assert bench.deixis("status").returncode == 3


def test_wrong_name_lists_what_there_is(bench: Bench) -> None:
    bench.write({"a": {"groups": ["eyes"]}})
    refused = bench.deixis("start", "b")
    assert refused.returncode == 1
    assert "no service or group 'b'" in refused.stderr and "eyes, a" in refused.stderr
    assert bench.deixis("status").returncode == 3
