"""`deixis train-gestures`: motion models from sequences with labelled gestures."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.sequences import Sequence, read_sequences
from deixis_frontend.number_options import not_negative
from deixis_frontend.programs import run_program
from deixis_frontend.training.labels import COLUMNS
from deixis_frontend.training.log_recordings import write_log_recording
from deixis_frontend.training.recordings import as_word, write_recordings

_REST = "rest.yaml"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to learn from, and where the models go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR_OR_LOG",
                        help="folder of sequence folders, or a log with HAND_TRACKS and OBJECTS")
    parser.add_argument("--labels", type=Path, metavar="CSV",
                        help=f"with a log: {','.join(COLUMNS)} per line")
    parser.add_argument("--only", metavar="GLOB", help="names of sequences to use")
    parser.add_argument("--exclude-person", metavar="ID", help="leave this person's sequences out")
    parser.add_argument("--noise-px", type=not_negative, default=2.5, metavar="PX",
                        help="noise added to true hand positions (default: 2.5)")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE",
                        help="model of the gesture, as config/gestures/approach.yaml;"
                             f" {_REST} is written beside it")


def run(arguments: argparse.Namespace) -> int:
    """0 when the models are written."""
    where = layout.find()
    output, rest = arguments.output, arguments.output.parent / _REST
    _check(arguments)
    with tempfile.TemporaryDirectory() as folder:
        recordings, models = Path(folder) / "recordings", Path(folder) / "models"
        _prepare(where, arguments, recordings)
        options = ["--recordings", str(recordings), "--output", str(models),
                   "--name", output.stem, "--noise-px", str(arguments.noise_px)]
        if arguments.exclude_person:
            options += ["--exclude-person", as_word(arguments.exclude_person)]
        print(run_program(where, "deixis-train-gestures", *options), end="")
        for model, target in ((f"{output.stem}.yaml", output), (_REST, rest)):
            output_files.write_text(target, (models / model).read_text("utf-8"), "--output")
    print(f"written: {output} and {rest}")
    return 0


def _check(arguments: argparse.Namespace) -> None:
    """What can be known before the work."""
    if arguments.output.name == _REST:
        raise UserError(f"--output {arguments.output}: {_REST} is the name of the model of rest,"
                        " which is written beside: name another file")
    output_files.require_file(arguments.output, "--output")
    is_log = arguments.data.is_file()
    if is_log and arguments.labels is None:
        raise UserError("a log needs its labels: give --labels CSV")
    if is_log and (arguments.exclude_person or arguments.only):
        raise UserError("--exclude-person and --only go with a folder of sequences, not with a log")
    if not is_log and arguments.labels is not None:
        raise UserError(f"--labels goes with a log, and {arguments.data} is none: sequences bring"
                        " theirs in gestures.csv")


def _prepare(where: layout.Layout, arguments: argparse.Namespace, folder: Path) -> None:
    if arguments.data.is_file():
        write_log_recording(where, arguments.data, arguments.labels, folder)
        return
    sequences, skipped = read_sequences(
        arguments.data, arguments.only, ("joints.csv", "objects.csv", "gestures.csv"))
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    if not sequences:
        raise UserError(f"no labelled sequences in {arguments.data}")
    if arguments.exclude_person:
        _require_person(arguments.exclude_person, sequences)
    write_recordings(_training_layout(sequences), folder)


def _require_person(name: str, sequences: list[Sequence]) -> None:
    people = sorted({as_word(sequence.person_id) or "unknown" for sequence in sequences})
    if as_word(name) not in people:
        raise UserError(f"--exclude-person {name}: nobody of that name is there:"
                        f" there are {', '.join(people)}")


def _training_layout(sequences: list[Sequence]) -> list[Sequence]:
    """Objects that stand behind one another teach nothing about the image: those are left out."""
    apart = [s for s in sequences if not s.name.startswith("pointing_")]
    for sequence in sequences:
        if apart and sequence not in apart:
            print(f"not used: {sequence.name} (its objects stand behind one another)")
    return apart or sequences
