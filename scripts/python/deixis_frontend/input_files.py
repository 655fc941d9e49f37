"""Files that a command reads: the one rule of what can be one."""

from __future__ import annotations

import stat
from pathlib import Path

from deixis_frontend.errors import UserError

_KINDS = {stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket",
          stat.S_IFCHR: "a device", stat.S_IFBLK: "a device"}


def require_regular(path: Path) -> None:
    """Raises UserError when `path` is there but no regular file.

    A device has no end, and a pipe may have nobody who writes: reading would wait for ever. That
    there is nothing at all is told by who opens it, with its own cure.
    """
    try:
        kind = stat.S_IFMT(path.stat().st_mode)
    except OSError:
        return
    if kind != stat.S_IFREG:
        raise UserError(f"{path} is {_KINDS.get(kind, 'something else')}: name a regular file")
