"""What the chain names when, on recordings of real people: a list of events beside what happened.

For every video in a folder the shipped programs run offline. Where the folder has an events.csv
(first_frame,last_frame,event,target), each recognised gesture is shown beside the event of its frame.
"""

from __future__ import annotations

import argparse
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from deixis_frontend import csv_table, layout
from deixis_frontend.csv_table import Row
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import report_options
from deixis_frontend.evaluation.offline_chain import results_of_video

VIDEOS = (".mp4", ".avi", ".mkv", ".mov")
_TRUTH_COLUMNS = ("first_frame", "last_frame", "event", "target")
SERVICES = ("object_detector", "hand_tracker", "gesture_recogniser")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which videos, what can be pointed at, and where the events go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR", help="folder of videos")
    parser.add_argument("--only", default="*", metavar="GLOB", help="names of videos to use")
    parser.add_argument("--places", type=Path, metavar="FILE",
                        help="things to point at (format of config/objects); default: none")
    report_options.add_json(parser, "events")


@dataclass(frozen=True)
class Event:
    """A recognised gesture, and what really happened at its frame where that is known."""

    time_s: float
    frame: int
    outcome: str
    label: str
    probability: float
    happened: str
    target: str


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is no video."""
    report_options.check(arguments)
    where = layout.find()
    if arguments.places and not arguments.places.is_file():
        raise UserError(f"--places {arguments.places}: no such file")
    videos = sorted(p for p in arguments.data.glob(arguments.only or "*") if p.suffix.lower() in VIDEOS)
    if not videos:
        raise UserError(f"no videos in {arguments.data} that match '{arguments.only}'")
    sequences = [_evaluate(where, video, arguments.places) for video in videos]
    for sequence in sequences:
        _print(sequence)
    summary = {"videos": len(sequences), "minutes": sum(s["seconds"] for s in sequences) / 60.0,
               "events": sum(len(s["events"]) for s in sequences)}
    print(f"{summary['events']} events in {summary['minutes']:.2f} minutes of {len(sequences)} videos")
    report_options.write_json(arguments, {"sequences": sequences, "summary": summary})
    return 0


def _evaluate(where: layout.Layout, video: Path, places: Path | None) -> dict[str, Any]:
    times, gestures = _recognise(where, video, places)
    truth = _truth(video.parent / "events.csv")
    return {"name": video.name, "frames": len(times), "seconds": _seconds(times),
            "events": [asdict(_event(g, times, truth)) for g in gestures]}


def _recognise(where: layout.Layout, video: Path,
               places: Path | None) -> tuple[list[int], list[Any]]:
    """Capture times of all pictures, microseconds, and all gestures."""
    settings = [f"object_detector.places.file={places.resolve()}"] if places else []
    times: list[int] = []
    gestures: dict[int, Any] = {}
    for channel, message in results_of_video(where, video, SERVICES,
                                             {"GESTURE_STATE", "GESTURES"}, settings):
        if channel == "GESTURES":
            gestures.setdefault(message.event_id, message)  # Told again when its end is known.
        else:
            times.append(message.utime)
    return times, list(gestures.values())


def _seconds(times: list[int]) -> float:
    return (times[-1] - times[0]) / 1e6 if times else 0.0


def _event(gesture: Any, times: list[int], truth: list[Row]) -> Event:
    frame = min(range(len(times)), key=lambda i: abs(times[i] - gesture.utime)) if times else 0
    happened = next((row.values for row in truth
                     if row.whole("first_frame") <= frame <= row.whole("last_frame")), {})
    outcome = {gesture.OBJECT: "object", gesture.NO_OBJECT: "no object",
               gesture.AMBIGUOUS: "ambiguous"}[gesture.outcome]
    best = gesture.candidates[0].probability if gesture.candidates else 0.0
    return Event((gesture.utime - times[0]) / 1e6 if times else 0.0, frame, outcome,
                 gesture.object_label, best, happened.get("event", ""), happened.get("target", ""))


def _truth(path: Path) -> list[Row]:
    return csv_table.read(path, _TRUTH_COLUMNS) if path.exists() else []


def _print(sequence: dict[str, Any]) -> None:
    print(f"{sequence['name']}: {sequence['frames']} pictures, {sequence['seconds']:.1f} s,"
          f" {len(sequence['events'])} events")
    for event in sequence["events"]:
        beside = f"   while: {event['happened']}" if event["happened"] else ""
        target = f" ({event['target']})" if event["target"] else ""
        print(f"  {event['time_s']:7.2f} s  frame {event['frame']:4d}  {event['outcome']:<10}"
              f"{event['label']:<12}{event['probability']:5.2f}{beside}{target}")
