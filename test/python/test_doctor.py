"""`deixis doctor`: every check finds the fault that it is for, and names the cure."""

from __future__ import annotations

import importlib.metadata
import json
import os
import shutil
import socket
import subprocess
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from bench import Bench
from deixis import hand_tracks_t, objects_t
from front_end import deixis, speaking, status

from deixis_frontend import layout, lcm_url
from deixis_frontend.commands import doctor as doctor_command
from deixis_frontend.doctor import firewall, fixing, installation, machine, network, services
from deixis_frontend.doctor.command_lines import CommandLines
from deixis_frontend.doctor.findings import OK, PROBLEM, WARNING, Finding, examine
from deixis_frontend.doctor.wanted_cameras import wanted_cameras
from deixis_frontend.errors import UserError
from deixis_frontend.listening.source import Arrival
from deixis_frontend.listening.traffic import Traffic
from deixis_frontend.supervision import system_file

URL = lcm_url.parse("udpm://239.255.76.67:7667?ttl=0")
LAUNCHER = layout.find().launcher
COMMANDS = CommandLines(LAUNCHER, URL, None)


def doctor(bench: Bench, *arguments: str) -> tuple[int, dict[str, Any]]:
    result = bench.deixis("doctor", "--json", "--seconds", "1", *arguments)
    assert "Traceback" not in result.stderr
    return result.returncode, json.loads(result.stdout)


def levels(report: dict[str, Any], check: str) -> list[str]:
    return [finding["level"] for finding in report["findings"] if finding["check"] == check]


def test_a_system_in_order_has_no_problem(bench: Bench) -> None:
    bench.write({"one": {}})
    code, report = doctor(bench)
    found = [finding for finding in report["findings"] if finding["level"] == PROBLEM]
    # What this machine lacks is not the test's business.
    assert all(finding["check"] in ("camera", "disk", "clock") for finding in found), found
    assert code == (1 if found else 0) and report["problems"] == len(found)
    for check in ("multicast_route", "reach", "programs", "system", "publishers", "types", "loss"):
        assert levels(report, check) == [OK], check


def test_every_finding_is_a_line(bench: Bench) -> None:
    bench.write({"one": {}})
    *findings, total = bench.deixis("doctor", "--seconds", "0.2").stdout.splitlines()
    assert all(line.split()[0] in (OK, WARNING, PROBLEM) for line in findings)
    levels = [line.split()[0] for line in findings]
    counts = [(word, levels.count(word)) for word in (WARNING, PROBLEM)]
    assert total == f"{levels.count(OK)} ok, " + ", ".join(
        f"{count} {word}" + "s" * (count != 1) for word, count in counts)


@pytest.mark.parametrize(("problems", "words"), [(0, "0 problems"), (1, "1 problem"),
                                                 (2, "2 problems")])
def test_one_problem_is_no_plural(capsys: pytest.CaptureFixture[str], problems: int,
                                  words: str) -> None:
    report = doctor_command._Report(is_quiet=False)
    for _ in range(problems):
        report.add(Finding(PROBLEM, "x", "is wrong"))
    report.conclude(lcm_url.parse("udpm://"))
    assert capsys.readouterr().out.endswith(f"0 ok, 0 warnings, {words}\n")


def test_a_system_on_another_bus_is_pointed_at(bench: Bench) -> None:
    bench.write({"one": {}})
    assert bench.deixis("start", "one").returncode == 0
    other = str(lcm_url.with_free_port())
    _, report = doctor(bench, "-l", other)
    [finding] = [finding for finding in report["findings"] if finding["check"] == "system"]
    assert finding["level"] == WARNING and finding["cure"] == f"{LAUNCHER} doctor -l '{bench.url}'"


