#!/usr/bin/env python3
"""Prints every recognised gesture: what it is, which object is meant, and how probable that is.

    PYTHONPATH=build/release/python .venv/bin/python scripts/python/examples/print_gestures.py [CHANNEL]

Listens where LCM_DEFAULT_URL says; the channel is GESTURES unless told otherwise.
"""
import sys

import lcm
from deixis import gesture_t


def print_gesture(_, data):
    gesture = gesture_t.decode(data)
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
