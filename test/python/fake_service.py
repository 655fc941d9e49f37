"""A service that does nothing but speak on SERVICE_STATUS, and misbehaves when it is told to.

Behaviour by --set: state=N, ready_after_s=S, exit_after_s=S, exit_code=N, ignore_stop=1, child=FILE
(has a child and writes its pid there), say=TEXT (to stderr), spam=N (lines of 100 bytes to stdout).
"""

from __future__ import annotations

import argparse
import os
import signal
import socket
import subprocess
import sys
import time

import lcm
from deixis import service_status_t


def main() -> None:
    """Runs until it is told to stop or to end."""
    arguments, settings = read_arguments()
    stop = signal.SIG_IGN if "ignore_stop" in settings else lambda *_: sys.exit(0)
    signal.signal(signal.SIGTERM, stop)
    prepare(settings)
    bus = lcm.LCM(arguments.lcm_url)
    began = time.monotonic()
    while not passed(began, settings, "exit_after_s"):
        if passed(began, {"ready_after_s": "0", **settings}, "ready_after_s"):
            bus.publish(arguments.channel_prefix + "SERVICE_STATUS",
                        status(arguments, settings).encode())
        time.sleep(0.05)
    sys.exit(int(settings.get("exit_code", "0")))


def read_arguments() -> tuple[argparse.Namespace, dict[str, str]]:
    """The options that every service has, and what --set says."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--version", action="version", version="deixis-fake 0.1.0")
    parser.add_argument("--lcm-url")
    parser.add_argument("--channel-prefix", default="")
    parser.add_argument("--instance", default="")
    parser.add_argument("--config")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    return arguments, dict(setting.split("=", 1) for setting in arguments.set)


def prepare(settings: dict[str, str]) -> None:
    """What is done once, before the first word on the bus."""
    if "say" in settings:
        print(settings["say"], file=sys.stderr, flush=True)
    for _ in range(int(settings.get("spam", "0"))):
        print("x" * 99, flush=True)
    if "child" in settings:
        child = subprocess.Popen(["sleep", "1000"])
        with open(settings["child"], "w", encoding="ascii") as file:
            file.write(str(child.pid))


def passed(began: float, settings: dict[str, str], key: str) -> bool:
    """True when the time that `key` gives is over."""
    return key in settings and time.monotonic() - began >= float(settings[key])


def status(arguments: argparse.Namespace, settings: dict[str, str]) -> service_status_t:
    """How it says it is doing."""
    message = service_status_t()
    message.service, message.instance = settings.get("service", "fake"), arguments.instance
    message.host, message.pid = socket.gethostname(), os.getpid()
    message.version, message.text = "0.1.0", settings.get("text", "")
    message.state = int(settings.get("state", service_status_t.RUNNING))
    message.processing_ms_p50, message.processing_ms_p99 = 1.5, 2.5
    message.age_ms_p50 = message.age_ms_p99 = -1.0
    return message


if __name__ == "__main__":
    main()
