"""Stands in for the programs of the demonstration; the name that it is called by says for which.

The camera publishes 20 pictures, 50 ms apart; the recogniser sees a lamp pointed at in the fifth and
a phone in the tenth, the fitter somebody in each. DEIXIS_FAKE=blind: the recogniser sees nothing; broken: it does not
start; empty: the fitter sees nobody.
"""

from __future__ import annotations

import os
import struct
import sys
import time
from collections.abc import Iterator

import fake_service
import lcm
from deixis import body_pose_t, body_poses_t, candidate_t, gesture_t, limb_pose_t

PICTURES = 20
PERIOD_US = 50_000
PICTURES_OF = {"deixis-camera-driver": "CAMERA", "deixis-stereo-driver": "STEREO"}
SEEN = {5: "lamp", 10: "phone"}  # by number of the picture


def main(program: str) -> None:
    """Plays the part of `program`."""
    mode = os.environ.get("DEIXIS_FAKE", "")
    if program == "deixis-offline":
        work_through_log(*sys.argv[1:3], mode)
        return
    arguments, _ = fake_service.read_arguments()
    if arguments.lcm_url.startswith("file://"):
        if program in PICTURES_OF:
            write_log(arguments.lcm_url.removeprefix("file://").partition("?")[0], PICTURES_OF[program])
        return
    if program == "deixis-gesture-recogniser" and mode == "broken":
        sys.exit("gesture_recogniser.yaml:1: nonsense")
    serve(program.removeprefix("deixis-").replace("-", "_"), arguments, mode)


def serve(service: str, arguments: object, mode: str) -> None:
    """Speaks on SERVICE_STATUS and does what the service is there for, until it is stopped."""
    bus = lcm.LCM(arguments.lcm_url)
    if service == "gesture_recogniser":
        bus.subscribe("CAMERA|STEREO", lambda _, data: [bus.publish("GESTURES", message)
                                                        for message in seen_in(data, mode)])
    if service == "pose_fitter":
        bus.subscribe("STEREO", lambda _, data: bus.publish("BODY_POSES", fitted_to(data, mode)))
    channel = PICTURES_OF.get(f"deixis-{service.replace('_', '-')}")
    start = time.time_ns() // 1000
    for number in range(10**6):
        bus.publish("SERVICE_STATUS", fake_service.status(arguments, {"service": service}).encode())
        if channel:
            if number == PICTURES:
                return
            bus.publish(channel, picture(start + number * PERIOD_US, number))
        bus.handle_timeout(PERIOD_US // 1000)
        if channel:
            time.sleep(max(0.0, (start + (number + 1) * PERIOD_US) / 1e6 - time.time()))


def write_log(path: str, channel: str) -> None:
    """What a driver writes."""
    log = lcm.EventLog(path, "w", overwrite=True)
    for number in range(PICTURES):
        log.write_event(number * PERIOD_US, channel, picture(number * PERIOD_US, number))
    log.close()


def work_through_log(source: str, target: str, mode: str) -> None:
    """What deixis-offline does."""
    log = lcm.EventLog(target, "w", overwrite=True)
    for event in lcm.EventLog(source, "r"):
        log.write_event(event.timestamp, event.channel, event.data)
        for message in seen_in(event.data, mode):
            log.write_event(event.timestamp, "GESTURES", message)
        if event.channel == "STEREO":
            log.write_event(event.timestamp, "BODY_POSES", fitted_to(event.data, mode))
    log.close()


def picture(utime: int, number: int) -> bytes:
    """A fingerprint, the capture time, and what else is needed here."""
    return struct.pack(">qqq", 0, utime, number)


def seen_in(data: bytes, mode: str) -> Iterator[bytes]:
    """The gestures that are recognised in a picture."""
    _, utime, number = struct.unpack(">qqq", data)
    if number in SEEN and mode != "blind":
        yield gesture(utime, number).encode()
        yield gesture(utime + 1, number).encode()  # Its end: the same event once more.


def fitted_to(data: bytes, mode: str) -> bytes:
    """Somebody of two limbs, one of which is measured."""
    message = body_poses_t()
    _, message.utime, _ = struct.unpack(">qqq", data)
    message.floor_plane = [0.0] * 4
    if mode != "empty":
        body = body_pose_t()
        body.person_id, body.state, body.n_limbs = 4, body_pose_t.TRACKED, 2
        body.limbs = [limb_pose_t(), limb_pose_t()]
        body.limbs[0].state, body.limbs[1].state = limb_pose_t.MEASURED, limb_pose_t.HIDDEN
        message.n_bodies, message.bodies = 1, [body]
    return message.encode()


def gesture(utime: int, number: int) -> gesture_t:
    """Somebody points at a thing with the right hand."""
    message = gesture_t()
    message.utime, message.event_id, message.name, message.side = utime, number, "pointing", 2
    message.outcome, message.object_id, message.object_label = 0, number, SEEN[number]
    candidate = candidate_t()
    candidate.object_id, candidate.label, candidate.probability = number, SEEN[number], 0.875
    message.candidates, message.n_candidates = [candidate], 1
    return message


if __name__ == "__main__":
    main(os.environ["DEIXIS_FAKE_PROGRAM"])
