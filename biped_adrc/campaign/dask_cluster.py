"""The workers of an existing Dask cluster, by the address of its scheduler (the extra `[cluster]`).

Each chunk asks its worker for the versions of what the numbers depend on, so that one that joins late cannot
spoil a study.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, ParamSpec, Protocol, TypeVar, cast

from biped_adrc.campaign.workers import Workers, WorkersError
from biped_adrc.errors import InputError
from biped_adrc.versions import differences, numerical_versions

TIMEOUT = 10.0
"""[s] for a scheduler to answer, and for its first worker."""

P = ParamSpec("P")
T = TypeVar("T")
Versions = Mapping[str, str]

PRINTED = "tcp://host:8786, which 'dask scheduler' prints when it starts"
ADDRESS = re.compile(r"(?:(?:tcp|tls)://)?(?:\[[0-9a-fA-F:.]+\]|[\w.-]+):([0-9]{1,5})")


class _Stream(Protocol):
    def closed(self) -> bool: ...


class _Scheduler(Protocol):
    comm: _Stream


class _Client(Protocol):
    """What is used of Dask's untyped client."""

    status: str
    scheduler_comm: _Scheduler | None

    def nthreads(self) -> Mapping[str, int]: ...

    def run(self, function: Callable[[], T]) -> Mapping[str, T]: ...

    def wait_for_workers(self, n_workers: int, timeout: float) -> object: ...

    def get_executor(self, *, pure: bool) -> Executor: ...

    def close(self, timeout: float) -> object: ...


@dataclass(frozen=True)
class Cluster(Workers):
    """Workers of the scheduler at `address`, such as tcp://host:8786, which has `timeout` [s] to answer."""

    address: str
    timeout: float = TIMEOUT
    elsewhere: ClassVar[bool] = True

    def prepare(self) -> None:
        """Raises InputError as `start`."""
        self.stop(self.start(), True)

    def start(self) -> Executor:
        """Raises InputError for no address, when none answers, has no workers, or some with other versions."""
        client = _client(self.address, self.timeout)
        try:
            _check_workers(client, self.address, self.timeout)
        except BaseException:
            client.close(timeout=1)
            raise
        return _Checked(client, client.get_executor(pure=False), numerical_versions())

    def count(self, executor: Executor) -> int:
        return max(1, sum(_client_of(executor).nthreads().values()))

    def stop(self, executor: Executor, now: bool) -> None:
        executor.shutdown(wait=not now)
        _client_of(executor).close(timeout=2)

    def restart(self, executor: Executor) -> Executor:
        """The scheduler has put others in the place of workers that died."""
        return executor

    def broken(self, error: BaseException) -> bool:
        from distributed import KilledWorker

        return super().broken(error) or isinstance(error, KilledWorker)

    def check(self, executor: Executor) -> None:
        client = _client_of(executor)
        comm = client.scheduler_comm
        if client.status != "running" or comm is None or comm.comm.closed():
            raise WorkersError(
                f"the scheduler at {self.address} has gone away; what was finished is kept. Start the cluster "
                "again, and then the study: it goes on from there"
            )


def _client_of(executor: Executor) -> _Client:
    return cast("_Checked", executor).client


def _check_workers(client: _Client, address: str, timeout: float) -> None:
    """Raises InputError."""
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
    """Which versions differ; empty when none does. Text in their place is what went wrong there."""
    return found if isinstance(found, str) else differences(found, expected)


def _refusal(who: str, text: str) -> str:
    return (
        f"{who} would give other numbers: {text}. Give all workers the versions of this machine, or run the "
        "study where they are"
    )


def _client(address: str, timeout: float) -> _Client:
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
    try:
        return connect(address, timeout=timeout, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError, TypeError, TimeoutError, ImportError) as error:
        raise InputError(
            f"no Dask scheduler answers at '{address}' within {timeout:g} s ({type(error).__name__}: {error}); "
            f"expected an address such as {PRINTED}"
        ) from error


def _asked() -> Callable[[], Versions | str]:
    """A function that workers can run which do not have this package."""

    def versions() -> Versions | str:
        try:
            from biped_adrc.versions import numerical_versions
        except ImportError as error:
            return f"biped-adrc cannot be imported there ({error})"
        return dict(numerical_versions())

    return versions


def _run(expected: Versions, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    text = difference(numerical_versions(), expected)
    if text:
        raise InputError(_refusal("a worker of the cluster", text))
    return function(*args, **kwargs)


@dataclass(frozen=True)
class _Checked(Executor):
    """Dask's executor and its client; workers look at their versions first."""

    client: _Client
    inner: Executor
    versions: Versions

    def submit(self, function: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        checked: Callable[..., T] = partial(_run, dict(self.versions), function)
        return self.inner.submit(checked, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self.inner.shutdown(wait=wait and not cancel_futures)
