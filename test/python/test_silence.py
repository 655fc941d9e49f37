"""Services that hang: killed and started again, unless their silence has another reason."""

from __future__ import annotations

import os
import signal
import socket
from types import SimpleNamespace
from typing import Any

import pytest
from bench import Bench, becomes_true, is_alive

from deixis_frontend import lcm_url
from deixis_frontend.supervision.receive_drops import kernel_drops
from deixis_frontend.supervision.silence_watch import SilenceWatch


class FakeService(SimpleNamespace):
    """A service that has been silent for some time."""

    __hash__ = object.__hash__  # type: ignore[assignment]

    def __init__(self, silent: float | None, limit: float = 10.0) -> None:
        super().__init__(entry=SimpleNamespace(restart_when_silent_s=limit), silent=silent)

    def silent_s(self) -> float | None:
        return self.silent

    def excuse_silence(self) -> None:
        self.silent = 0.0


def judge(services: list[Any], bus_fails: str | None = None, passed_s: float = 1.0,
          drops: int = 0) -> Any:
    times = iter([0.0, passed_s])
    return SilenceWatch(lambda: bus_fails, lambda: drops, lambda: next(times)).judge(services)


def test_the_one_that_is_silent_for_too_long_hangs() -> None:
    hung, well, unready = FakeService(11.0), FakeService(0.5), FakeService(None)
    assert judge([hung, well, unready]).hanging == (hung,)


@pytest.mark.parametrize(("silent", "limit"), [(9.0, 10.0), (500.0, 0.0)])
def test_silence_that_its_entry_allows_is_no_hanging(silent: float, limit: float) -> None:
    assert judge([FakeService(silent, limit), FakeService(0.5)]).hanging == ()


def test_when_all_are_silent_at_once_none_is_killed_and_it_is_said() -> None:
    judgement = judge([FakeService(11.0), FakeService(11.0)])
    assert judgement.hanging == ()
    assert "all 2 services are silent at once" in judgement.trouble


def test_the_only_one_hangs_when_the_bus_is_well() -> None:
    only = FakeService(11.0)
    assert judge([only]).hanging == (only,)


def test_the_only_one_is_not_blamed_for_a_bus_that_is_down() -> None:
    judgement = judge([FakeService(11.0)], bus_fails="no route")
    assert judgement.hanging == ()
    assert judgement.trouble == "no service is heard: no route"


def test_after_a_suspension_of_the_supervisor_silence_counts_anew() -> None:
    services = [FakeService(60.0), FakeService(0.5)]
    assert judge(services, passed_s=60.0).hanging == ()
    assert services[0].silent == 0.0


def test_silence_counts_anew_while_the_supervisor_loses_messages() -> None:
    services = [FakeService(60.0), FakeService(0.5)]
    judgement = judge(services, drops=3)
    assert judgement.hanging == ()
    assert "loses messages" in judgement.trouble
    assert services[0].silent == 0.0


def test_a_service_that_hangs_is_killed_and_comes_back(bench: Bench) -> None:
    bench.write({"a": {"restart_when_silent_s": 2}, "b": {}})
    bench.deixis("start")
    pid = bench.service("a")["pid"]
    os.kill(pid, signal.SIGSTOP)
    assert becomes_true(lambda: bench.service("a")["restarts"] == 1
                        and bench.service("a")["state"] == "running", 20.0), bench.log("a")
    assert not is_alive(pid)
    assert "hung: silent for" in bench.service("a")["last_error"]
    assert bench.service("b")["restarts"] == 0


def test_services_that_are_all_stopped_at_once_are_not_killed(bench: Bench) -> None:
    bench.write({name: {"restart_when_silent_s": 2} for name in "ab"})
    bench.deixis("start")
    pids = [service["pid"] for service in bench.status()["services"]]
    for pid in pids:
        os.kill(pid, signal.SIGSTOP)
    assert becomes_true(lambda: "silent at once" in bench.status()["trouble"], 20.0)
    assert "silent at once" in bench.deixis("status").stdout
    for pid in pids:
        os.kill(pid, signal.SIGCONT)
    assert becomes_true(lambda: [s["state"] for s in bench.status()["services"]]
                        == ["running"] * 2)
    assert [s["pid"] for s in bench.status()["services"]] == pids


def test_a_supervisor_that_was_stopped_kills_nothing(bench: Bench) -> None:
    bench.write({name: {"restart_when_silent_s": 2} for name in "ab"})
    bench.deixis("start")
    before = bench.status()
    os.kill(before["supervisor_pid"], signal.SIGSTOP)
    signal.sigtimedwait([], 5)  # The time that passes is what is tested.
    os.kill(before["supervisor_pid"], signal.SIGCONT)
    uptime_s = before["uptime_s"] + 8.0
    assert becomes_true(lambda: bench.status()["uptime_s"] > uptime_s, 20.0)
    assert [s["pid"] for s in bench.status()["services"]] == [
        s["pid"] for s in before["services"]]


@pytest.mark.parametrize("value", ["-1", "1.5", "4000"])
def test_a_silence_that_cannot_be_is_refused(bench: Bench, value: str) -> None:
    bench.write({"a": {"restart_when_silent_s": float(value)}})
    started = bench.deixis("start")
    assert started.returncode == 1
    assert "services.a.restart_when_silent_s" in started.stderr


def test_what_the_kernel_drops_is_counted_and_no_descriptor_is_kept() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver, \
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        receiver.bind(("", 0))
        port = receiver.getsockname()[1]
        url = lcm_url.parse(f"udpm://{lcm_url.GROUP}:{port}")
        before = os.listdir("/proc/self/fd")
        assert kernel_drops(url) == 0
        for _ in range(100):
            sender.sendto(bytes(1000), ("127.0.0.1", port))
        assert 50 < kernel_drops(url) < 100
        assert os.listdir("/proc/self/fd") == before
    assert kernel_drops(lcm_url.parse("tcpq://")) == 0
