"""Plays a clip without a bus: its driver writes a log, one process works through it."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

from deixis_frontend.bus import import_lcm
from deixis_frontend.commands.run_offline import offline_command
from deixis_frontend.demo.bodies import Bodies
from deixis_frontend.demo.clip import Clip
from deixis_frontend.demo.commentary import Commentary
from deixis_frontend.demo.stage import Stage
from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.programs import last_words

# Times as fast as recorded. The viewer takes the newest picture: at full speed it skips most.
_VIEWER_SPEED = 4


def play(clip: Clip, stage: Stage, commentary: Commentary, bodies: Bodies) -> None:
    """Runs the same services as when live, then tells what came out, with the clip's times."""
    recorded, results = stage.folder / "clip.lcmlog", stage.folder / "results.lcmlog"
    for path in (recorded, results):
        path.unlink(missing_ok=True)
    camera = {**clip.driver_settings(), "pace": "as_fast_as_possible"}
    _run(_on_log(f"deixis-{clip.driver.replace('_', '-')}", f"{recorded}?mode=w", camera, stage.layout), stage)
    watchers = clip.watchers()
    settings = [f"{service}.{key}={value}" for service, some in watchers.items() for key, value in some.items()]
    _run(offline_command(stage.layout, recorded, results, settings, ",".join(watchers)), stage)
    _tell(results, clip.channel, commentary, bodies)
    _run(_on_log("deixis-viewer", f"{results}?mode=r&speed={_VIEWER_SPEED}",
                 stage.viewer_settings(clip), stage.layout), stage)


def _tell(results: Path, pictures: str, commentary: Commentary, bodies: Bodies) -> None:
    for channel, data in _events(results):
        if channel == pictures:
            commentary.see_picture(data)
        elif channel == "BODY_POSES":
            bodies.hear(data)
        elif channel == "GESTURES":
            commentary.hear_gesture(data)


def _on_log(program: str, log: str, settings: dict[str, str], layout: Layout) -> list[str]:
    """Command line of a service whose bus is a log file."""
    command = [str(layout.program(program)), "--lcm-url", f"file://{log}"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    return command


def _run(command: list[str], stage: Stage) -> None:
    log = stage.folder / "logs" / f"{Path(command[0]).name}.log"
    log.parent.mkdir(exist_ok=True)
    with log.open("wb") as file:
        code = subprocess.run(command, env=stage.layout.environment(), stdout=file, stderr=file,
                              check=False,
                              preexec_fn=end_with_parent(signal.SIGTERM)).returncode
    if code:
        said = last_words(log.read_text(encoding="utf-8", errors="replace"))
        raise UserError(f"{Path(command[0]).name} ended with exit code {code}:"
                        f" {said or f'see {log}'}")


def _events(log: Path) -> Iterator[tuple[str, bytes]]:
    events = import_lcm().EventLog(str(log), "r")
    for event in events:
        yield event.channel, event.data
    events.close()
