#!/usr/bin/env python3
"""Prints every recognised gesture: what it is, which object is meant, and how probable that is.

    PYTHONPATH=build/release/python .venv/bin/python scripts/python/examples/print_gestures.py [CHANNEL]

Listens where LCM_DEFAULT_URL says; the channel is GESTURES unless told otherwise.
"""
import struct
import sys

try:
    import lcm
    from deixis import gesture_t
except ModuleNotFoundError as error:
    sys.exit(f"{error}: run it as\n{__doc__.splitlines()[2]}")


def print_gesture(channel, data):
    try:
        gesture = gesture_t.decode(data)
    except (ValueError, struct.error) as error:
        print(f"a message on {channel} is no gesture_t: {error}", file=sys.stderr, flush=True)
        return
    if gesture.end_utime != 0:
        return  # told again because it has ended
    candidates = ", ".join(f"{c.label} (object {c.object_id}, {c.probability:.2f})" for c in gesture.candidates)
    outcome = {gesture_t.OBJECT: gesture.object_label, gesture_t.NO_OBJECT: "no known object",
               gesture_t.AMBIGUOUS: "one of several"}.get(gesture.outcome, "unknown outcome")
    print(f"{gesture.name}: {outcome}; candidates: {candidates or 'none'}", flush=True)


bus = lcm.LCM()
bus.subscribe(sys.argv[1] if len(sys.argv) > 1 else "GESTURES", print_gesture)
try:
    while True:
        bus.handle()
except KeyboardInterrupt:
    pass