def test_missing_and_other_programs_are_problems(bench: Bench) -> None:
    old = bench.folder / "bin" / "deixis-old"
    old.write_text("#!/bin/sh\necho deixis-old 0.0.9\n", encoding="ascii")
    old.chmod(0o755)
    bench.write({"one": {"program": "deixis-none"}, "two": {"program": "deixis-old"}})
    code, report = doctor(bench)
    texts = [f["text"] for f in report["findings"] if f["check"] == "programs"]
    assert code == 1 and levels(report, "programs") == [PROBLEM] * 2
    assert "deixis-none not found" in texts[0] and "0.0.9" in texts[1]


def test_a_wrong_system_file_is_a_problem_among_others(bench: Bench) -> None:
    bench.system_file.write_text("nope: 1\n", encoding="ascii")
    code, report = doctor(bench)
    assert code == 1 and PROBLEM in levels(report, "system")
    assert levels(report, "publishers") == [OK]


def test_cures_run_as_they_are_printed(bench: Bench) -> None:
    bench.write({"one": {}})
    with speaking(bench.url, lambda n: ("TWO", hand_tracks_t().encode()),
                  lambda n: ("TWO", objects_t().encode())):
        _, report = doctor(bench)
        [finding] = [finding for finding in report["findings"] if finding["check"] == "types"]
        shown = subprocess.run(["sh", "-c", finding["cure"]], capture_output=True, text=True,
                               check=False, timeout=30, cwd="/")
    assert shown.returncode == 0 and "# TWO " in shown.stdout, shown


def test_two_publishers_and_two_types_on_a_channel_are_problems(bench: Bench) -> None:
    bench.write({"one": {}})
    with speaking(bench.url, lambda n: ("TWO", hand_tracks_t().encode()),
                  lambda n: ("TWO", objects_t().encode()), lambda n: ("BAD", b"short")):
        code, report = doctor(bench)
    assert code == 1
    assert levels(report, "publishers") == [PROBLEM]
    assert levels(report, "types") == [PROBLEM, PROBLEM]


def test_without_multicast_the_route_is_named(without_multicast: list[str]) -> None:
    result = deixis(str(URL), "doctor", "--json", prefix=tuple(without_multicast))
    report = json.loads(result.stdout)
    [finding] = [f for f in report["findings"] if f["check"] == "multicast_route"]
    assert result.returncode == 1 and finding["level"] == PROBLEM and finding["can_be_fixed"]
    assert finding["cure"] == "sudo ip route add 224.0.0.0/4 dev lo"
    assert not levels(report, "publishers")  # Nothing can be listened to.


@pytest.fixture
def alone(without_multicast: list[str]) -> tuple[str, ...]:
    """The beginning of a command line that runs as root of a network without multicast."""
    own_root = [] if os.getuid() == 0 else ["--map-root-user"]
    return ("unshare", "--net", *own_root)


@pytest.mark.parametrize(("options", "answers", "is_fixed"), [
    ((), "", False), (("--fix",), "", False), (("--fix",), "n\nn\n", False),
    (("--fix",), "y\ny\n", True), (("--fix", "--yes"), "", True)])
def test_cures_are_run_only_when_they_are_wanted(alone: tuple[str, ...], options: tuple[str, ...],
                                                 answers: str, is_fixed: bool) -> None:
    result = deixis(str(URL), "doctor", "--json", "--seconds", 0.2, *options, prefix=alone,
                    stdin=answers)
    assert levels(json.loads(result.stdout), "multicast_route") == [OK if is_fixed else PROBLEM]
    assert ("+ ip route add 224.0.0.0/4 dev lo" in result.stderr) == is_fixed
    assert ("[y/N]" in result.stderr) == (options == ("--fix",))


def test_a_cure_that_fails_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    findings = [Finding(PROBLEM, "x", "text", fixes=(("false",), ("/no/such/program",)))]
    assert not fixing.fix(findings, is_agreed=True)
    said = capfd.readouterr().err
    assert said.count("run it by hand as root") == 2


