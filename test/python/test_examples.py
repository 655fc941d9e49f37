"""The examples print a gesture that is published to them over loopback.

Where this machine has no multicast route, everything runs in a network namespace of its own that has one.
"""
import os
import shutil
import socket
import subprocess
import sys
from pathlib import Path

import pytest

HELPER = Path(__file__).with_name("publish_to_example.py")
ROUTE = 'ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec "$@"'
NETWORKS = {
    "this machine's network": [],
    "a network namespace": ["unshare", "-n", "sh", "-c", ROUTE, "sh"],
    "a network namespace of an unprivileged user": ["unshare", "-Urn", "sh", "-c", ROUTE, "sh"],
}
EXPECTED = "pointing: cup; candidates: cup (object 3, 0.88), jug (object 4, 0.06)\n"
LCM_JARS = [Path("/usr/share/java/lcm.jar"), Path("/usr/local/share/java/lcm.jar")]


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def run(network, build, timeout_s, *command):
    environment = dict(os.environ, PYTHONPATH=str(build / "python"))
    return subprocess.run([*network, sys.executable, str(HELPER), str(free_port()), str(timeout_s),
                           *map(str, command)], capture_output=True, text=True, env=environment, check=False,
                          timeout=timeout_s + 30)


@pytest.fixture(scope="module")
def network(build):
    """The first network on which LCM gets through; no such network is a failure, not a reason to skip."""
    report = []
    for name, prefix in NETWORKS.items():
        if prefix and shutil.which(prefix[0]) is None:
            report.append(f"{name}: no {prefix[0]}")
            continue
        result = run(prefix, build, 2)
        if result.returncode == 0:
            return prefix
        report.append(f"{name}: {result.stderr.strip()}")
    return pytest.fail("LCM multicast gets through nowhere:\n" + "\n".join(report))


def test_python_example_prints_the_gesture(network, build, repository):
    result = run(network, build, 20, sys.executable, repository / "scripts/python/examples/print_gestures.py")
    assert result.stdout == EXPECTED, result.stderr


def test_python_example_passes_over_messages_of_another_type(network, build, repository):
    result = run(network, build, 20, sys.executable, repository / "scripts/python/examples/print_gestures.py")
    assert "a message on GESTURES is no gesture_t" in result.stderr


def test_python_example_without_the_types_says_how_to_run_it(repository, tmp_path):
    result = subprocess.run([sys.executable, repository / "scripts/python/examples/print_gestures.py"], check=False,
                            capture_output=True, text=True, env={**os.environ, "PYTHONPATH": ""}, cwd=tmp_path)
    assert result.returncode == 1
    assert "PYTHONPATH=build/release/python" in result.stderr and "Traceback" not in result.stderr


def test_java_example_prints_the_gesture(network, build, repository):
    types = build / "java" / "deixis_types.jar"
    if not types.exists():
        pytest.skip("this build has no Java types: it found no JDK or no lcm.jar")
    lcm_jar = next(jar for jar in LCM_JARS if jar.exists())
    result = run(network, build, 60, "java", "-Djava.net.preferIPv4Stack=true", "-cp", f"{lcm_jar}:{types}",
                 repository / "scripts/java/examples/PrintGestures.java")
    assert result.stdout == EXPECTED, result.stderr
