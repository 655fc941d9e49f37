"""LCM's own logger, and what a log file is."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from deixis_frontend.errors import UserError
from deixis_frontend.input_files import require_regular
from deixis_frontend.lcm_url import LcmUrl
from deixis_lcm.log_events import SYNC


def find_logger() -> str:
    """Path of lcm-logger, of the system or of this Python."""
    name = "lcm-logger"
    path = shutil.which(name) or shutil.which(name, path=str(Path(sys.executable).parent))
    if path is None:
        raise UserError(f"{name} not found: run scripts/setup, or install the package liblcm-bin")
    return path


def url_option(url: LcmUrl) -> str:
    """The option for lcm-logger. `-l URL` is broken in 1.3.1; this form works."""
    return f"--lcm-url={url.with_receive_buffer()}"


def require_log(path: Path) -> None:
    """Raises UserError when `path` is no LCM log file."""
    require_regular(path)
    try:
        with path.open("rb") as file:
            begin = file.read(len(SYNC))
    except OSError as error:
        raise UserError(f"{path}: {error.strerror}:"
                        " name a log that `deixis record` wrote") from None
    if not begin:
        raise UserError(f"{path} is empty: nothing was recorded")
    if begin != SYNC:
        raise UserError(f"{path} is no LCM log: name a file that `deixis record` wrote")
