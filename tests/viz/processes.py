"""Commands that serve pages, as processes of their own, and what the operating system says of them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
import urllib.request
from queue import Empty, Queue

import psutil
import pytest

SOON = 60.0
"""[s] within which a session, which would go on for ever, says something or ends."""
PACE = re.compile(r"this walk did not keep up with the clock: [\d.]+ of the pace asked for ?")
COMMAND = (sys.executable, "-m", "biped_adrc.cli")


class Live:
    """A command that serves a page, such as `biped-adrc play`, as a process of its own."""

    def __init__(self, *words: str, **environment: str) -> None:
        self.process = subprocess.Popen(
            [*COMMAND, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=os.environ | environment,
        )
        self.lines: Queue[str] = Queue()
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        self.url = self.line().split()[0]
        self.port = int(self.url.rstrip("/").rsplit(":", 1)[1])

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.put(line)

    def line(self, timeout: float = SOON) -> str:
        try:
            return self.lines.get(timeout=timeout)
        except Empty:
            pytest.fail("the session said nothing")

    def ends(self, timeout: float = SOON) -> tuple[int, str]:
        """Exit code, and what was said since; but for a sentence that a busy computer is too slow."""
        code = self.process.wait(timeout)
        self.reader.join(SOON)
        rest = []
        while not self.lines.empty():
            rest.append(self.lines.get())
        return code, PACE.sub("", " ".join("".join(rest).split()))

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.reader.join(SOON)
        assert self.process.stdout is not None
        self.process.stdout.close()


def listening(process: int) -> list[tuple[str, int]]:
    """Sockets the operating system lists for the process and its children."""
    parent = psutil.Process(process)
    connections = [
        c for p in (parent, *parent.children(recursive=True)) for c in p.net_connections("inet")
    ]
    return [(c.laddr.ip, c.laddr.port) for c in connections if c.status == psutil.CONN_LISTEN]


def get(url: str, host: str | None = None) -> str:
    request = urllib.request.Request(url, headers={} if host is None else {"Host": host})
    with urllib.request.urlopen(request, timeout=10) as answer:
        return str(answer.read().decode("utf-8"))