def test_a_small_receive_buffer_is_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(network, "granted_buffer", lambda asked: 212_992)
    [finding] = network.receive_buffer(URL)
    assert finding.level == WARNING and "212992 of 4194304" in finding.text
    assert finding.fixes == (("sysctl", "-w", "net.core.rmem_max=4194304"),)
    monkeypatch.setattr(network, "granted_buffer", lambda asked: asked)
    assert network.receive_buffer(URL)[0].level == OK
    asking = lcm_url.parse("udpm://239.255.76.67:7667?ttl=1&recv_buf_size=1000")
    [small] = network.receive_buffer(asking)
    assert small.level == WARNING
    assert small.cure == "export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1'"


def test_the_buffer_is_what_the_kernel_grants() -> None:
    assert network.granted_buffer(50_000) == 50_000


def test_a_url_that_lets_messages_out_is_a_warning() -> None:
    [finding] = network.reach(lcm_url.parse("udpm://239.255.76.67:7700?ttl=2"))
    assert finding.level == WARNING and "ttl=2" in finding.text
    assert finding.cure == "export LCM_DEFAULT_URL='udpm://239.255.76.67:7700?ttl=0'"
    assert network.reach(URL)[0].level == OK


def nft(rule: str, hook: str = "input", table: str = "inet", before: str = "") -> str:
    """What nft lists of a table with one chain."""
    return (f"table {table} filter {{\n\tset others {{\n\t\ttype ipv4_addr\n\t}}\n\n"
            f"\tchain guard {{\n\t\ttype filter hook {hook} priority filter; policy accept;\n"
            f"\t\t{before}\n\t\t{rule}\n\t}}\n}}\n")


POLICY = "table ip filter {{\n chain x {{\n type filter hook {} priority 0; policy drop;\n }}\n}}"


@pytest.mark.parametrize(("rules", "is_closed"), [
    (nft('udp dport 7667 iifname != "lo" drop'), True), (nft("udp dport { 22, 7667 } reject"), True),
    (nft("udp dport 7000-8000 counter packets 3 bytes 40 drop"), True),
    (nft("meta l4proto { tcp, udp } th dport 7667 drop"), True),
    (nft("counter packets 0 bytes 0 drop"), True),
    (nft("udp dport 7667 drop", before="ct state established,related accept"), True),
    ("-A INPUT ! -i lo -p udp -m udp --dport 7667 -j DROP", True), ("-A INPUT -j DROP", True),
    ("-A INPUT -p udp -m multiport --dports 7660:7670 -j REJECT", True),
    (nft("udp dport 7668 drop"), False), (nft("udp dport 17667 drop"), False),
    (nft("udp dport 7667 accept"), False), ("", False), ("-P INPUT ACCEPT", False),
    (POLICY.format("input"), True), ("-P INPUT DROP", True), (POLICY.format("output"), False),
    ("-P INPUT DROP\n-A INPUT -p udp --dport 7667 -j ACCEPT", False),
    ("-P INPUT DROP\n-A INPUT -i eth0 -j ACCEPT", False),
    ("-P INPUT DROP\n-A INPUT -i lo -j ACCEPT\n-A INPUT -p tcp --dport 22 -j ACCEPT", True),
    # Those that refuse something else, or some only.
    (nft("tcp dport 7000-8000 drop"), False), ("-A INPUT -p tcp --dport 7667 -j DROP", False),
    (nft("udp dport 7667 drop", hook="output"), False),
    (nft("udp dport 7667 drop", table="ip6"), False),
    (nft('udp dport 7667 iifname "lo" drop'), False),
    ("-A INPUT -s 10.0.0.5/32 -p udp -m udp --dport 7667 -j DROP", False),
    ("-A FORWARD -p udp -m udp --dport 7667 -j DROP", False),
    (nft("udp dport 7667 limit rate over 5/second drop"), False),
    (nft("udp dport != 7667 drop"), False), (nft("udp sport 7667 drop"), False),
    (nft("udp dport 7667 drop", before='iifname "eth0" accept'), False),
    (nft("udp dport 7667 drop", before="jump others"), False)])
