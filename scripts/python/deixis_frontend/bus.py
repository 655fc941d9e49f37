"""Opening LCM from Python, with errors that name the cure."""

from __future__ import annotations

from typing import Any

from deixis_frontend.errors import UserError
from deixis_frontend.lcm_url import LcmUrl, require_bus

# Modules that the front end imports -> what pip calls those that they come with.
_PACKAGES = {
    ("lcm", "numpy", "yaml"): "lcm numpy PyYAML",
    ("mcap", "mcap_protobuf", "foxglove_schemas_protobuf", "google"):
        "mcap mcap-protobuf-support foxglove-schemas-protobuf",
}


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
    """What to say when this Python lacks a module; empty when the front end does not need it."""
    top = name.partition(".")[0]
    for modules, packages in _PACKAGES.items():
        if top in modules:
            return (f"this Python lacks the module '{top}': run scripts/setup in a checkout, or"
                    f" `pip install {packages}` and name that Python in DEIXIS_PYTHON")
    return ""
