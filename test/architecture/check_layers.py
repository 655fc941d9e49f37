#!/usr/bin/env python3
"""Checks that the layers of Deixis stay apart.

    test/architecture/check_layers.py [ROOT]      default: the repository that this file is in

A core (services/*/core) knows no bus: no LCM, generated, YAML or log header, nothing of the parts of
common/ that deal with them. common/ names no service. A service includes no other one, `offline` apart.
The top level holds the agreed entries, no folder is a catch-all, every folder that people look into
first has a README.md. Prints a line per fault; exit code 1 when there are any.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

TOP_LEVEL = {
    "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "CHANGELOG.md",
    "lcmtypes", "common", "services", "config", "scripts", "test",
}
NOT_IN_THE_REPOSITORY = {"build", "logs", "output"}
CATCH_ALL_FOLDERS = {"utils", "util", "misc", "helpers", "helper", "manager"}
CATCH_ALL_FILES = {"common.h", "common.hpp", "utils.h", "helpers.h"}
KNOWS_ALL_SERVICES = "offline"
SOURCE_SUFFIXES = {".h", ".hpp", ".cpp", ".cc"}

# Headers that a core must not see, and why.
FORBIDDEN_IN_CORES = [
    (re.compile(r"lcm/"), "LCM"),
    (re.compile(r"(lcmtypes|lcmtypes_cpp)/|(deixis|bot_core|kinect)/\w+_t\.hpp|message_types\.hpp"
                r"|(geometry|sensor|std|tf2)_msgs/"),
     "a generated message type"),
    (re.compile(r"yaml-cpp/"), "yaml-cpp: common/config reads files"),
    (re.compile(r"spdlog/"), "a log: return what happened, the service decides what to say"),
    (re.compile(r"common/(transport|messages|logging|dimos|program)/"), "a part of common/ about the bus"),
]
_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def check(root: Path) -> list[str]:
    """All faults of the tree, a line each."""
    services = {path.name for path in (root / "services").iterdir() if path.is_dir()}
    return sorted([
        *_cores(root), *_common(root, services), *_services(root, services),
        *_top_level(root), *_catch_alls(root), *_readmes(root),
    ])


def _cores(root: Path) -> Iterator[str]:
    for core in sorted((root / "services").glob("*/core")):
        for source, header in _includes(core):
            for pattern, what in FORBIDDEN_IN_CORES:
                if pattern.match(header):
                    yield f"{source.relative_to(root)}: a core includes {header}: {what}"


def _common(root: Path, services: set[str]) -> Iterator[str]:
    # `offline` is left out: it is an everyday word.
    words = "|".join(sorted(map(re.escape, services - {KNOWS_ALL_SERVICES})))
    names = re.compile(rf"\b({words})\b")
    for source in _sources(root / "common"):
        for number, line in enumerate(_text(source).splitlines(), start=1):
            found = names.search(line) if words else None
            if found:
                yield (f"{source.relative_to(root)}:{number}: common/ names the service"
                       f" {found.group(1)}: what one service needs belongs to it")


def _services(root: Path, services: set[str]) -> Iterator[str]:
    for service in sorted(services - {KNOWS_ALL_SERVICES}):
        for source, header in _includes(root / "services" / service):
            other = re.match(r"services/(\w+)/", header)
            if other and other.group(1) != service:
                yield (f"{source.relative_to(root)}: a service includes {header} of another one:"
                       " what two need belongs to common/")


def _top_level(root: Path) -> Iterator[str]:
    for name in sorted({path.relative_to(root).parts[0] for path in _entries(root)}):
        if name not in TOP_LEVEL | NOT_IN_THE_REPOSITORY and not name.startswith("."):
            yield f"{name}: not one of the entries that the top level may hold"


def _catch_alls(root: Path) -> Iterator[str]:
    for path in sorted(_entries(root)):
        catches = CATCH_ALL_FOLDERS if path.is_dir() else CATCH_ALL_FILES
        if path.name.lower() in catches and path.relative_to(root).parts[0] in TOP_LEVEL:
            yield f"{path.relative_to(root)}: the name tells nothing: say what it holds"


def _entries(root: Path) -> set[Path]:
    """All files and their folders: those that git tracks, in a folder without git those there are."""
    files = _tracked(root)
    if files is None:
        tops = [top for top in root.iterdir()
                if top.name not in NOT_IN_THE_REPOSITORY and not top.name.startswith(".")]
        return {path for top in tops for path in (top, *top.rglob("*"))}
    folders = {folder for file in files for folder in file.parents if folder.is_relative_to(root)}
    return {*files, *folders} - {root}


def _tracked(root: Path) -> list[Path] | None:
    if not (root / ".git").exists() or shutil.which("git") is None:
        return None
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True,
                            text=True, check=False)
    return [root / name for name in listed.stdout.split("\0") if name] if listed.stdout else None


def _readmes(root: Path) -> Iterator[str]:
    top = [root / name for name in sorted(TOP_LEVEL) if (root / name).is_dir()]
    inner = [path for part in ("services", "common") for path in sorted((root / part).iterdir())]
    for folder in [root, *top, *inner]:
        if folder.is_dir() and not (folder / "README.md").is_file():
            yield f"{folder.relative_to(root)}: no README.md"


def _includes(folder: Path) -> Iterator[tuple[Path, str]]:
    for source in _sources(folder):
        for header in _INCLUDE.findall(_text(source)):
            yield source, header


def _sources(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")):
        if path.suffix in SOURCE_SUFFIXES and path.is_file():
            yield path


def _text(source: Path) -> str:
    return source.read_text(encoding="utf-8", errors="replace")


def main() -> int:
    """Prints the faults; 1 when there are any."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    faults = check(root)
    for fault in faults:
        print(fault)
    print(f"layers: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
