"""Plays a clip live through the services, each a process, on a bus of its own."""

from __future__ import annotations

import json
import os
import time
from typing import Any

from deixis_frontend.bus import open_bus
from deixis_frontend.commands.system_option import service_printer
from deixis_frontend.demo.bodies import Bodies
from deixis_frontend.demo.clip import Clip
from deixis_frontend.demo.commentary import Commentary
from deixis_frontend.demo.stage import Stage
from deixis_frontend.errors import UserError
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.supervision import system_file
from deixis_frontend.supervision.control_client import Client

_SILENCE_S = 10.0  # without a picture for so long, something is wrong
_LAST_WORDS_S = 1.0  # gestures may come so long after the last picture
_CHECK_EVERY_S = 0.5


def play(clip: Clip, stage: Stage, commentary: Commentary, bodies: Bodies, url: LcmUrl) -> None:
    """Starts the services, comments until the clip or the time is over, stops the services."""
    path = stage.folder / "system.yaml"
    path.write_text(json.dumps(_system(clip, stage), indent=2), encoding="utf-8")
    system = system_file.load(path)
    client = Client(system, stage.layout)
    bus = open_bus(url)
    print(f"on the bus {url}: print_gestures.py listens there with LCM_DEFAULT_URL='{url}'",
          flush=True)
    subscriptions = [bus.subscribe(clip.channel, lambda _, data: commentary.see_picture(data)),
                     bus.subscribe("BODY_POSES", lambda _, data: bodies.hear(data, now_us())),
                     bus.subscribe("GESTURES", lambda _, data: commentary.hear_gesture(data))]
    for subscription in subscriptions:
        subscription.set_queue_capacity(1000)
    client.ensure_supervisor(url, url_is_wanted=True, while_pid=os.getpid())
    try:
        if not client.command("start", [], service_printer(system))["ok"]:
            raise UserError(f"not all services are ready: see the logs in {stage.folder / 'logs'}")
        _watch(bus, client, commentary, clip)
    finally:
        client.command("stop", [])


def now_us() -> int:
    """Wall clock, microseconds."""
    return time.time_ns() // 1000


def _watch(bus: Any, client: Client, commentary: Commentary, clip: Clip) -> None:
    next_check = time.monotonic()
    silent_at = next_check + _SILENCE_S
    while not commentary.is_over:
        bus.handle_timeout(100)
        now = time.monotonic()
        if now >= silent_at:
            _require_pictures(commentary, clip)
        if now >= next_check:
            next_check = now + _CHECK_EVERY_S
            if _state(client, clip.driver) not in ("running", "degraded"):
                break
    _hear_last_words(bus)
    _require_pictures(commentary, clip)


def _hear_last_words(bus: Any) -> None:
    end = time.monotonic() + _LAST_WORDS_S
    while (left := end - time.monotonic()) > 0:
        bus.handle_timeout(int(1000 * left) + 1)


def _require_pictures(commentary: Commentary, clip: Clip) -> None:
    if not commentary.played_s:
        raise UserError(f"no picture has come: see logs/{clip.driver}.log beside the pictures")


def _state(client: Client, service: str) -> str:
    services = client.command("status", [])["status"]["services"]
    return next(s["state"] for s in services if s["name"] == service)


def _system(clip: Clip, stage: Stage) -> dict[str, Any]:
    settings = {**clip.watchers(), "viewer": stage.viewer_settings(clip)}
    watchers = {service: {"set": some} if some else {} for service, some in settings.items()}
    # The camera comes last, so that no picture is missed, and ends with the clip.
    camera = {"set": clip.driver_settings(), "after": list(watchers), "restart": "never"}
    return {
        "name": f"demo-{os.getpid()}",
        "log": {"folder": str(stage.folder / "logs")},
        "services": {**watchers, clip.driver: camera},
    }
