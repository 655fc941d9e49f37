"""What the chain names when, on recordings of real people: a list of events beside what happened.

For every video in a folder the shipped programs run offline. Where the folder has an events.csv
(first_frame,last_frame,event,target), each recognised gesture is shown beside the event of its frame.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError

VIDEOS = (".mp4", ".avi", ".mkv", ".mov")
SERVICES = "object_detector,hand_tracker,gesture_recogniser"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data", type=Path, required=True, metavar="DIR", help="folder of videos")
    parser.add_argument("--only", default="*", metavar="GLOB", help="names of videos to use")
    parser.add_argument("--places", type=Path, metavar="FILE",
                        help="things to point at (format of config/objects); default: none")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the events as JSON")


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
    where = layout.find()
    where.use_types()
    videos = sorted(p for p in arguments.data.glob(arguments.only) if p.suffix.lower() in VIDEOS)
    if not videos:
        raise UserError(f"no videos in {arguments.data} that match '{arguments.only}'")
    sequences = [_evaluate(where, video, arguments.places) for video in videos]
    for sequence in sequences:
        _print(sequence)
    summary = {"videos": len(sequences), "minutes": sum(s["seconds"] for s in sequences) / 60.0,
               "events": sum(len(s["events"]) for s in sequences)}
    print(f"{summary['events']} events in {summary['minutes']:.2f} minutes of {len(sequences)} videos")
    if arguments.json:
        arguments.json.write_text(json.dumps({"sequences": sequences, "summary": summary}, indent=2))
    return 0


def _evaluate(where: layout.Layout, video: Path, places: Path | None) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        pictures, results = Path(folder) / "in.lcmlog", Path(folder) / "out.lcmlog"
        _call(where, "deixis-camera-driver", "--set", "source.kind=video",
              "--set", f"source.path={video.resolve()}", "--set", "pace=as_fast_as_possible",
              "--lcm-url", f"file://{pictures}?mode=w")
        _call(where, "deixis-offline", str(pictures), str(results), "--services", SERVICES,
              "--results-only", *_places(places))
        times, gestures = _read(results)
    truth = _truth(video.parent / "events.csv")
    return {"name": video.name, "frames": len(times), "seconds": _seconds(times),
            "events": [asdict(_event(g, times, truth)) for g in gestures]}


def _places(places: Path | None) -> list[str]:
    return ["--set", f"object_detector.places.file={places.resolve()}"] if places else []


def _call(where: layout.Layout, program: str, *arguments: str) -> None:
    done = subprocess.run([str(where.program(program)), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise UserError(f"{program} failed: {lines[-1] if lines else done.returncode}")


def _read(log: Path) -> tuple[list[int], list[Any]]:
    """Capture times of all pictures, microseconds, and all gestures."""
    from deixis_lcm import logs

    times: list[int] = []
    gestures: dict[int, Any] = {}
    for _, channel, message in logs.read(log, channels={"GESTURE_STATE", "GESTURES"}):
        if channel == "GESTURES":
            gestures.setdefault(message.event_id, message)  # Told again when its end is known.
        else:
            times.append(message.utime)
    return times, list(gestures.values())


def _seconds(times: list[int]) -> float:
    return (times[-1] - times[0]) / 1e6 if times else 0.0


def _event(gesture: Any, times: list[int], truth: list[dict[str, str]]) -> Event:
    frame = min(range(len(times)), key=lambda i: abs(times[i] - gesture.utime)) if times else 0
    happened = next((row for row in truth
                     if int(row["first_frame"]) <= frame <= int(row["last_frame"])), {})
    outcome = {gesture.OBJECT: "object", gesture.NO_OBJECT: "no object",
               gesture.AMBIGUOUS: "ambiguous"}[gesture.outcome]
    best = gesture.candidates[0].probability if gesture.candidates else 0.0
    return Event((gesture.utime - times[0]) / 1e6 if times else 0.0, frame, outcome,
                 gesture.object_label, best, happened.get("event", ""), happened.get("target", ""))


def _truth(path: Path) -> list[dict[str, str]]:
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def _print(sequence: dict[str, Any]) -> None:
    print(f"{sequence['name']}: {sequence['frames']} pictures, {sequence['seconds']:.1f} s,"
          f" {len(sequence['events'])} events")
    for event in sequence["events"]:
        beside = f"   while: {event['happened']}" if event["happened"] else ""
        target = f" ({event['target']})" if event["target"] else ""
        print(f"  {event['time_s']:7.2f} s  frame {event['frame']:4d}  {event['outcome']:<10}"
              f"{event['label']:<12}{event['probability']:5.2f}{beside}{target}")
