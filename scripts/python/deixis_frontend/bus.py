"""Opening LCM from Python, with errors that name the cure."""

from __future__ import annotations

from typing import Any

from deixis_frontend.errors import UserError
from deixis_frontend.lcm_url import LcmUrl, require_bus


def open_bus(url: LcmUrl) -> Any:
    """An `lcm.LCM` on `url` with a receive buffer that pictures fit into."""
    require_bus(url)
    lcm = import_lcm()
    try:
        return lcm.LCM(str(url.with_receive_buffer()))
    except RuntimeError as error:
        raise UserError(f"cannot open LCM on '{url}' ({error}):"
                        " choose another URL with -l") from None


def import_lcm() -> Any:
    """The module `lcm`; raises UserError when this Python lacks it."""
    try:
        import lcm
    except ImportError:
        raise UserError(missing_module("lcm")) from None
    return lcm


def missing_module(name: str) -> str:
    """What to say when this Python lacks a module that the front end needs."""
    return (f"this Python lacks the module '{name}': run scripts/setup in a checkout, or"
            " `pip install lcm numpy PyYAML` and name that Python in DEIXIS_PYTHON")
