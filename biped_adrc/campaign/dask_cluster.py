"""The workers of an existing Dask cluster, reached by the address of its scheduler (the extra `[cluster]`).

Results must not depend on where a run was made. Each worker is therefore asked for the versions of all that
decides the numbers, once when the study starts and again with every chunk: a worker that joins late, with
another NumPy, cannot spoil a study. Dask replaces workers that die by itself; what it gives up is run again by
`campaign.execute`, as for processes.

A `Cluster` is handed to `sweep` in place of a number of processes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, ParamSpec, TypeVar, cast

from biped_adrc.campaign.workers import Workers, WorkersError
from biped_adrc.errors import InputError
from biped_adrc.types import DaskClient, DaskFuture
from biped_adrc.versions import differences, numerical_versions

TIMEOUT = 10.0
"""Time for a scheduler to answer, and for its first worker to appear [s]."""
PATIENT = 6
"""Timeouts without any result and without any worker, after which a study ends; Dask replaces them sooner."""

P = ParamSpec("P")
"""Arguments of what is submitted."""
T = TypeVar("T")
"""What is returned from a worker."""
Versions = Mapping[str, str]
"""Version by package name, as `versions.numerical_versions` gives them."""

PRINTED = "tcp://host:8786, which 'dask scheduler' prints when it starts"
"""An example of an address, for errors."""
ADDRESS = re.compile(r"(?:(?:tcp|tls)://)?(?:\[[0-9a-fA-F:.]+\]|[\w.-]+):([0-9]{1,5})")
"""An address: protocol (optional), host or bracketed IPv6 address, and port."""


@dataclass(frozen=True)
class Cluster(Workers):
    """The workers of a Dask scheduler. address: such as tcp://host:8786; timeout: for its answer [s]."""

    address: str
    timeout: float = TIMEOUT
    elsewhere: ClassVar[bool] = True

    def prepare(self) -> None:
        """Connect once and leave. Raises InputError as `start`."""
        self.stop(self.start(), True)

    def start(self) -> Executor:
        """Connect and check all workers.

        Raises InputError for what is no address, when no scheduler answers, it has no workers, or some of them
        have other versions.
        """
        client = _client(self.address, self.timeout)
        try:
            _check_workers(client, self.address, self.timeout)
        except BaseException:
            client.close(timeout=1)
            raise
        return _Checked(client, numerical_versions())

    def count(self, executor: Executor) -> int:
        """Threads of all workers."""
        return max(1, sum(_client_of(executor).nthreads().values()))

    def stop(self, executor: Executor, now: bool) -> None:
        """Close the connection, which gives up what has not ended; the cluster itself goes on."""
        _client_of(executor).close(timeout=2)

    def restart(self, executor: Executor) -> Executor:
        """The same executor: the scheduler replaces workers that died."""
        return executor

    def broken(self, error: BaseException) -> bool:
        """Also what Dask says of a task that has killed several workers."""
        from distributed import KilledWorker

        return super().broken(error) or isinstance(error, KilledWorker)

    def check(self, executor: Executor, idle: float) -> None:
        """Raises WorkersError where the connection to the scheduler is closed, and where nothing has ended for
        longer than `PATIENT` timeouts and no worker is left.
        """
        client = _client_of(executor)
        comm = client.scheduler_comm
        if client.status != "running" or comm is None or comm.comm.closed():
            raise WorkersError(
                f"the scheduler at {self.address} has gone away; what was finished is kept. Start the cluster "
                "again, and then the study: it goes on from there"
            )
        if idle > PATIENT * self.timeout and not client.nthreads():
            raise WorkersError(
                f"the scheduler at {self.address} has had no worker for {idle:.0f} s; what was finished is "
                f"kept. Start some with 'dask worker {self.address}', then the study: it goes on from there"
            )


def _client_of(executor: Executor) -> DaskClient:
    """The client of an executor that `Cluster.start` made."""
    return cast("_Checked", executor).client


