"""`deixis demo`: a clip played through all services; says what is pointed at, and how well people were seen."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url, output_files
from deixis_frontend.demo import live, one_process
from deixis_frontend.demo.bodies import Bodies
from deixis_frontend.demo.clip import Clip, open_clip
from deixis_frontend.demo.commentary import Commentary
from deixis_frontend.demo.stage import Stage
from deixis_frontend.number_options import above_zero

SETTLING_S = 3.0  # by then a body can be expected
DEFAULT_BUS = "one on a free port of this host, so that nothing else is disturbed"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to play, for how long, and whether to show it."""
    parser.add_argument("--seconds", type=above_zero, metavar="N",
                        help="play N seconds of the clip, or all of it if it is shorter")
    parser.add_argument("--clip", type=Path, metavar="FILE",
                        help="video, or folder with left.mp4; with right.mp4, intrinsics.yml and extrinsics.yml"
                             " beside it bodies are fitted, too (default: the one that is shipped)")
    show = parser.add_mutually_exclusive_group()
    show.add_argument("--headless", action="store_true",
                      help="save the pictures with what was seen in them (default)")
    show.add_argument("--window", action="store_true", help="show them in a window too")
    parser.add_argument("--output", type=Path, metavar="FOLDER",
                        help="where pictures and logs go (default: output/demo)")
    parser.add_argument("--no-build", action="store_true", help="take the programs as they are")


def run(arguments: argparse.Namespace) -> int:
    """0 when gestures were recognised, or when --seconds ended the clip before its own end; 1 when nobody's body was
    found in a clip of two cameras, unless it was cut off before that can be expected."""
    layout = layouts.find()
    clip = open_clip(arguments.clip, layout)
    layout.use_types()
    from deixis import body_poses_t, gesture_t

    folder = (arguments.output or layout.state / "output" / "demo").resolve()
    output_files.require_folder(folder, "--output")
    stage = Stage(layout, folder, arguments.window)
    stage.clear()
    commentary = Commentary(clip, gesture_t, arguments.seconds)
    bodies = Bodies(body_poses_t)
    _play(clip, stage, commentary, bodies, arguments.lcm_url)
    print(commentary.verdict())
    if clip.is_stereo:
        print(bodies.verdict())
        is_cut_short = commentary.is_over and commentary.played_s < SETTLING_S
        if not bodies.count and not is_cut_short:
            print(f"deixis: no body was found: see the logs in {folder}", file=sys.stderr)
            return 1
    if commentary.count or commentary.is_over:
        return 0
    print(f"deixis: no gesture was recognised: see the logs in {folder}", file=sys.stderr)
    return 1


def _play(clip: Clip, stage: Stage, commentary: Commentary, bodies: Bodies, url: str | None) -> None:
    print(f"playing {clip.video}; pictures go to {stage.pictures}", flush=True)
    reason = None if url else lcm_url.why_multicast_fails()
    if not reason:
        live.play(clip, stage, commentary, bodies, lcm_url.parse(url) if url else lcm_url.with_free_port())
        return
    print(f"{reason}: the services run in one process instead, which takes a moment.\n"
          f"To see them live, {lcm_url.CURE_ROUTE}.", flush=True)
    one_process.play(clip, stage, commentary, bodies)
