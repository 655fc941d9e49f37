"""`deixis train-gestures`: motion models from sequences with labelled gestures."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.sequences import Sequence, read_sequences
from deixis_frontend.training.log_recordings import write_log_recording
from deixis_frontend.training.recordings import write_recordings


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data", type=Path, required=True, metavar="DIR_OR_LOG",
                        help="folder of sequence folders, or a log with HAND_TRACKS and OBJECTS")
    parser.add_argument("--labels", type=Path, metavar="CSV",
                        help="with a log: start_s,apex_s,end_s,retract_end_s,hand,object_id per line")
    parser.add_argument("--only", metavar="GLOB", help="names of sequences to use")
    parser.add_argument("--exclude-person", metavar="ID", help="leave this person's sequences out")
    parser.add_argument("--noise-px", type=float, default=2.5, metavar="PX",
                        help="noise added to true hand positions (default: 2.5)")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE",
                        help="model of the gesture, as config/gestures/approach.yaml;"
                             " rest.yaml is written beside it")


def run(arguments: argparse.Namespace) -> int:
    where = layout.find()
    program = where.program("deixis-train-gestures")
    with tempfile.TemporaryDirectory() as folder:
        recordings, models = Path(folder) / "recordings", Path(folder) / "models"
        _prepare(where, arguments, recordings)
        command = [str(program), "--recordings", str(recordings), "--output", str(models),
                   "--noise-px", str(arguments.noise_px)]
        if arguments.exclude_person:
            command += ["--exclude-person", arguments.exclude_person]
        environment = {"DEIXIS_CONFIG_DIR": str(where.config), **os.environ}
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        if done.returncode != 0:
            raise UserError((done.stderr.strip().splitlines() or ["training failed"])[-1])
        print(done.stdout, end="")
        arguments.output.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(models / "approach.yaml", arguments.output)
        shutil.copyfile(models / "rest.yaml", arguments.output.parent / "rest.yaml")
    print(f"written: {arguments.output} and {arguments.output.parent / 'rest.yaml'}")
    return 0


def _prepare(where: layout.Layout, arguments: argparse.Namespace, folder: Path) -> None:
    if arguments.data.is_file():
        if arguments.labels is None:
            raise UserError("a log needs its labels: give --labels CSV")
        write_log_recording(where, arguments.data, arguments.labels, folder)
        return
    sequences, skipped = read_sequences(
        arguments.data, arguments.only, ("joints.csv", "objects.csv", "gestures.csv"))
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    if not sequences:
        raise UserError(f"no labelled sequences in {arguments.data}")
    write_recordings(_training_layout(sequences), folder)


def _training_layout(sequences: list[Sequence]) -> list[Sequence]:
    """Objects that stand behind one another teach nothing about the image: those are left out."""
    apart = [s for s in sequences if not s.name.startswith("pointing_")]
    for sequence in sequences:
        if apart and sequence not in apart:
            print(f"not used: {sequence.name} (its objects stand behind one another)")
    return apart or sequences
