"""Publishes one gesture again and again until COMMAND, started here, prints a line; prints that line.

    publish_to_example.py PORT TIMEOUT_S [COMMAND ...]

Without a command it listens itself: whether LCM gets through at all on this network. Exit code 0 = a line came.
"""
import os
import subprocess
import sys
import threading
import time

import lcm
from deixis import candidate_t, gesture_t

PORT, TIMEOUT_S, COMMAND = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
URL = f"udpm://239.255.76.67:{PORT}?ttl=0"


def candidate(object_id, label, probability):
    message = candidate_t()
    message.object_id, message.label, message.probability = object_id, label, probability
    return message


def pointing(end_utime=0, label="cup"):
    message = gesture_t()
    message.end_utime = end_utime
    message.name, message.outcome, message.object_id, message.object_label = "pointing", gesture_t.OBJECT, 3, label
    message.candidates = [candidate(3, "cup", 0.875), candidate(4, "jug", 0.0625)]
    message.n_candidates = len(message.candidates)
    return message.encode()


def gets_through():
    bus, received = lcm.LCM(URL), []
    bus.subscribe("GESTURES", lambda _, data: received.append(data))
    deadline = time.monotonic() + TIMEOUT_S
    while not received and time.monotonic() < deadline:
        bus.publish("GESTURES", pointing())
        bus.handle_timeout(50)
    return bool(received)


def first_line():
    environment = dict(os.environ, LCM_DEFAULT_URL=URL)
    with subprocess.Popen(COMMAND, stdout=subprocess.PIPE, text=True, env=environment) as example:
        lines = []
        reader = threading.Thread(target=lambda: lines.append(example.stdout.readline()), daemon=True)
        reader.start()
        bus, deadline = lcm.LCM(URL), time.monotonic() + TIMEOUT_S
        while reader.is_alive() and time.monotonic() < deadline and example.poll() is None:
            bus.publish("GESTURES", b"of another type")  # is to be passed over
            bus.publish("GESTURES", pointing(end_utime=1, label="over"))  # is not to be printed
            bus.publish("GESTURES", pointing())
            reader.join(0.05)
        example.kill()
        reader.join()
    return lines[0]


if not COMMAND:
    sys.exit(0 if gets_through() else 1)
LINE = first_line()
print(LINE, end="")
sys.exit(0 if LINE else 1)