def _check_workers(client: DaskClient, address: str, timeout: float) -> None:
    """Raises InputError where there is no worker after `timeout` [s], or one has other versions."""
    try:
        client.wait_for_workers(1, timeout=timeout)
    except TimeoutError as error:
        raise InputError(
            f"the scheduler at {address} has no workers after {timeout:g} s; start some with "
            f"'dask worker {address}'"
        ) from error
    for worker, found in client.run(_asked()).items():
        text = difference(found, numerical_versions())
        if text:
            raise InputError(_refusal(f"worker {worker} of the scheduler at {address}", text))


def difference(found: Versions | str, expected: Versions) -> str:
    """Which versions differ, in words; empty when none does. A text in place of `found` is what went wrong
    there.
    """
    return found if isinstance(found, str) else differences(found, expected)


def _refusal(who: str, text: str) -> str:
    """The sentence for a worker with other versions."""
    return (
        f"{who} would give other numbers: {text}. Give all workers the versions of this machine, or run the "
        "study where they are"
    )


def _client(address: str, timeout: float) -> DaskClient:
    """A connection to the scheduler. Raises InputError without Dask, for no address, or without an answer."""
    try:
        from distributed import Client as connect
    except ImportError as error:
        raise InputError(
            "a study on a Dask cluster needs Dask, which is not installed; pip install 'biped-adrc[cluster]'"
        ) from error
    match = ADDRESS.fullmatch(address)
    if match is None or not 0 < int(match[1]) < 2**16:
        raise InputError(
            f"the address of the Dask scheduler is '{address}', expected one such as {PRINTED}"
        )
    client: DaskClient = connect.__new__(connect)
    try:
        client.__init__(address, timeout=timeout, set_as_default=False)
    except (OSError, ValueError, TypeError, TimeoutError, ImportError) as error:
        _let_go(client)
        raise InputError(
            f"no Dask scheduler answers at '{address}' within {timeout:g} s ({type(error).__name__}: {error}); "
            f"expected an address such as {PRINTED}"
        ) from error
    return client


def _let_go(client: DaskClient) -> None:
    """End a connection that its constructor left half made.

    As garbage it would be closed some time later; while another one starts that waits for Dask's lock for ever.
    """
    client.status = "closed"
    if (runner := getattr(client, "_loop_runner", None)) is not None:
        runner.stop()


def _asked() -> Callable[[], Versions | str]:
    """A function that also workers without this package can run: Dask sends a nested function by value."""

    def versions() -> Versions | str:
        try:
            from biped_adrc.versions import numerical_versions
        except ImportError as error:
            return f"biped-adrc cannot be imported there ({error})"
        return dict(numerical_versions())

    return versions


def _run(expected: Versions, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Runs on the worker: function(*args) if the versions there are the expected ones. Raises InputError."""
    text = difference(numerical_versions(), expected)
    if text:
        raise InputError(_refusal("a worker of the cluster", text))
    return function(*args, **kwargs)


@dataclass(frozen=True)
class _Checked(Executor):
    """Dask's client as an executor, which lets each worker look at its versions before it runs anything.

    Dask's own executor takes a result and the state of its task one after the other; a worker that dies between
    the two leaves a future that never ends. Here one call gives either the result or an error.
    """

    client: DaskClient
    versions: Versions

    def submit(self, function: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        checked: Callable[..., T] = partial(_run, dict(self.versions), function)
        there = self.client.submit(checked, *args, pure=False, **kwargs)
        here: Future[T] = Future()
        here.add_done_callback(lambda ended: there.cancel() if ended.cancelled() else None)
        there.add_done_callback(partial(_hand_over, here))
        return here


def _hand_over(here: Future[T], there: DaskFuture) -> None:
    """The outcome of a task on the cluster, as that of the future that was handed out."""
    if not here.set_running_or_notify_cancel():
        return
    try:
        here.set_result(there.result())
    except BaseException as error:
        here.set_exception(error)
