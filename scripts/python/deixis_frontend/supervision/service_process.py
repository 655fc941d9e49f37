"""One run of a service's program: spawned, its output read, its end seen, stopped for sure."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

from deixis_frontend.printable import printable
from deixis_frontend.programs import last_words

_CHUNK_BYTES = 65536
_TAIL_BYTES = 4096


class ServiceProcess:
    """A running program in a session of its own, so that its children are reached too."""

    def __init__(self, command: list[str], environment: dict[str, str], folder: Path,
                 on_output: Callable[[bytes], None]) -> None:
        self._on_output = on_output
        self._error_tail = b""
        self._popen = subprocess.Popen(
            command, env=environment, cwd=folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self._loop = asyncio.get_running_loop()
        self._exit: asyncio.Future[int] = self._loop.create_future()
        self._open_pipes = self._watch_pipes()
        self._pid_descriptor = os.pidfd_open(self._popen.pid)
        self._loop.add_reader(self._pid_descriptor, self._reap)

    @property
    def pid(self) -> int:
        """Process id; also the id of its session and group."""
        return self._popen.pid

    @property
    def last_error_line(self) -> str:
        """The last line with text that the program wrote to stderr; printable."""
        return printable(last_words(self._error_tail.decode(errors="replace")))

    def owns(self, pid: int) -> bool:
        """True when `pid` is the program or a child of it that stayed in its session."""
        try:
            return pid == self.pid or os.getsid(pid) == self.pid
        except (ProcessLookupError, PermissionError):
            return False

    async def wait(self) -> int:
        """The exit code; negative for a signal. May be awaited by several."""
        return await asyncio.shield(self._exit)

    async def stop(self, within_s: float) -> None:
        """Asks the group to end, kills it when it takes longer than within_s."""
        self.signal_group(signal.SIGTERM)
        try:
            await asyncio.wait_for(self.wait(), within_s)
        except TimeoutError:
            self._on_output(f"-- did not stop within {within_s:g} s: killed\n".encode())
            self.signal_group(signal.SIGKILL)
            await self.wait()

    def signal_group(self, number: signal.Signals) -> None:
        """Sends a signal to the program and its children."""
        try:
            os.killpg(self.pid, number)
        except (ProcessLookupError, PermissionError):
            return  # The whole group has ended already.

    def _watch_pipes(self) -> list[int]:
        assert self._popen.stdout is not None and self._popen.stderr is not None
        pipes = [self._popen.stdout.fileno(), self._popen.stderr.fileno()]
        for pipe in pipes:
            os.set_blocking(pipe, False)
            self._loop.add_reader(pipe, self._read, pipe)
        return pipes

    def _read(self, pipe: int) -> bool:
        try:
            data = os.read(pipe, _CHUNK_BYTES)
        except BlockingIOError:
            return False
        if not data:
            self._close_pipe(pipe)
            return False
        if self._popen.stderr is not None and pipe == self._popen.stderr.fileno():
            self._error_tail = (self._error_tail + data)[-_TAIL_BYTES:]
        self._on_output(data)
        return True

    def _close_pipe(self, pipe: int) -> None:
        if pipe in self._open_pipes:
            self._loop.remove_reader(pipe)
            self._open_pipes.remove(pipe)

    def _reap(self) -> None:
        self._loop.remove_reader(self._pid_descriptor)
        os.close(self._pid_descriptor)
        exit_code = self._popen.wait()
        self.signal_group(signal.SIGKILL)  # Children do not outlive their service.
        self._drain()
        self._exit.set_result(exit_code)

    def _drain(self) -> None:
        for pipe in list(self._open_pipes):
            while self._read(pipe):
                continue
            self._close_pipe(pipe)
        for stream in (self._popen.stdout, self._popen.stderr):
            if stream is not None:
                stream.close()
