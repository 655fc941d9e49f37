"""Java and the jars that lcm-spy is started with."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
from pathlib import Path

from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout

_SYSTEM_FOLDERS = (Path("/usr/share/java"), Path("/usr/local/share/java"))
_MEMORY = "-Xmx512m"  # LCM's 128 MB are too few for several windows with large pictures.


def find_java(cure: str) -> str:
    """Path of the Java runtime: that of JAVA_HOME, else the first of PATH."""
    home = os.environ.get("JAVA_HOME")
    path = shutil.which("java", path=str(Path(home) / "bin")) if home else None
    path = path or shutil.which("java")
    if path is None:
        raise UserError(f"java not found: {cure}")
    return path


def own_jars(layout: Layout) -> list[Path]:
    """Our windows for lcm-spy, and our message types."""
    return [layout.jar("deixis_spy.jar"), layout.jar("deixis_types.jar")]


def lcm_jars() -> list[Path]:
    """LCM's jar and what it draws charts with: of the Python package `lcm`, else Debian's."""
    for folder in (*_folder_of_python_package(), *_SYSTEM_FOLDERS):
        charts = sorted(folder.glob("jchart2d*.jar"))
        if (folder / "lcm.jar").is_file() and charts:
            return [folder / "lcm.jar", charts[0], *_needed_by_charts(folder)]
    raise UserError("lcm-spy not found (lcm.jar and jchart2d.jar): run scripts/setup in a checkout,"
                    " `pip install lcm`, or install the packages liblcm-java and libjchart2d-java")


def virtual_machine_options() -> list[str]:
    """What the Java runtime is told; LCM_JVM_OPT replaces the memory limit, as for lcm-spy."""
    given = os.environ.get("LCM_JVM_OPT")
    try:
        chosen = shlex.split(given) if given else [_MEMORY]
    except ValueError as error:
        raise UserError(f"LCM_JVM_OPT={given}: {error}: write options as in a shell") from None
    return ["-Djava.net.preferIPv4Stack=true", *chosen]


def _folder_of_python_package() -> list[Path]:
    found = importlib.util.find_spec("lcm")
    if found is None or found.origin is None:
        return []
    return [Path(found.origin).resolve().parents[1] / "share" / "java"]


def _needed_by_charts(folder: Path) -> list[Path]:
    return [jar for name in ("xmlgraphics-commons", "jide-oss")
            for jar in sorted(folder.glob(f"{name}*.jar"))[:1]]
