"""`deixis evaluate WHAT`: each part's evaluation is a module of its own, named in one table."""

from __future__ import annotations

from deixis_frontend.cli import Command

_PACKAGE = "deixis_frontend.evaluation"
SUBCOMMANDS: dict[str, Command] = {
    "body": Command(f"{_PACKAGE}.body", "what follows of a person's sizes from a few lengths"),
    "calibration": Command(f"{_PACKAGE}.calibration", "stereo calibration against OpenCV's sample"),
    "depth": Command(f"{_PACKAGE}.depth", "how much of people has a depth, and how exact it is"),
    "events": Command(f"{_PACKAGE}.events", "what is named when, on recordings of real people"),
    "hands": Command(f"{_PACKAGE}.hands", "the hand tracker's error, misses and false tracks"),
    "live": Command(f"{_PACKAGE}.live", "loss, age, CPU and memory of the chain at camera rate"),
    "motion": Command(f"{_PACKAGE}.motion", "what the limits of joints say of recorded motion"),
    "people": Command(f"{_PACKAGE}.people", "how well people and the floor are found in depth images"),
    "pointing": Command(f"{_PACKAGE}.pointing", "which pointing gestures are recognised, and when"),
    "pose": Command(f"{_PACKAGE}.pose", "how far fitted bodies are from true people"),
}
