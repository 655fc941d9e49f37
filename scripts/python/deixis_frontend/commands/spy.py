"""`deixis spy`: LCM's lcm-spy with our message types, pictures and stick figures."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.errors import UserError
from deixis_frontend.java_tools import find_java, lcm_jars, own_jars, virtual_machine_options

_KERNEL_BUFFER = Path("/proc/sys/net/core/rmem_default")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Nothing but words: everything else is done in the window."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.description = (
        "LCM's lcm-spy with the message types of Deixis: a window with all channels. It needs a"
        " display\nand a Java runtime that opens windows (scripts/setup --spy installs one).\n\n"
        "A double click on a channel opens\n"
        "  pictures: bot_core.image_t, bot_core.images_t (depth in colour), kinect.frame_msg_t\n"
        "  stick figures: deixis.body_poses_t, deixis.verified_poses_t, kinect.skeleton_msg_t\n"
        "  the fields of any other message; a right click offers them for pictures and figures, too"
    )
    parser.epilog = ("Environment: CLASSPATH holds jars with message types of your own;"
                     " LCM_JVM_OPT replaces the options\nof the Java runtime (-Xmx512m).")


def run(arguments: argparse.Namespace) -> int:
    """Becomes lcm-spy, whose exit code is 0 when its window is closed."""
    url = lcm_url.choose(arguments.lcm_url)
    layout = layouts.find()
    java = find_java(_cure_java(layout))
    ours = _path(own_jars(layout))
    class_path = _path([ours, *lcm_jars(), *_jars_of_user()])
    _require_display()
    command = [java, *virtual_machine_options(), f"-Ddeixis.spy.scanned={ours}", "-cp", class_path,
               "deixis.spy.Main"]
    lcm_url.require_bus(url)
    _warn_of_small_buffer()
    sys.stdout.flush()
    # Both lcm-spy and our windows open the bus that this variable names.
    os.execve(java, command, {**os.environ, "LCM_DEFAULT_URL": str(url)})


def _cure_java(layout: layouts.Layout) -> str:
    package = "install the package default-jre"
    return f"run scripts/setup --spy, or {package}" if layout.repository else package


def _path(entries: Sequence[str | Path]) -> str:
    return os.pathsep.join(map(str, entries))


def _jars_of_user() -> list[str]:
    return [entry for entry in os.environ.get("CLASSPATH", "").split(os.pathsep) if entry]


def _require_display() -> None:
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        raise UserError("no display to open a window on (DISPLAY is not set): run it in a desktop"
                        " session, or by `ssh -X`")


def _warn_of_small_buffer() -> None:
    """LCM for Java takes the kernel's default buffer, whatever the URL asks for."""
    try:
        size = int(_KERNEL_BUFFER.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return
    if size < lcm_url.RECEIVE_BUFFER_BYTES:
        print(f"deixis: messages above {size // 1024} kB (raw pictures) may not arrive here: `sudo"
              f" sysctl -w net.core.rmem_default={lcm_url.RECEIVE_BUFFER_BYTES}` lets them through",
              file=sys.stderr)
