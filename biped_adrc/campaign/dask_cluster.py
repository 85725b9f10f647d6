"""The workers of an existing Dask cluster, reached by the address of its scheduler (the extra `[cluster]`).

A `Cluster` is handed to `sweep` in place of a number of processes. The executor is Dask's own
(`Client.get_executor`). Results must not depend on where a run was made: the workers that are there when
a study starts are asked for the versions of all that decides the numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import ClassVar

from biped_adrc.campaign.workers import Workers
from biped_adrc.errors import InputError
from biped_adrc.types import DaskClient
from biped_adrc.versions import differences, numerical_versions

TIMEOUT = 10.0
"""Time for a scheduler to answer, and for its first worker to appear [s]."""


@dataclass(frozen=True)
class Cluster(Workers):
    """The workers of a Dask scheduler. address: such as tcp://host:8786; timeout: for its answer [s]."""

    address: str
    timeout: float = TIMEOUT
    elsewhere: ClassVar[bool] = True

    def start(self) -> Executor:
        """Connect and check all workers.

        Raises InputError when no scheduler answers, it has no workers, or they have other versions.
        """
        try:
            from distributed import Client

            connect: Callable[..., DaskClient] = Client
        except ImportError as error:
            raise InputError(
                "a study on a Dask cluster needs Dask, which is not installed; "
                "pip install 'biped-adrc[cluster]'"
            ) from error
        try:
            client: DaskClient = connect(self.address, timeout=self.timeout, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise InputError(
                f"no Dask scheduler answers at '{self.address}' within {self.timeout:g} s "
                f"({type(error).__name__}: {error}); expected an address such as tcp://host:8786, which "
                "'dask scheduler' prints when it starts"
            ) from error
        try:
            self._check_workers(client)
        except BaseException:
            client.close(timeout=1)
            raise
        executor: Executor = client.get_executor(pure=False)
        return executor

    def _check_workers(self, client: DaskClient) -> None:
        """Raises InputError where there is no worker after the timeout, or one has other versions."""
        try:
            client.wait_for_workers(1, timeout=self.timeout)
            there = client.run(numerical_versions)
        except (TimeoutError, ImportError) as error:
            raise InputError(
                f"the scheduler at {self.address} has no workers with biped-adrc after {self.timeout:g} s; "
                f"start some with 'dask worker {self.address}' where it is installed"
            ) from error
        for worker, found in there.items():
            if text := differences(found, numerical_versions()):
                raise InputError(
                    f"worker {worker} of the scheduler at {self.address} would give other numbers: {text}. "
                    "Give all workers the versions of this machine, or run the study where they are"
                )

    def count(self, executor: Executor) -> int:
        """Threads of all workers."""
        return max(1, sum(_client_of(executor).nthreads().values()))

    def stop(self, executor: Executor, now: bool) -> None:
        """Close the connection, which gives up what has not ended; the cluster itself goes on."""
        _client_of(executor).close(timeout=2)

    def broken(self, error: BaseException) -> bool:
        """Whether this is what Dask says of a task that has killed several workers; it replaces them itself."""
        from distributed import KilledWorker

        return isinstance(error, KilledWorker)


def _client_of(executor: Executor) -> DaskClient:
    """The client behind Dask's executor."""
    return vars(executor)["_client"]
