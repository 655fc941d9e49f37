"""`deixis calibrate` and `deixis evaluate calibration`, on pictures made from a printed board."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest
from front_end import deixis, deixis_beside
from PIL import Image

from deixis_frontend.cli import main
from deixis_frontend.evaluation.calibration import parse

SQUARE_M = 0.025
BOARD = ("--board", "9x6", "--square", str(SQUARE_M))
CAMERA = np.array([[600.0, 0.0, 322.0], [0.0, 600.0, 238.0], [0.0, 0.0, 1.0]])
BASELINE_M = 0.08


NO_BUS = "memq://"


def calibrate(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Runs `deixis calibrate` to its end, on files."""
    return deixis(NO_BUS, "calibrate", *arguments, seconds=300.0)


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Image.Image:
    """The board as `calibrate board` prints it: a margin of one square around ten by seven."""
    path = tmp_path_factory.mktemp("board") / "board.png"
    done = calibrate("board", *BOARD, "--print", path)
    assert done.returncode == 0, done.stderr
    assert "250 mm" in done.stdout
    return Image.open(path).convert("L").reduce(9)  # about as fine as the pictures


def rotation(x: float, y: float) -> np.ndarray:
    """About x, then about y, radians."""
    about_x = np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    return about_y @ about_x


def picture(printed: Image.Image, number: int, camera_x_m: float) -> Image.Image:
    """The board in its pose `number`, seen by a camera without distortion."""
    tilts = [(0.1, 0.0), (0.5, 0.1), (-0.5, 0.1), (0.1, 0.5), (0.0, -0.5), (0.4, 0.4), (-0.4, -0.3)]
    places = [(0, 0), (-1, -1), (1, 1), (1, -1), (-1, 1), (0.4, -0.6), (-0.7, 0.3), (0, 0.9)]
    turn = rotation(*tilts[number % len(tilts)])
    z_m = 0.6 * (1.0 + 0.1 * (number % 3))
    place = places[number % len(places)]
    centre = np.array([0.2 * place[0] * z_m - camera_x_m, 0.16 * place[1] * z_m, z_m])
    paper_px_per_m = printed.width / (12 * SQUARE_M)
    middle = np.array([printed.width, printed.height]) / 2.0
    scale = np.array([[1 / paper_px_per_m, 0, -middle[0] / paper_px_per_m],
                      [0, 1 / paper_px_per_m, -middle[1] / paper_px_per_m], [0, 0, 1]])
    image_from_paper = CAMERA @ np.column_stack([turn[:, 0], turn[:, 1], centre]) @ scale
    paper_from_image = np.linalg.inv(image_from_paper)
    paper_from_image /= paper_from_image[2, 2]
    return printed.transform((640, 480), Image.Transform.PERSPECTIVE,
                             tuple(paper_from_image.ravel()[:8]), Image.Resampling.BILINEAR,
                             fillcolor=110)


