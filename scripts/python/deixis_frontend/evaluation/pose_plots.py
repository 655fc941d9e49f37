"""Pictures of what the pose fitter found: its worst frames over the left picture, and errors over time."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend.evaluation.pose_joints import BONES, NAMES, SIDES, index
from deixis_frontend.evaluation.pose_matching import JudgedPerson
from deixis_frontend.evaluation.pose_outlines import Pinhole, limb_outlines
from deixis_frontend.evaluation.pose_scores import is_lost, runs
from deixis_frontend.evaluation.pose_truth import Segment

_SHOWN = 12
_COLUMNS = 4
_TILE_PX = (480, 360)
_APART_S = 0.5  # between frames that are shown
_MOST_M = 0.3  # of the scale of colours
_STATES = ("deepskyblue", "gold", "silver", "red")  # MEASURED, INFERRED, HIDDEN, LOST
_TRUE, _OFF = "lime", "magenta"


def write(name: str, judged: JudgedPerson, segments: list[Segment], log: Path,
          messages: list[tuple[str, Any]], folder: Path) -> None:
    """NAME_worst.png and NAME_errors.png in `folder`. `log` has STEREO and STEREO_CALIBRATION, `messages` what the
    fitter published. Draws without pyplot, so that several threads may."""
    folder.mkdir(parents=True, exist_ok=True)
    _write_errors(f"{name}, {judged.name}", judged, segments, folder / f"{name}_errors.png")
    _write_worst(judged, segments, log, messages, folder / f"{name}_worst.png")


def worst_frames(judged: JudgedPerson) -> list[int]:
    """Those with the largest sum of errors of visible joints (a metre at most each), some time apart."""
    errors = np.where(judged.is_visible & ~np.isnan(judged.errors_m), np.minimum(judged.errors_m, 1.0), 0.0)
    chosen: list[int] = []
    for frame in np.argsort(-errors.sum(axis=1), kind="stable"):
        if len(chosen) < _SHOWN and all(abs(frame - other) >= _APART_S * judged.fps for other in chosen):
            chosen.append(int(frame))
    return chosen


def _write_worst(judged: JudgedPerson, segments: list[Segment], log: Path, messages: list[tuple[str, Any]],
                 path: Path) -> None:
    from PIL import Image

    frames = worst_frames(judged)
    pictures, camera = _pictures(log, set(frames), judged.fps)
    bodies = _bodies(messages, judged.fps)
    rows = -(-len(frames) // _COLUMNS)
    sheet = Image.new("RGB", (_COLUMNS * _TILE_PX[0], rows * _TILE_PX[1]))
    for place, frame in enumerate(frames):
        if frame not in pictures or camera is None:
            continue
        box = crop_around(camera.pixels(np.nan_to_num(judged.true_m[frame])))
        tile = pictures[frame].crop(box).resize(_TILE_PX)
        view = camera.cropped(box, _TILE_PX[0])
        _draw(tile, judged, frame, bodies.get(frame, []), view, segments)
        sheet.paste(tile, (place % _COLUMNS * _TILE_PX[0], place // _COLUMNS * _TILE_PX[1]))
    sheet.save(path)


def crop_around(points_px: np.ndarray) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of a box with the shape of a tile and room around the points."""
    low, high = points_px.min(axis=0), points_px.max(axis=0)
    width, height = _TILE_PX
    half_height = max(0.62 * (high[1] - low[1]), 0.62 * (high[0] - low[0]) * height / width, 60.0)
    half = np.array([half_height * width / height, half_height])
    middle = 0.5 * (low + high)
    left, top = np.floor(middle - half).astype(int)
    right, bottom = np.ceil(middle + half).astype(int)
    return int(left), int(top), int(right), int(bottom)


