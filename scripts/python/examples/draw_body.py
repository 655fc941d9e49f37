#!/usr/bin/env python3
"""Draws the people of one image as wireframes, seen from the camera and from its left, into a PNG file.

    PYTHONPATH=build/release/python:scripts/python .venv/bin/python scripts/python/examples/draw_body.py OUTPUT.png

Knows nothing but the messages: the limbs of BODY_MODEL, the root and the angles of BODY_POSES. Where these put the
limbs is compared with where the message says that they are. Listens where LCM_DEFAULT_URL says, or reads a log.
"""
import argparse
import sys

try:
    import lcm
    import numpy as np
    from deixis import body_model_t, body_poses_t, dof_t, limb_pose_t
    from deixis_lcm import decoding, logs
    from matplotlib.figure import Figure
except ModuleNotFoundError as error:
    sys.exit(f"{error}: run it as\n{__doc__.splitlines()[2]}")

MOST_DISAGREEMENT_M = 1e-3
OPACITY = {limb_pose_t.MEASURED: 1.0, limb_pose_t.INFERRED: 0.7, limb_pose_t.HIDDEN: 0.5, limb_pose_t.LOST: 0.3}


def rotation(vector):
    """exp of a rotation vector, radians (Rodrigues' formula)."""
    x, y, z = vector
    angle = np.linalg.norm(vector)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    # numpy's sinc(x) is sin(pi x) / (pi x): no division by an angle of zero.
    return np.eye(3) + np.sinc(angle / np.pi) * skew + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * skew @ skew


def matrix(transform):
    """A transform_t as a 4 x 4 matrix."""
    w, x, y, z = transform.rotation_wxyz
    made = np.eye(4)
    made[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    made[:3, 3] = transform.translation_m
    return made


def joint(dofs, angles_rad):
    """How a limb is turned from its rest: exp(swing) * hinges * exp(twist), as a 4 x 4 matrix."""
    turns = {kind: [angle * np.array(dof.axis) for dof, angle in zip(dofs, angles_rad) if dof.kind == kind]
             for kind in (dof_t.SWING, dof_t.HINGE, dof_t.TWIST)}
    made = np.eye(4)
    made[:3, :3] = rotation(sum(turns[dof_t.SWING], np.zeros(3)))
    for turn in turns[dof_t.HINGE] + turns[dof_t.TWIST]:
        made[:3, :3] = made[:3, :3] @ rotation(turn)
    return made


def limb_frames(model, pose):
    """frame_from_limb of each limb by the tree and the angles. ValueError when the pose is none of this model."""
    if pose.n_limbs != model.n_limbs or pose.n_angles != sum(limb.n_dofs for limb in model.limbs):
        raise ValueError("its angles or limbs are not as many as its model's")
    frames, first = [], 0
    for index, limb in enumerate(model.limbs):
        if not -1 <= limb.parent < index:
            raise ValueError("its model is no tree")
        turn = joint(limb.dofs, pose.angles_rad[first:first + limb.n_dofs])
        parent = matrix(pose.root_in_frame) if limb.parent < 0 else frames[limb.parent] @ matrix(limb.rest_in_parent)
        frames.append(parent @ turn)
        first += limb.n_dofs
    return frames


def wires(limb):
    """Lines on a limb's surface, in its frame: ellipses across it, and along it what joins them. Arrays (n, 3)."""
    def ring(share, phi_rad):
        def between(proximal, distal):
            return (1 - share) * np.array(proximal) + share * np.array(distal)
        x, y = between(limb.centre0_m, limb.centre1_m)
        return np.stack([x + between(limb.a0_m, limb.a1_m) * np.cos(phi_rad),
                         y + between(limb.b0_m, limb.b1_m) * np.sin(phi_rad),
                         np.full_like(phi_rad, share * limb.length_m)], axis=-1)
    around = np.linspace(0, 2 * np.pi, 33)
    rings = [ring(share, around) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    return rings + [np.stack([rings[0][i], rings[-1][i]]) for i in range(0, 32, 4)]


def placed(frame, points):
    """Points of a limb in the message's frame."""
    return points @ frame[:3, :3].T + frame[:3, 3]


def disagreement_m(model, pose):
    """How far wires of the model's tree lie from where the message says that its limbs are, at most."""
    frames = limb_frames(model, pose)
    return max(np.abs(placed(frame, wire) - placed(matrix(said.in_frame), wire)).max()
               for frame, limb, said in zip(frames, model.limbs, pose.limbs) for wire in wires(limb))


def figure_of(bodies):
    """A figure of (model, pose) pairs; its first axes show x y, the camera's view, its second z y."""
    figure = Figure(figsize=(9, 7), layout="constrained")
    views = figure.subplots(1, 2, sharey=True)
    for axes, title, across in zip(views, ("from the camera", "from the camera's left"), (0, 2)):
        for number, (model, pose) in enumerate(bodies):
            for frame, limb, said in zip(limb_frames(model, pose), model.limbs, pose.limbs):
                for points in (placed(frame, wire) for wire in wires(limb)):
                    axes.plot(points[:, across], points[:, 1], color=f"C{number}", linewidth=0.8,
                              alpha=OPACITY.get(said.state, 0.3))
        axes.set(title=title, xlabel=f"{'xyz'[across]} [m]", ylabel="y [m]", aspect="equal")
    views[1].invert_xaxis()  # Seen from the left, what is near is to the right.
    views[0].invert_yaxis()  # y points down.
    return figure


def received(log):
    """Messages of a log, or of the bus for ever."""
    if log:
        yield from (message for _, _, message in logs.read(log))
        return
    types, waiting, bus = decoding.types_by_fingerprint(), [], lcm.LCM()
    for channel in "BODY_MODEL", "BODY_POSES":
        bus.subscribe(channel, lambda _, data: waiting.append(data))
    while True:
        bus.handle()
        while waiting:
            try:
                yield decoding.decode(waiting.pop(0), types)
            except decoding.DecodeError as error:
                print(f"passed over: {error}", file=sys.stderr, flush=True)


def known_bodies(messages):
    """For each body_poses_t the people, as (model, pose), whose model has come; none of them: passed over."""
    models = {}
    for message in messages:
        if isinstance(message, body_model_t):
            models[message.model_id] = message
        elif isinstance(message, body_poses_t):
            bodies = [(models[pose.model_id], pose) for pose in message.bodies if pose.model_id in models]
            if bodies:
                yield bodies


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", help="the PNG file to write")
    parser.add_argument("--log", help="a log to read instead of the bus")
    parser.add_argument("--skip", type=int, default=0, metavar="N", help="pass over N images that show people first")
    arguments = parser.parse_args()
    try:
        for number, bodies in enumerate(known_bodies(received(arguments.log))):
            if number < arguments.skip:
                continue
            largest_m = max(disagreement_m(model, pose) for model, pose in bodies)
            print(f"{len(bodies)} people; limbs lie within {1000 * largest_m:.3f} mm of where the message has them")
            if largest_m > MOST_DISAGREEMENT_M:
                print("warning: angles and limbs of the message do not belong together", file=sys.stderr)
            figure_of(bodies).savefig(arguments.output, format="png", dpi=120)
            return 0
    except (OSError, ValueError) as error:
        print(f"draw_body: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    print("draw_body: no such image: nobody is there, or poses came without their models", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
