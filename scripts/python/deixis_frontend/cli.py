"""The command line: one table of commands, each a module with add_arguments and run."""

from __future__ import annotations

import argparse
import importlib
import sys
import warnings
from dataclasses import dataclass
from types import ModuleType

from deixis_frontend import __version__, interrupts, standard_output
from deixis_frontend.bus import missing_module
from deixis_frontend.errors import UserError
from deixis_frontend.printable import printable


@dataclass(frozen=True)
class Command:
    """A module that offers add_arguments(parser) and run(arguments) -> int, and what it does."""

    module: str
    summary: str


_PACKAGE = "deixis_frontend.commands"
_DEFAULT_BUS = "$LCM_DEFAULT_URL, else LCM's own default"
COMMANDS: dict[str, Command] = {
    "start": Command(f"{_PACKAGE}.start", "start services and wait until they are ready"),
    "stop": Command(f"{_PACKAGE}.stop", "stop services"),
    "restart": Command(f"{_PACKAGE}.restart", "stop services and start them again"),
    "status": Command(f"{_PACKAGE}.status", "show how the services are doing"),
    "log": Command(f"{_PACKAGE}.log", "show what the services wrote"),
    "demo": Command(f"{_PACKAGE}.demo", "play a clip through all services, say what is pointed at"),
    "record": Command(f"{_PACKAGE}.record", "write the messages on the bus to a log file"),
    "replay": Command(f"{_PACKAGE}.replay", "publish the messages of a log file"),
    "echo": Command(f"{_PACKAGE}.echo", "print messages, live or of a log"),
    "hz": Command(f"{_PACKAGE}.hz", "measure rates, intervals and lost messages"),
    "delay": Command(f"{_PACKAGE}.delay", "measure how old messages are when they arrive"),
    "topics": Command(f"{_PACKAGE}.topics", "list channels, their types, who speaks and listens"),
    "doctor": Command(f"{_PACKAGE}.doctor", "look for what keeps messages from arriving"),
    "spy": Command(f"{_PACKAGE}.spy", "watch messages, pictures and people in windows (lcm-spy)"),
    "run-offline": Command(f"{_PACKAGE}.run_offline", "log in, services, log out, without a bus"),
    "export": Command(f"{_PACKAGE}.export", "turn a log into an MCAP file, for Foxglove"),
    "install-units": Command(f"{_PACKAGE}.install_units", "start with the machine, by systemd"),
    "procman": Command(f"{_PACKAGE}.procman", "write the services as a procman sheriff reads them"),
    "calibrate": Command(f"{_PACKAGE}.calibrate", "lenses and stereo from pictures of a board"),
    "evaluate": Command(f"{_PACKAGE}.evaluate", "measure results against recordings with truth"),
    "body": Command(f"{_PACKAGE}.body", "a person's sizes and joint limits; picture, URDF, mesh"),
    "train-gestures": Command("deixis_frontend.training.gestures", "learn gesture models"),
    "train-hands": Command("deixis_frontend.training.hands", "learn what hands look like"),
    "train-body": Command("deixis_frontend.training.body", "learn joints and surfaces of clothed people"),
}


def main(argv: list[str]) -> int:
    """Runs one command; returns the exit code: 0 done, 1 not done, 2 wrong usage."""
    return standard_output.checked(lambda: _run(argv))


def _run(argv: list[str]) -> int:
    warnings.showwarning = _show_warning
    try:
        arguments = _parser(argv).parse_args(argv)
        interrupts.raise_on_ctrl_c()
        return int(arguments.run(arguments))
    except UserError as error:
        for line in str(error).splitlines():
            print(f"deixis: {printable(line)}", file=sys.stderr)
        return 1
    except ModuleNotFoundError as error:
        if error.name is None or not (missing := missing_module(error.name)):
            raise
        print(f"deixis: {missing}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        interrupts.end_at_once()  # A second Ctrl-C, while Python ends, is not told either.
        return interrupts.INTERRUPTED


def add_url(parser: argparse.ArgumentParser, otherwise: str) -> None:
    """The option that every command has; `otherwise` says which bus is used without it."""
    parser.add_argument("-l", "--lcm-url", metavar="URL", help=f"bus to use; else {otherwise}")


def add_commands(parser: argparse.ArgumentParser, commands: dict[str, Command], argv: list[str],
                 metavar: str) -> None:
    """One sub-parser per command. Only the chosen one's module is loaded, which saves time."""
    choices = parser.add_subparsers(metavar=metavar, required=True)
    chosen = next((word for word in argv if word in commands), None)
    for name, command in commands.items():
        child = choices.add_parser(name, help=command.summary, description=command.summary + ".")
        if name == chosen:
            module = importlib.import_module(command.module)
            _complete(child, module, argv[argv.index(name) + 1:])


def _complete(parser: argparse.ArgumentParser, module: ModuleType, argv: list[str]) -> None:
    """Adds what the module of the chosen command asks for: arguments, or a table of its own."""
    if hasattr(module, "SUBCOMMANDS"):
        add_commands(parser, module.SUBCOMMANDS, argv, "what")
    else:
        add_url(parser, getattr(module, "DEFAULT_BUS", _DEFAULT_BUS))
        module.add_arguments(parser)
        parser.set_defaults(run=module.run)


def _parser(argv: list[str]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="deixis", description="People perception for mobile robots over LCM.")
    parser.add_argument("--version", action="version", version=f"deixis {__version__}")
    add_commands(parser, COMMANDS, argv, "command")
    return parser


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    print(f"deixis: {message}", file=sys.stderr)