def _pictures(log: Path, frames: set[int], fps: float) -> tuple[dict[int, Any], Pinhole | None]:
    """Left pictures of some frames, and the camera that they are of."""
    from PIL import Image

    from deixis_lcm import logs

    camera, pictures = None, {}
    for _, channel, message in logs.read(log, {"STEREO", "STEREO_CALIBRATION"}):
        if channel == "STEREO_CALIBRATION":
            camera = Pinhole.of(message.rectified)
        elif (frame := round(message.utime * 1e-6 * fps)) in frames:
            left = message.images[list(message.image_types).index(message.LEFT)]
            pictures[frame] = Image.open(io.BytesIO(bytes(left.data))).convert("RGB")
    return pictures, camera


def _bodies(messages: list[tuple[str, Any]], fps: float) -> dict[int, list[tuple[Any, Any]]]:
    """Poses with their models, by frame."""
    models: dict[int, Any] = {}
    bodies = {}
    for channel, message in messages:
        if channel == "BODY_MODEL":
            models[message.model_id] = message
        else:
            bodies[round(message.utime * 1e-6 * fps)] = [(body, models[body.model_id]) for body in message.bodies
                                                         if body.model_id in models]
    return bodies


def _draw(tile: Any, judged: JudgedPerson, frame: int, bodies: list[tuple[Any, Any]], camera: Pinhole,
          segments: list[Segment]) -> None:
    from PIL import ImageDraw

    pen = ImageDraw.Draw(tile)
    for body, model in bodies:
        for state, outline in limb_outlines(body, model, camera):
            pen.polygon(outline, outline=_STATES[state])
    true = camera.pixels(np.nan_to_num(judged.true_m[frame]))
    for a, b in ((index(side, a), index(side, b)) for side in SIDES for a, b in BONES.values()):
        pen.line([tuple(true[a]), tuple(true[b])], fill=_TRUE)
    if judged.ids[frame] >= 0:
        for place, found in zip(true, camera.pixels(np.nan_to_num(judged.found_m[frame]))):
            pen.line([tuple(place), tuple(found)], fill=_OFF, width=2)
    labels = [s.label for s in segments if s.start <= frame <= s.end]
    pen.text((8, 8), " ".join([f"{judged.name} {frame}", *labels, _worst_joint(judged, frame)]), fill="white",
             stroke_fill="black", stroke_width=2)


def _worst_joint(judged: JudgedPerson, frame: int) -> str:
    errors = np.where(judged.is_visible[frame], np.nan_to_num(judged.errors_m[frame], posinf=np.inf), 0.0)
    worst = int(np.argmax(errors))
    return "not found" if np.isinf(errors[worst]) else f"{NAMES[worst]} {errors[worst]:.2f} m"


def _write_errors(title: str, judged: JudgedPerson, segments: list[Segment], path: Path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(14, 6), constrained_layout=True)
    canvas = FigureCanvasAgg(figure)
    lines, joints = figure.subplots(2, 1, sharex=True)
    errors = np.where(judged.is_visible, np.minimum(judged.errors_m, 1.0), np.nan)
    has_any = np.isfinite(errors).any(axis=1)
    times = np.flatnonzero(has_any) / judged.fps
    lines.plot(times, np.nanmedian(errors[has_any], axis=1), label="median of visible joints")
    lines.plot(times, np.nanmax(errors[has_any], axis=1), label="worst visible joint", linewidth=0.7)
    for first, last in runs(is_lost(judged)):
        lines.axvspan(first / judged.fps, (last + 1) / judged.fps, color="red", alpha=0.2)
    for segment in segments:
        lines.axvspan(segment.start / judged.fps, segment.end / judged.fps, color="grey", alpha=0.1)
        lines.text(segment.start / judged.fps, 0.95 * _MOST_M, segment.label, fontsize=7)
    lines.set(title=f"{title} (red: lost)", ylabel="error, m", ylim=(0, _MOST_M))
    lines.legend(loc="upper right")
    extent = (0.0, len(errors) / judged.fps, len(NAMES) - 0.5, -0.5)
    shown = joints.imshow(errors.T, aspect="auto", extent=extent, vmin=0.0, vmax=_MOST_M, interpolation="none")
    joints.set(xlabel="s (white: hidden)", yticks=range(len(NAMES)), yticklabels=NAMES)
    figure.colorbar(shown, ax=joints, label="error, m")
    canvas.print_png(path)
