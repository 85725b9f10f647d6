"""The workers of an existing Dask cluster, by the address of its scheduler (the extra `[cluster]`).

Each chunk asks its worker for the versions of what the numbers depend on, so that one that joins late cannot
spoil a study.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any, ClassVar

from biped_adrc.campaign.workers import Workers, WorkersError
from biped_adrc.errors import InputError
from biped_adrc.versions import differences, numerical_versions

TIMEOUT = 10.0
"""[s] for a scheduler to answer, and for its first worker."""

PRINTED = "tcp://host:8786, which 'dask scheduler' prints when it starts"
ADDRESS = re.compile(r"(?:(?:tcp|tls)://)?(?:\[[0-9a-fA-F:.]+\]|[\w.-]+):([0-9]{1,5})")


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

    def count(self, executor: Any) -> int:
        return max(1, sum(executor.client.nthreads().values()))

    def stop(self, executor: Any, now: bool) -> None:
        executor.shutdown(wait=not now)
        executor.client.close(timeout=2)

    def restart(self, executor: Executor) -> Executor:
        """The scheduler has put others in the place of workers that died."""
        return executor

    def broken(self, error: BaseException) -> bool:
        from distributed import KilledWorker

        return super().broken(error) or isinstance(error, KilledWorker)

    def check(self, executor: Any) -> None:
        client = executor.client
        comm = client.scheduler_comm
        if client.status != "running" or comm is None or comm.comm.closed():
            raise WorkersError(
                f"the scheduler at {self.address} has gone away; what was finished is kept. Start the cluster "
                "again, and then the study: it goes on from there"
            )


def _check_workers(client: Any, address: str, timeout: float) -> None:
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


def difference(found: Mapping[str, str] | str, expected: Mapping[str, str]) -> str:
    """Which versions differ; empty when none does. Text in their place is what went wrong there."""
    return found if isinstance(found, str) else differences(found, expected)


def _refusal(who: str, text: str) -> str:
    return (
        f"{who} would give other numbers: {text}. Give all workers the versions of this machine, or run the "
        "study where they are"
    )


def _client(address: str, timeout: float) -> Any:
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


def _asked() -> Callable[[], Any]:
    """A function that workers can run which do not have this package."""

    def versions() -> Any:
        try:
            from biped_adrc.versions import numerical_versions
        except ImportError as error:
            return f"biped-adrc cannot be imported there ({error})"
        return dict(numerical_versions())

    return versions


def _run(expected: Mapping[str, str], function: Callable[..., Any], *arguments: Any) -> Any:
    text = difference(numerical_versions(), expected)
    if text:
        raise InputError(_refusal("a worker of the cluster", text))
    return function(*arguments)


@dataclass(frozen=True)
class _Checked(Executor):
    """Dask's executor and its client; workers look at their versions first."""

    client: Any
    inner: Any
    versions: Mapping[str, str]

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        return self.inner.submit(_run, dict(self.versions), function, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self.inner.shutdown(wait=wait and not cancel_futures)
