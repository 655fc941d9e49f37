"""`deixis install-units`: what systemd gets, and that nothing is written or removed unasked."""

from __future__ import annotations

import configparser
import getpass
import io
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from deixis_frontend.cli import main

_URL = "udpm://239.255.1.2:7667?ttl=0"
Said = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def surroundings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A configuration folder of our own, a systemctl that notes what it is asked for."""
    for name in ("DEIXIS_CONFIG_DIR", "DEIXIS_RUN_DIR", "DEIXIS_PYTHON", "LCM_DEFAULT_URL",
                 "SUDO_USER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "own"))
    fake = tmp_path / "bin" / "systemctl"
    fake.parent.mkdir()
    fake.write_text(f'#!/bin/sh\necho "$@" >>{tmp_path}/asked\n', encoding="ascii")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{fake.parent}:{Path(sys.executable).parent}:/usr/bin:/bin")


def asked(tmp_path: Path) -> list[str]:
    file = tmp_path / "asked"
    return file.read_text(encoding="ascii").splitlines() if file.exists() else []


def section_of(path: Path, name: str) -> dict[str, str]:
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    parser.optionxform = str  # type: ignore[assignment]
    parser.read(path)
    return dict(parser[name])


def system_file(tmp_path: Path, **entry: object) -> Path:
    path = tmp_path / "my system.yaml"
    path.write_text(f"{{name: robot, services: {{eyes: {entry}}}}}", encoding="utf-8")
    return path


def written(tmp_path: Path, *arguments: str) -> Path:
    output = tmp_path / "out"
    assert main(["install-units", "--output", str(output), "-l", _URL, *arguments]) == 0
    return output


def test_the_unit_runs_the_supervisor(tmp_path: Path, repository: Path) -> None:
    output = written(tmp_path)
    service = section_of(output / "deixis.service", "Service")
    assert service["ExecStart"] == (f"{repository}/scripts/deixis start --foreground --system"
                                    f" {repository}/config/system.yaml")
    assert (service["Type"], service["Restart"], service["KillMode"]) == (
        "notify", "on-failure", "mixed")
    assert service["User"] == getpass.getuser() and service["SupplementaryGroups"] == "video"
    assert service["NoNewPrivileges"] == "yes" and service["ProtectSystem"] == "full"
    assert "WatchdogSec" not in service and "PrivateTmp" not in service
    assert service["EnvironmentFile"] == "-/etc/deixis/deixis.env"
    assert f'LCM_DEFAULT_URL="{_URL}"' in (output / "deixis.env").read_text(encoding="utf-8")
    unit = section_of(output / "deixis.service", "Unit")
    assert unit["Wants"] == "deixis-bus-setup.service"
    assert "deixis-bus-setup.service" in unit["After"] and "online" not in unit["After"]


def test_time_limits_follow_from_the_services(tmp_path: Path) -> None:
    system = system_file(tmp_path, ready_within_s=100, give_up_after=4, stop_within_s=50)
    output = written(tmp_path, "--system", str(system))
    service = section_of(output / "deixis-robot.service", "Service")
    assert (service["TimeoutStartSec"], service["TimeoutStopSec"]) == ("430", "80")


def test_the_bus_is_set_up_for_its_group(tmp_path: Path) -> None:
    text = (written(tmp_path) / "deixis-bus-setup.service").read_text(encoding="utf-8")
    assert "ip route get 239.255.1.2" in text and "ip route add 224.0.0.0/4 dev lo" in text
    assert "echo 4194304 >/proc/sys/net/core/rmem_max" in text


def test_a_bus_that_leaves_the_host_waits_for_the_network(tmp_path: Path) -> None:
    output = tmp_path / "out"
    assert main(["install-units", "--output", str(output), "-l",
                 "udpm://239.255.1.2:7667?ttl=1"]) == 0
    unit = section_of(output / "deixis.service", "Unit")
    assert unit["After"] == "network-online.target"  # The last of two.
    assert "ip route" not in (output / "deixis-bus-setup.service").read_text(encoding="utf-8")


@pytest.mark.parametrize("own", [False, True])
def test_systemd_takes_the_units(tmp_path: Path, own: bool,
                                 monkeypatch: pytest.MonkeyPatch) -> None:
    if not shutil.which("systemd-analyze"):
        pytest.skip("this machine has no systemd-analyze")
    monkeypatch.setenv("DEIXIS_BUILD_DIR", str(tmp_path / 'a "b" $c %d'))
    system = system_file(tmp_path)
    output = written(tmp_path, "--system", str(system), "eyes", *(["--user"] if own else []))
    done = subprocess.run(
        ["systemd-analyze", *(["--user"] if own else []), "verify", "--man=no",
         *map(str, output.glob("*.service"))], capture_output=True, text=True, check=False,
        timeout=60, env={"HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path),
                         "PATH": "/usr/bin:/bin"})
    if own and "Failed to initialize manager" in done.stderr:
        pytest.skip(f"no user manager can be had here: {done.stderr.strip()}")
    assert done.returncode == 0 and "robot" not in done.stderr, done.stderr


def test_words_with_signs_of_systemd_stay_as_they_are(tmp_path: Path) -> None:
    folder = tmp_path / '100% $HOME "x"'
    folder.mkdir()
    output = written(tmp_path, "--system", str(system_file(folder)))
    command = section_of(output / "deixis-robot.service", "Service")["ExecStart"]
    quoted = str(folder / "my system.yaml").replace("%", "%%").replace("$", "$$").replace(
        '"', '\\"')
    assert command.endswith(f'--system "{quoted}"')


def test_ones_own_units_need_no_root_and_ask_for_none(tmp_path: Path, capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    units = tmp_path / "own" / "systemd" / "user"
    assert [path.name for path in units.iterdir()] == ["deixis.service"]
    service = section_of(units / "deixis.service", "Service")
    assert not {"User", "SupplementaryGroups", "ProtectSystem"} & set(service)
    assert service["EnvironmentFile"] == f"-{tmp_path}/own/deixis/deixis.env"
    assert section_of(units / "deixis.service", "Install")["WantedBy"] == "default.target"
    assert asked(tmp_path) == ["--user daemon-reload"]
    said = capsys.readouterr().out
    assert "systemctl --user enable --now deixis.service" in said and "enable-linger" in said


def test_the_environment_is_kept_and_the_rest_replaced(tmp_path: Path, capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    own = tmp_path / "own"
    environment = own / "deixis" / "deixis.env"
    environment.write_text("LCM_DEFAULT_URL=mine\n", encoding="ascii")
    assert main(["install-units", "--user", "--yes", "-l", _URL, "viewer"]) == 0
    assert environment.read_text(encoding="ascii") == "LCM_DEFAULT_URL=mine\n"
    assert "it differs from what would be written now" in capsys.readouterr().out
    unit = own / "systemd" / "user" / "deixis.service"
    assert section_of(unit, "Service")["ExecStart"].endswith(" viewer")
    before = len(asked(tmp_path))
    assert main(["install-units", "--user", "--yes", "-l", _URL, "viewer"]) == 0
    assert len(asked(tmp_path)) == before  # Nothing to do.


def test_units_are_taken_away_again(tmp_path: Path, capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    assert main(["install-units", "--user", "--yes", "-l", _URL, "--uninstall"]) == 0
    assert asked(tmp_path)[1:] == ["--user disable --now deixis.service", "--user daemon-reload"]
    assert not [path for path in (tmp_path / "own").rglob("*") if path.is_file()]
    assert main(["install-units", "--user", "--yes", "--uninstall"]) == 0
    assert "there are no units of the system 'deixis'" in capsys.readouterr().out


def test_the_environment_is_taken_away_whatever_the_bus_is_now(tmp_path: Path,
                                                               capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    assert main(["install-units", "--user", "--yes", "--uninstall"]) == 0
    assert ": left" not in capsys.readouterr().out
    assert not [path for path in (tmp_path / "own").rglob("*") if path.is_file()]


def test_units_that_cannot_be_stopped_are_left(tmp_path: Path, capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    (tmp_path / "bin" / "systemctl").write_text("#!/bin/sh\necho no bus >&2; exit 1\n",
                                                encoding="ascii")
    assert main(["install-units", "--user", "--yes", "-l", _URL, "--uninstall"]) == 1
    said = capsys.readouterr().err
    assert "failed: no bus" in said and "nothing was removed" in said
    assert (tmp_path / "own" / "systemd" / "user" / "deixis.service").exists()


@pytest.mark.parametrize(("answer", "code"), [("", 1), ("n\n", 1), ("\n", 1), ("y\n", 0)])
def test_only_yes_is_an_agreement(tmp_path: Path, capsys: Said, answer: str, code: int,
                                  monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = io.StringIO(answer)  # Nothing: Ctrl-D.
    monkeypatch.setattr(terminal, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stdin", terminal)
    assert main(["install-units", "--user", "-l", _URL]) == code
    assert "Write these files? [y/N]" in capsys.readouterr().err
    assert (tmp_path / "own").exists() == (code == 0)


def test_what_was_changed_or_is_somebody_elses_is_left(tmp_path: Path, capsys: Said) -> None:
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    environment = tmp_path / "own" / "deixis" / "deixis.env"
    environment.write_text("A=1\n", encoding="ascii")
    unit = tmp_path / "own" / "systemd" / "user" / "deixis.service"
    unit.write_text("[Unit]\n", encoding="ascii")
    assert main(["install-units", "--user", "--yes", "-l", _URL]) == 1
    assert f"{unit} is there and not of `deixis install-units`" in capsys.readouterr().err
    assert main(["install-units", "--user", "--yes", "-l", _URL, "--uninstall"]) == 0
    assert environment.exists() and unit.exists()


@pytest.mark.parametrize("more", [[], ["--uninstall"]])
def test_nothing_is_changed_unasked(tmp_path: Path, capsys: Said, more: list[str],
                                    monkeypatch: pytest.MonkeyPatch) -> None:
    if more:
        assert main(["install-units", "--user", "--yes", "-l", _URL]) == 0
    before = sorted((tmp_path / "own").rglob("*"))
    monkeypatch.setattr(sys, "stdin", open("/dev/null", encoding="ascii"))
    assert main(["install-units", "--user", "-l", _URL, *more]) == 1
    assert "nothing was changed" in capsys.readouterr().err
    assert sorted((tmp_path / "own").rglob("*")) == before


@pytest.mark.parametrize(("arguments", "fault"), [
    (["--run-as", "nobody-of-that-name"], "there is no user 'nobody-of-that-name'"),
    (["--run-as", "root", "--user"], "exclude each other"),
    (["no_such_service"], "no service or group 'no_such_service'"),
    (["-l", "memq://"], "leads to no other process"),
    (["--output", "/proc/x"], "cannot be written")])
def test_what_cannot_be_is_refused(tmp_path: Path, capsys: Said, arguments: list[str],
                                   fault: str) -> None:
    assert main(["install-units", "--yes", *(arguments if "--output" in arguments else
                                              [*arguments, "--output", str(tmp_path / "o")])]) == 1
    assert fault in capsys.readouterr().err
    assert not (tmp_path / "o").exists()


def test_an_installed_tree_names_its_launcher_and_its_python(
        repository: Path, tmp_path: Path) -> None:
    python = tmp_path / "prefix" / "lib" / "deixis" / "python"
    python.mkdir(parents=True)
    for package in ("deixis_frontend", "deixis_lcm"):
        shutil.copytree(repository / "scripts/python" / package, python / package)
    shutil.copytree(repository / "config", tmp_path / "prefix" / "share" / "deixis" / "config")
    done = subprocess.run(
        [sys.executable, "-m", "deixis_frontend", "install-units", "--output", tmp_path / "out",
         "-l", _URL], env={"PYTHONPATH": str(python), "HOME": str(tmp_path)}, cwd=tmp_path,
        check=False, timeout=60, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    command = section_of(tmp_path / "out" / "deixis.service", "Service")["ExecStart"]
    assert command == (f"{tmp_path}/prefix/bin/deixis start --foreground --system"
                       f" {tmp_path}/prefix/share/deixis/config/system.yaml")
    assert f'DEIXIS_PYTHON="{sys.executable}"' in (tmp_path / "out" / "deixis.env").read_text(
        encoding="utf-8")
