"""What happened, in words: states of services and gestures."""

from __future__ import annotations

from typing import Any

from deixis import service_status_t
from foxglove_schemas_protobuf.Log_pb2 import Log

from deixis_frontend.export import names
from deixis_frontend.export.drawing import stamp
from deixis_frontend.service_facts import state_name


def status(message: Any) -> Log:
    """State and text of a service_status_t."""
    state = state_name(message.state)
    is_degraded = message.state == service_status_t.DEGRADED
    return Log(timestamp=stamp(message.utime), name=service(message),
               level=Log.WARNING if is_degraded else Log.INFO,
               message=f"{state}: {message.text}" if message.text else state)


def service(message: Any) -> str:
    """Name of the service, with its instance where it has one."""
    return f"{message.service}/{message.instance}" if message.instance else message.service


def gesture(message: Any) -> Log:
    """Who points at what, when it is decided and when it ends."""
    who = f"person {message.person_id}" if message.person_id >= 0 else "somebody"
    words = f"{who}, {names.side(message.side)}: {names.gesture(message)}"
    certain = f" ({message.candidates[0].probability:.2f})" if message.candidates else ""
    return Log(timestamp=stamp(message.utime), name=f"gesture {message.event_id}", level=Log.INFO,
               message=f"{words}: ended" if message.end_utime else words + certain)
