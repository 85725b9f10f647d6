"""Commands run by forks of one process that has imported the package already: it imports once, not per command.

As a script, this file is that process; `Preloaded` starts it and asks it for commands. It imports, and loads
the compiled loops: it computes nothing and starts no thread, so that each fork is what a fresh interpreter is
after its imports.
"""

from __future__ import annotations

import gc
import importlib
import json
import multiprocessing.process
import os
import pkgutil
import runpy
import signal
import subprocess
import sys
import warnings
from pathlib import Path
from typing import NamedTuple

THREADS = "OPENBLAS_NUM_THREADS"
"""One while importing, as OpenBLAS starts its threads when it is loaded; a command is told nothing of it."""

IMPORTED_LATE = ("matplotlib.pyplot", "matplotlib.backends.backend_svg", "qpsolvers")
"""What commands import inside of functions."""

ERRORS = ("error", None, Warning, None, 0)
"""The filter that `-W error` puts in front of the interpreter's own."""


class Ended(NamedTuple):
    """How a command ended: its exit code (a signal's number below 0), and what it wrote."""

    code: int
    stderr: str
    stdout: str


class Preloaded:
    """The process, started with the first command and started anew should it end."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None

    def run(
        self, script: Path, arguments: list[str], folder: Path, strict: bool, timeout: int = 300
    ) -> Ended:
        """Run a script in `folder`; strict: every warning is an error. Killed after `timeout` seconds."""
        process = self._started()
        request = {
            "script": str(script),
            "arguments": arguments,
            "folder": str(folder),
            "strict": strict,
            "timeout": timeout,
            "environment": dict(os.environ),
            "stderr": str(folder / ".stderr"),
            "stdout": str(folder / ".stdout"),
        }
        process.stdin.write(json.dumps(request) + "\n")
        process.stdin.flush()
        answer = process.stdout.readline()
        assert answer, f"the preloaded process ended with {process.wait(60)}"
        texts = []
        for name in ("stderr", "stdout"):
            written = Path(request[name])
            texts.append(written.read_text(errors="replace"))
            written.unlink()
        return Ended(json.loads(answer), *texts)

    def close(self) -> None:
        if self._process is not None:
            self._process.terminate()
            self._process.stdin.close()
            self._process.wait(60)
            self._process.stdout.close()
            self._process = None

    def _started(self) -> subprocess.Popen[str]:
        if self._process is not None and self._process.poll() is not None:
            self.close()
        if self._process is None:
            self._process = subprocess.Popen(
                [sys.executable, "-W", "error", __file__],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                env={**os.environ, THREADS: "1"},
            )
        return self._process


def preload() -> None:
    """Import every module of the package, and what its functions import."""
    package = importlib.import_module("biped_adrc")
    for module in pkgutil.walk_packages(package.__path__, "biped_adrc."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    for name in IMPORTED_LATE:
        importlib.import_module(name)
    importlib.import_module("biped_adrc.engine.kernels.load").kernels()
    gc.freeze()  # nothing imported is garbage, and a fork that looks copies every page
    threads = len(os.listdir("/proc/self/task")) if os.path.isdir("/proc/self/task") else 1
    assert threads == 1, f"the imports have started {threads - 1} threads, which no fork has"


def serve() -> None:
    """Fork for every line of stdin, and answer with the exit code."""
    preload()
    for line in sys.stdin:
        request = json.loads(line)
        child = os.fork()
        if child == 0:
            become(request)
            run_script(request)
            return
        print(outcome(child, request["timeout"]), flush=True)


def outcome(child: int, timeout: int) -> int:
    """The exit code of a child, which is killed with all of its own after `timeout` seconds."""

    def kill(number: int, frame: object) -> None:
        os.killpg(child, signal.SIGKILL)
        if number != signal.SIGALRM:
            sys.exit(128 + number)

    for number in (signal.SIGALRM, signal.SIGINT, signal.SIGTERM):
        signal.signal(number, kill)
    signal.alarm(timeout)
    _, status = os.waitpid(child, 0)
    signal.alarm(0)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    return os.waitstatus_to_exitcode(status)


def become(request: dict) -> None:
    """Take on what a fresh process would have: its folder, environment, files, path and warnings."""
    os.setsid()
    os.chdir(request["folder"])
    os.environ.clear()
    os.environ.update(request["environment"])
    new = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    written = (os.open(request[name], new, 0o600) for name in ("stdout", "stderr"))
    for number, file in enumerate((os.open(os.devnull, os.O_RDONLY), *written)):
        os.dup2(file, number)
    multiprocessing.process.ORIGINAL_DIR = request["folder"]
    sys.argv = [request["script"], *request["arguments"]]
    sys.path[0] = os.path.dirname(os.path.abspath(request["script"]))
    if not request["strict"]:
        sys.warnoptions.remove("error")
        warnings.filters.remove(ERRORS)


def run_script(request: dict) -> None:
    """The script as __main__; what it raises ends the interpreter as it would otherwise."""
    script = Path(request["folder"], request["script"])
    if not script.is_file():
        sys.exit(f"can't open file '{script}'")
    runpy.run_path(str(script), run_name="__main__")


if __name__ == "__main__":
    serve()
