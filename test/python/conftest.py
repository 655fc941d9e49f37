"""What the Python tests share: message types, a bus that works anywhere, a bench of services."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from bench import Bench

from deixis_frontend import lcm_url

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = REPOSITORY / (os.environ.get("DEIXIS_BUILD_DIR") or "build/release")
sys.path[:0] = [str(BUILD / "python"), str(REPOSITORY / "scripts" / "python")]
_CLONE_NEWUSER = 0x10000000
_CLONE_NEWNET = 0x40000000


def pytest_configure() -> None:
    """Where the machine has no multicast, the whole run moves to a network of its own that has."""
    if not (BUILD / "python" / "deixis").is_dir():
        raise pytest.UsageError(f"no message types in {BUILD / 'python'}: run scripts/build")
    if lcm_url.why_multicast_fails():
        _enter_private_network()


def _enter_private_network() -> None:
    user, group = os.getuid(), os.getgid()
    flags = _CLONE_NEWNET if user == 0 else _CLONE_NEWNET | _CLONE_NEWUSER
    if ctypes.CDLL(None, use_errno=True).unshare(flags):
        return  # Not allowed here: the tests that need the bus say so.
    if user:
        Path("/proc/self/setgroups").write_text("deny", encoding="ascii")
        Path("/proc/self/uid_map").write_text(f"0 {user} 1", encoding="ascii")
        Path("/proc/self/gid_map").write_text(f"0 {group} 1", encoding="ascii")
    for command in ("ip link set lo up", "ip route add 224.0.0.0/4 dev lo"):
        subprocess.run(command.split(), check=False)


@pytest.fixture(scope="session")
def repository() -> Path:
    """The top folder of the project."""
    return REPOSITORY


@pytest.fixture(scope="session")
def build() -> Path:
    """The build folder that the tests run against."""
    return BUILD


@pytest.fixture
def url() -> str:
    """The URL of a bus on this host that no one else uses."""
    reason = lcm_url.why_multicast_fails()
    if reason:
        pytest.fail(f"{reason}, and no private network can be had: {lcm_url.CURE_ROUTE}")
    return str(lcm_url.with_free_port())


@pytest.fixture
def bench(url: str) -> Iterator[Bench]:
    """A system of fake services; all of them have ended when the test has."""
    with tempfile.TemporaryDirectory(prefix="deixis-") as folder:  # Short: sockets are in it.
        bench = Bench(Path(folder), BUILD / "python", url)
        yield bench
        bench.end()


@pytest.fixture
def without_multicast() -> Iterator[list[str]]:
    """The beginning of a command line that runs the rest on a network without multicast."""
    prefix = ["unshare", "--net"] if os.getuid() == 0 else ["unshare", "--user", "--net"]
    if subprocess.run([*prefix, "true"], check=False, capture_output=True).returncode:
        pytest.skip("this machine allows no network of one's own")
    yield prefix