def test_rules_that_close_the_port_are_found(rules: str, is_closed: bool) -> None:
    assert bool(firewall.closing_rule(rules, 7667)) == is_closed


def fence(monkeypatch: pytest.MonkeyPatch, interfaces: list[str], user: int, rules: str) -> Finding:
    monkeypatch.setattr(network, "_interfaces_to_others", lambda: interfaces)
    monkeypatch.setattr(network, "_rules", lambda: rules)
    monkeypatch.setattr(os, "geteuid", lambda: user)
    [finding] = network.fence(URL, COMMANDS)
    return finding


def test_the_fence_is_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    assert fence(monkeypatch, [], 0, "").level == OK
    assert fence(monkeypatch, ["eth0"], 0, nft("udp dport 7667 drop")).level == OK
    open_port = fence(monkeypatch, ["eth0"], 0, "")
    assert open_port.level == WARNING and "udp dport 7667" in open_port.cure
    asked_of_root = fence(monkeypatch, ["eth0"], 1000, nft("udp dport 7667 drop"))
    assert asked_of_root.level == WARNING and asked_of_root.cure == f"sudo {LAUNCHER} doctor -l '{URL}'"


def test_interfaces_that_are_up_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        lo = network._flags(asked, "lo")
        assert lo & network._IFF_LOOPBACK and network._flags(asked, "none-such") == 0
    flags = {"lo": lo | network._IFF_UP, "eth0": network._IFF_UP, "eth1": 0}
    monkeypatch.setattr(socket, "if_nameindex", lambda: list(enumerate(flags)))
    monkeypatch.setattr(network, "_flags", lambda _, name: flags[name])
    assert network._interfaces_to_others() == ["eth0"]


def test_cameras_that_are_there_missing_and_in_use(tmp_path: Path) -> None:
    wanted = {str(tmp_path / "video0"): Path("my.yaml")}
    assert [f.level for f in machine.cameras({}, tmp_path)] == [OK]
    [missing] = machine.cameras(wanted, tmp_path)
    assert missing.level == PROBLEM and "video0" in missing.text and "my.yaml" in missing.text
    (tmp_path / "video0").touch()
    assert [f.level for f in machine.cameras(wanted, tmp_path)] == [OK]
    with (tmp_path / "video0").open("rb"):
        [used] = machine.cameras({}, tmp_path)
    assert used.level == WARNING and f"pid {os.getpid()}" in used.text


@pytest.mark.parametrize("program", ["camera-driver", "stereo-driver", "calibrator"])
def test_a_camera_that_our_own_programs_use_is_in_order(program: str, tmp_path: Path,
                                                        monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "video0").touch()
    monkeypatch.setattr(machine, "command_name", lambda pid: f"deixis-{program} pid {pid}")
    with (tmp_path / "video0").open("rb"):
        [used] = machine.cameras({}, tmp_path)
    assert used.level == OK and f"in use by deixis-{program}" in used.text


def test_a_camera_of_others_is_a_problem(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "video0").touch()
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may open everything
    [finding] = machine.cameras({}, tmp_path)
    assert finding.level == PROBLEM and "usermod -aG video" in finding.cure


@pytest.mark.parametrize(("free", "level"), [(10**7, PROBLEM), (5 * 10**8, WARNING), (10**11, OK)])
def test_little_room_on_the_disk_is_told(free: int, level: str, tmp_path: Path,
                                         monkeypatch: pytest.MonkeyPatch) -> None:
    usage = type("Usage", (), {"free": free})
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage)
    [finding] = machine.disk(tmp_path / "not" / "yet")
    assert finding.level == level and bool(finding.cure) == (level != OK)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_cannot_be_written_is_a_problem() -> None:
    [finding] = machine.disk(Path("/proc/logs"))
    assert finding.level == PROBLEM and finding.cure == "sudo install -d -o $USER /proc/logs"