@pytest.fixture(scope="module")
def pictures(printed: Image.Image, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with twelve pairs."""
    folder = tmp_path_factory.mktemp("pairs")
    for number in range(12):
        picture(printed, number, -BASELINE_M / 2).save(folder / f"left{number}.png")
        picture(printed, number, BASELINE_M / 2).save(folder / f"right{number}.png")
    return folder


def numbers(text: str, key: str) -> list[float]:
    """The values of a matrix in OpenCV's YAML."""
    data = text.split(f"{key}: !!opencv-matrix")[1].split("data: [")[1].split("]")[0]
    return [float(value) for value in data.split(",")]


def test_a_camera_is_calibrated_from_files(pictures: Path, tmp_path: Path) -> None:
    output = tmp_path / "camera.yml"
    done = calibrate("camera", *BOARD, "--pictures", pictures / "left*.png", "-o", output)
    assert done.returncode == 0, done.stdout + done.stderr
    matrix = numbers(output.read_text(encoding="utf-8"), "camera_matrix")
    assert matrix[0] == pytest.approx(600.0, abs=4.0)
    assert matrix[2] == pytest.approx(322.0, abs=4.0)
    again = calibrate("camera", *BOARD, "--pictures", pictures / "left*.png", "-o", output)
    assert again.returncode == 1
    assert again.stderr.splitlines() == [
        f"deixis-calibrator: {output} is there already: name another --output, or give --force"]


def test_a_stereo_pair_is_calibrated_from_files(pictures: Path, tmp_path: Path) -> None:
    done = calibrate("stereo", *BOARD, "--left", pictures / "left*.png",
                  "--right", pictures / "right*.png", "-o", tmp_path / "rig")
    assert done.returncode == 0, done.stdout + done.stderr
    place = numbers((tmp_path / "rig" / "extrinsics.yml").read_text(encoding="utf-8"), "T")
    assert place[0] == pytest.approx(-BASELINE_M, abs=0.001)


def test_a_poor_calibration_is_not_written(pictures: Path, tmp_path: Path) -> None:
    output = tmp_path / "camera.yml"
    done = calibrate("camera", *BOARD, "-o", output,
                  "--pictures", *(pictures / f"left{i}.png" for i in range(4)))
    assert done.returncode == 1
    assert "4 views are too few" in done.stdout
    assert not output.exists()


def test_unequal_lists_are_told_in_a_line(pictures: Path, tmp_path: Path) -> None:
    done = calibrate("stereo", *BOARD, "--left", pictures / "left*.png",
                  "--right", pictures / "right0.png", "-o", tmp_path)
    assert done.returncode == 1
    assert "--left names 12 pictures but --right 1" in done.stderr


@pytest.mark.parametrize("arguments", [(), ("lens",), ("camera",), ("camera", "--board", "9")])
def test_wrong_usage_ends_with_two(arguments: tuple[str, ...]) -> None:
    assert calibrate(*arguments).returncode == 2


def test_what_is_missing_is_named_without_what_is_not_there() -> None:
    [*_, said] = calibrate().stderr.splitlines()
    assert said.endswith("the following arguments are required: {camera,stereo,board}")


def test_help_of_a_part_is_the_programs() -> None:
    done = calibrate("stereo", "--help")
    assert done.returncode == 0
    assert "--side-by-side" in done.stdout
    assert "Usage: deixis calibrate stereo " in done.stdout


def test_ctrl_c_ends_the_collecting(url: str, tmp_path: Path) -> None:
    with deixis_beside(url, "calibrate", "-l", url, "camera", *BOARD, "--channel", "CAMERA",
                       "-o", tmp_path / "camera.yml") as process:
        assert process.stdout is not None
        assert "no pictures have come on channel CAMERA" in process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    assert errors.startswith("deixis-calibrator: no view was accepted out of 0 pictures")


def test_the_evaluation_compares_with_the_sample(pictures: Path, tmp_path: Path,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    report = tmp_path / "report.json"
    assert main(["evaluate", "calibration", "--data", str(pictures), "--left", "left*.png",
                 "--right", "right*.png", "--json", str(report)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("12 pairs")
    assert "opencv sample" in said
    assert '"held_out_rows"' in report.read_text(encoding="utf-8")


def test_pictures_of_an_evaluation_leave_the_rigs_calibration_alone(pictures: Path,
                                                                    tmp_path: Path) -> None:
    (tmp_path / "intrinsics.yml").write_text("the rig's own\n", encoding="ascii")
    assert main(["evaluate", "calibration", "--data", str(pictures), "--left", "left*.png",
                 "--right", "right*.png", "--save", str(tmp_path)]) == 0
    assert (tmp_path / "intrinsics.yml").read_text(encoding="ascii") == "the rig's own\n"
    assert not (tmp_path / "extrinsics.yml").exists()
    assert (tmp_path / "rectified.png").exists()


def test_an_evaluation_without_pictures_is_told(tmp_path: Path,
                                                capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "calibration", "--data", str(tmp_path)]) == 1
    assert "name the pictures with --left" in capsys.readouterr().err


def test_figures_are_read_by_procedure_and_part() -> None:
    pairs, rows = parse("procedure,part,what,a,b,c\nall,all,pairs,13,0,0\nx,fitted,rows,1,2,3\n")
    assert pairs == 13
    assert rows == {"x": {("fitted", "rows"): (1.0, 2.0, 3.0)}}
