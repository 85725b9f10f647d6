"""An exported controller as a process of its own on this machine, and the line to it.

    with controller_process(source) as process:
        number = process.send(STEP, t, q, v)
        answer = process.receive(until=process.now() + 0.001)

loop.c of the export is compiled and started. It listens on 127.0.0.1, on a port that it chooses, and
has ended when the block is left, whatever happened in it.
"""

from __future__ import annotations

import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Protocol

import numpy as np

from biped_adrc.deploy.datagram import STOP, Answer, answer_of, measurement
from biped_adrc.deploy.loaded import FLAGS, compiled
from biped_adrc.deploy.source import Source
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.types import Array

HOST = "127.0.0.1"
SILENCE = 60
"""Seconds without a datagram after which the process ends by itself; walkers are compiled within them."""
FAREWELL = 1.0
"""Time in which the process has to end when it is told to [s]; then it is killed."""
LOOK = 0.1
"""Longest time without a look at whether the process is still there [s]."""
ROOM = 65536
"""Bytes of the largest datagram."""


class Channel(Protocol):
    """The line to a controller elsewhere, and the clock by which both act."""

    number: int
    """Of the datagram sent last, from 1; 0 for none."""

    def send(self, kind: int, t: float, q: Array, v: Array) -> int:
        """Send a measurement: t [s], q (n,) [rad], v (n,) [rad/s]; the number that its answer will have."""
        ...

    def receive(self, until: float) -> Answer | None:
        """The next answer; None where there is none `until` [s]. Raises SimulationError for a broken line."""
        ...

    def now(self) -> float:
        """Time by the wall [s], from any start."""
        ...

    def pause(self, until: float) -> None:
        """Wait `until` [s]; not at all where that is over."""
        ...


class ControllerProcess:
    """A running process and the socket that is connected to it; a `Channel`."""

    def __init__(self, program: subprocess.Popen[str], connection: socket.socket):
        """As `started` makes it."""
        self.running, self.line, self.number = program, connection, 0
        self.port: int = connection.getpeername()[1]

    def __repr__(self) -> str:
        return f"ControllerProcess({HOST}:{self.port}, {self.number} datagrams sent)"

    def send(self, kind: int, t: float, q: Array, v: Array) -> int:
        """As `Channel.send`. Raises SimulationError where the process has ended."""
        self.number += 1
        try:
            self.line.send(measurement(kind, self.number, t, q, v))
        except OSError as error:
            raise self._ended() from error
        return self.number

    def receive(self, until: float) -> Answer | None:
        """As `Channel.receive`."""
        while (left := until - self.now()) > 0.0:
            self.line.settimeout(min(left, LOOK))
            try:
                answer = answer_of(self.line.recv(ROOM))
            except TimeoutError:
                if self.running.poll() is not None:
                    raise self._ended() from None
                continue
            except OSError as error:
                raise self._ended() from error
            if answer is not None:
                return answer
        return None

    def now(self) -> float:
        return time.monotonic()

    def pause(self, until: float) -> None:
        if (left := until - self.now()) > 0.0:
            time.sleep(left)

    def _ended(self) -> SimulationError:
        """What is to be said of a process that does not answer any more."""
        with suppress(subprocess.TimeoutExpired):
            self.running.wait(FAREWELL)
        code, said = self.running.poll(), ""
        if code is not None and self.running.stderr is not None:
            said = self.running.stderr.read().strip()
        return SimulationError(
            f"the controller's process has ended (exit code {code}{f', {said}' if said else ''}) before the "
            "walk has; walk again, and look at what else ends processes here"
        )


@contextmanager
def controller_process(
    source: Source, port: int = 0, silence: int = SILENCE
) -> Iterator[ControllerProcess]:
    """Compile loop.c of an export, start it, and end it where the block is left.

    port: on 127.0.0.1, 0 for one that is free. silence: seconds without a datagram after which it ends by
    itself. Raises InputError where there is no compiler, it refuses, or the port is taken.
    """
    with tempfile.TemporaryDirectory() as name:
        program = built(source, Path(name))
        with started([str(program), str(port), str(silence)], source.n) as process:
            yield process


def built(source: Source, folder: Path, flags: Sequence[str] = FLAGS) -> Path:
    """The program of loop.c, compiled into a folder. Raises InputError."""
    for file, text in source.files.items():
        (folder / file).write_text(text)
    compiled(folder, ["loop.c", f"{source.prefix}.c"], folder / "loop", flags)
    return folder / "loop"


@contextmanager
def started(words: Sequence[str], n: int) -> Iterator[ControllerProcess]:
    """The process of a command line that prints its port, ended where the block is left.

    n: coordinates. It has a session of its own, so that Ctrl-C comes here alone and both end in order.
    Raises InputError where it does not listen.
    """
    pipe = subprocess.PIPE
    running = subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, start_new_session=True)
    with running, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as line:
        try:
            line.connect((HOST, _port(running)))
            process = ControllerProcess(running, line)
            yield process
            with suppress(SimulationError, subprocess.TimeoutExpired):
                process.send(STOP, 0.0, np.zeros(n), np.zeros(n))
                running.wait(FAREWELL)
        finally:
            running.kill()


def _port(running: subprocess.Popen[str]) -> int:
    """The port that a process prints. Raises InputError for one that prints none."""
    assert running.stdout is not None
    assert running.stderr is not None
    said = running.stdout.readline().strip()
    if not said.isdecimal():
        raise InputError(
            f"the controller's process does not listen on {HOST}: {running.stderr.read().strip() or said}; "
            "choose another port, or 0 for any that is free"
        )
    return int(said)