def test_a_clock_that_jumps_is_a_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    watch = machine.ClockWatch()
    assert "jumped" not in watch.findings()[0].text
    real = time.clock_gettime
    monkeypatch.setattr(time, "clock_gettime",
                        lambda clock: real(clock) + 2.0 * (clock == time.CLOCK_REALTIME))
    [finding] = watch.findings()
    assert finding.level == PROBLEM and "jumped by 2.0" in finding.text


@pytest.mark.parametrize(("is_synchronised", "level"), [(True, OK), (False, WARNING)])
def test_a_clock_of_its_own_is_a_warning(is_synchronised: bool, level: str,
                                         monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(machine, "is_synchronised", lambda: is_synchronised)
    assert machine.ClockWatch().findings()[0].level == level


def test_modules_are_compared_with_those_that_are_tested(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(installation, "_requirements", lambda: {"lcm": "0.0.1"})
    [other] = installation.python(layout.find())
    assert other.level == WARNING and "tested is 0.0.1" in other.text


@pytest.mark.parametrize(("lacks", "is_installed", "level", "words"), [
    ("numpy", False, PROBLEM, "the module numpy, for the front end, is missing"),
    ("mcap", False, WARNING, "the module mcap, for `deixis export`, is missing"),
    ("mcap", True, WARNING, "the module mcap, for `deixis export`, is missing"),
    ("pytest", False, WARNING, "the module pytest, for tests and figures, is missing"),
    ("pytest", True, OK, "lists for: `deixis export`, the front end")])
def test_who_needs_a_module_that_is_missing_is_told(lacks: str, is_installed: bool, level: str,
                                                    words: str,
                                                    monkeypatch: pytest.MonkeyPatch) -> None:
    requirements = installation._requirements()

    def version(name: str) -> str:
        if name == lacks:
            raise importlib.metadata.PackageNotFoundError
        return requirements[name]

    monkeypatch.setattr(importlib.metadata, "version", version)
    where = layout.find()
    [finding] = installation.python(replace(where, repository=None) if is_installed else where)
    assert finding.level == level and words in finding.text
    assert (level == OK) or finding.cure.endswith(f"{lacks}=={requirements[lacks]}" if is_installed
                                                  else "scripts/setup")


def test_a_missing_recorder_is_a_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    assert examine("recorder", installation.recorder)[0].level == OK
    monkeypatch.setattr(shutil, "which", lambda *_, **__: None)
    [finding] = examine("recorder", installation.recorder)
    assert finding.level == PROBLEM and "scripts/setup" in finding.text


def heard(*statuses: Any) -> Traffic:
    traffic = Traffic(layout.find())
    for message in statuses:
        traffic.take(Arrival(1, "SERVICE_STATUS", message.encode()))
    return traffic


def test_what_the_kernel_dropped_is_loss_and_no_fault_of_types() -> None:
    before, after = status("tracker", ("*",), wrong=2), status("tracker", ("*",), wrong=9)
    for message in before, after:
        message.channels[0].drops[0].reason = "kernel_buffer_full"
    traffic = heard(before, after)
    assert [finding.level for finding in services.types(traffic, COMMANDS)] == [OK]
    [finding] = services.loss(traffic, 0, COMMANDS)
    assert finding.level == WARNING and "dropped 7 datagrams to tracker" in finding.text
    assert "rmem_max" in finding.cure


@pytest.mark.parametrize(("before", "after", "level"), [(3, 3, WARNING), (3, 4, PROBLEM)])
def test_messages_that_a_service_refuses_are_told(before: int, after: int, level: str) -> None:
    traffic = heard(status("tracker", ("CAMERA",), wrong=before),
                    status("tracker", ("CAMERA",), wrong=after))
    [finding] = services.types(traffic, COMMANDS)
    assert finding.level == level and f"tracker has refused {after} messages" in finding.text
    assert finding.cure == f"{LAUNCHER} echo CAMERA --count 5 -l '{URL}'"


def test_messages_that_a_service_misses_are_told() -> None:
    first, last = status("tracker", ("CAMERA",)), status("tracker", ("CAMERA",))
    first.channels[0].gaps, last.channels[0].gaps = 5, 8
    [finding] = services.loss(heard(first, last), 0, COMMANDS)
    assert finding.level == WARNING and "(3 while we listened)" in finding.text
    assert services.loss(heard(last, last), 0, COMMANDS)[0].level == OK


def test_a_service_from_before_the_buffer_was_raised_is_told() -> None:
    traffic = heard(status("tracker", receive_buffer_bytes=212_992))
    [finding] = services.loss(traffic, 4_194_304, CommandLines(LAUNCHER, URL, Path("my system.yaml")))
    assert finding.cure == f"{LAUNCHER} restart tracker --system 'my system.yaml'"


def test_a_service_of_another_version_is_a_problem() -> None:
    [finding] = services.versions(heard(status("tracker", version="0.0.9")), COMMANDS)
    assert finding.level == PROBLEM and "0.0.9" in finding.text
    assert not services.versions(heard(status("tracker")), COMMANDS)


@pytest.mark.parametrize("name", ["a\nok       programs: all is well", "\x1b[2J", "--system=x"])
def test_names_from_the_bus_forge_no_line_and_no_cure(name: str) -> None:
    traffic = heard(status(name, version="0.0.9", receive_buffer_bytes=1))
    for finding in (*services.versions(traffic, COMMANDS), *services.loss(traffic, 9, COMMANDS)):
        assert not finding.cure and finding.line().isprintable()


def test_a_finding_is_a_line_whatever_is_in_it() -> None:
    assert Finding(OK, "x", "a\nb", "\x1b[2J").line() == r"ok       x: a\nb; cure: `\x1b[2J`"


@pytest.mark.parametrize(("driver", "settings", "devices"), [
    ("camera", {}, ["/dev/video0"]), ("camera", {"source.path": "3"}, ["/dev/video3"]),
    ("camera", {"source.path": "/dev/front"}, ["/dev/front"]), ("camera", {"source.kind": "video"}, []),
    ("stereo", {}, ["/dev/video0", "/dev/video2"]),
    ("stereo", {"source.kind": "side_by_side"}, ["/dev/video0"]),
    ("stereo", {"source.left.kind": "video", "source.right.path": "7"}, ["/dev/video7"]),
    ("stereo", {"source.kind": "kinect_channel"}, [])])
def test_cameras_that_are_asked_for_are_read_from_the_configuration(
        bench: Bench, driver: str, settings: dict[str, str], devices: list[str],
        repository: Path) -> None:
    file = repository / "config" / f"{driver}_driver.yaml"
    bench.write({"eye": {"program": f"deixis-{driver}-driver", "set": settings,
                         "config": str(file)}}, start=["eye"])
    system = system_file.load(bench.system_file)
    assert wanted_cameras(system, layout.find()) == dict.fromkeys(devices, file)


def test_a_configuration_that_is_nested_too_deeply_is_the_drivers_business(bench: Bench) -> None:
    file = bench.folder / "deep.yaml"
    file.write_text("source: " + "[" * 5000, encoding="ascii")
    bench.write({"eye": {"program": "deixis-camera-driver", "config": str(file)}}, start=["eye"])
    assert set(wanted_cameras(system_file.load(bench.system_file), layout.find())) == {"/dev/video0"}


def test_a_check_that_cannot_look_is_a_problem() -> None:
    def refuse() -> list[Finding]:
        raise UserError("one\ntwo")

    def lack() -> list[Finding]:
        raise ModuleNotFoundError("no lcm", name="lcm")

    assert [f.text for f in examine("x", refuse)] == ["one", "two"]
    assert "lacks the module 'lcm'" in examine("x", lack)[0].text
