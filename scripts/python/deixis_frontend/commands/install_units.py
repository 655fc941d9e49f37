"""`deixis install-units`: systemd units that start a system with the machine."""

from __future__ import annotations

import argparse
import getpass
import os
import pwd
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.commands.system_option import add_names, add_system
from deixis_frontend.deployment import systemd_units, unit_files
from deixis_frontend.deployment.systemd_units import Installation
from deixis_frontend.deployment.unit_files import UnitFile
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout
from deixis_frontend.questions import is_wanted
from deixis_frontend.supervision import system_file

_SYSTEM_FOLDER = Path("/etc/systemd/system")
_HANDED_ON = ("DEIXIS_BUILD_DIR", "DEIXIS_CONFIG_DIR", "DEIXIS_RUN_DIR")  # folders


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """For whom, where to, and whether to ask."""
    add_names(parser, "what to start (default: 'start' of the system file)")
    parser.add_argument("--user", action="store_true",
                        help="units of your own systemd, which start when you log in; no root")
    parser.add_argument("--run-as", metavar="USER",
                        help="user that the services run as (default: you, also behind sudo)")
    parser.add_argument("--yes", action="store_true", help="do not ask")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--output", type=Path, metavar="DIR",
                      help="only write the files there, to look at or to put into a package")
    what.add_argument("--uninstall", action="store_true", help="stop the units and remove them")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when all was written or removed."""
    if arguments.user and arguments.run_as:
        raise UserError("--run-as and --user exclude each other: your own systemd runs as you")
    installation = _installation(arguments, layouts.find())
    files = _files(installation, arguments.output)
    if arguments.uninstall:
        return _uninstall(installation, files, arguments)
    return _install(installation, files, arguments)


def _installation(arguments: argparse.Namespace, layout: Layout) -> Installation:
    system = system_file.load((arguments.system or layout.find_config("system.yaml")).absolute())
    system.resolve(arguments.names)  # A wrong name is told now, not at the next start.
    url = lcm_url.choose(arguments.lcm_url)
    if url.provider not in ("udpm", "tcpq"):
        raise UserError(f"LCM URL '{url}' leads to no other process: name a bus with -l")
    name = "deixis" if system.name == "deixis" else f"deixis-{system.name}"
    return Installation(
        system=system, names=tuple(arguments.names), launcher=layout.launcher, url=url,
        environment=_environment(layout),
        environment_file=_environment_folder(arguments.user) / f"{name}.env",
        run_as=None if arguments.user else _user(arguments.run_as))


def _environment(layout: Layout) -> dict[str, str]:
    handed_on = {name: str(Path(os.environ[name]).absolute())
                 for name in _HANDED_ON if os.environ.get(name)}
    if layout.repository is None or os.environ.get("DEIXIS_PYTHON"):
        handed_on["DEIXIS_PYTHON"] = sys.executable  # This one has what it needs.
    return handed_on


def _user(given: str | None) -> str:
    name = given or os.environ.get("SUDO_USER") or getpass.getuser()
    try:
        pwd.getpwnam(name)
    except KeyError:
        raise UserError(f"there is no user '{name}': name one with --run-as") from None
    return name


def _own_folder() -> Path:
    return Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config")


def _environment_folder(is_user: bool) -> Path:
    return (_own_folder() if is_user else Path("/etc")) / "deixis"


def _files(installation: Installation, output: Path | None) -> list[UnitFile]:
    is_user = installation.run_as is None
    folder = output or (_own_folder() / "systemd" / "user" if is_user else _SYSTEM_FOLDER)
    settings = installation.environment_file
    files = [UnitFile(folder / installation.unit, systemd_units.supervisor_unit(installation)),
             UnitFile(output / settings.name if output else settings,
                      unit_files.sealed(systemd_units.environment_text(installation)), is_users=True)]
    if not is_user:
        files.append(UnitFile(folder / installation.bus_unit, systemd_units.bus_unit(installation)))
    return files


def _install(installation: Installation, files: list[UnitFile],
             arguments: argparse.Namespace) -> int:
    needed = [file for file in files if file.is_needed()]
    for file in needed:
        print(f"--- {file.path}\n{file.text}")
    for file in files:
        if file not in needed:
            _say_that_it_stays(file)
    if needed and not arguments.output:
        _ask("Write these files?", arguments)
    unit_files.write(needed)
    if arguments.output:
        print(f"{installation.environment_file.name} belongs at {installation.environment_file},"
              f" the others in {_files(installation, None)[0].path.parent}")
        return 0
    if needed:
        unit_files.systemctl(["daemon-reload"], is_user=arguments.user)
    _say_what_is_next(installation)
    return 0


def _say_that_it_stays(file: UnitFile) -> None:
    print(f"{file.path} stays as it is")
    if file.present() != file.text:
        print(f"it differs from what would be written now:\n{file.text}")


def _say_what_is_next(installation: Installation) -> None:
    is_user = installation.run_as is None
    systemctl = "systemctl --user" if is_user else "sudo systemctl"
    print(f"start it now and with the machine: {systemctl} enable --now {installation.unit}\n"
          f"look at it: systemctl {'--user ' if is_user else ''}status {installation.unit},"
          f" journalctl {'--user ' if is_user else ''}-u {installation.unit}")
    if is_user:
        print("before anybody logs in: loginctl enable-linger\n"
              "route and receive buffers need root, at each start: scripts/setup --kernel")
    elif installation.run_as == "root":
        print("the services will run as root: --run-as names another user")


def _uninstall(installation: Installation, files: list[UnitFile],
               arguments: argparse.Namespace) -> int:
    present = [file for file in files if file.present() is not None]
    if _others(installation, files):
        present = [file for file in present if file.path.name != installation.bus_unit]
    units = [file.path.name for file in present if not file.is_users and file.is_ours()]
    if not present:
        print(f"there are no units of the system '{installation.system.name}'")
        return 0
    for file in present:
        print(f"{'remove' if file.is_ours() else 'leave'} {file.path}")
    _ask("Stop the units and remove these files?", arguments)
    if units and not unit_files.systemctl(["disable", "--now", *units], is_user=arguments.user):
        raise UserError("nothing was removed: a unit whose file is gone could not be stopped any"
                        " more: stop it, then try again")
    for path in unit_files.remove(present):
        print(f"{path} is not as `deixis install-units` wrote it: left")
    unit_files.systemctl(["daemon-reload"], is_user=arguments.user)
    return 0


def _others(installation: Installation, files: list[UnitFile]) -> bool:
    """Whether there are units of another system, which needs the bus, too."""
    ours = (installation.unit, installation.bus_unit)
    return any(path.name not in ours for path in files[0].path.parent.glob("deixis*.service"))


def _ask(question: str, arguments: argparse.Namespace) -> None:
    if arguments.yes:
        return
    if not sys.stdin.isatty():
        raise UserError("nothing was changed: there is nobody to ask: give --yes, or --output DIR"
                        " to look at the files")
    if not is_wanted(question):
        raise UserError("nothing was changed")
