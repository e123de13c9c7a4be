"""Where independent jobs run that take minutes: in processes here, or on the workers of a Dask cluster."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from seafoam.extras import UnableError, require

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from distributed import Client

CONNECT_SECONDS = 10.0
"""Timeout of the connection to a scheduler, s."""
CONNECT_ATTEMPTS = 4
SCHEDULER = "Address of a Dask scheduler, such as tcp://host:8786, whose workers do it instead of processes here."
"""Help for an option of commands."""


class NoClusterError(UnableError):
    """No scheduler answers at an address."""


def connected(scheduler: str) -> "Client":
    """Connect to the scheduler at an address. Raises :class:`NoClusterError`."""
    from distributed import Client

    for _ in range(CONNECT_ATTEMPTS):
        try:
            return Client(scheduler, timeout=CONNECT_SECONDS, set_as_default=False)
        except AssertionError:
            # Dask's client asserts that its greeting comes alone; a busy scheduler may send more with it.
            continue
        except (OSError, ValueError) as error:
            raise NoClusterError(f"no scheduler answers at {scheduler}") from error
    raise NoClusterError(f"the scheduler at {scheduler} greeted with more than its greeting {CONNECT_ATTEMPTS} times")


@contextmanager
def executor(scheduler: str | None, processes: int) -> "Iterator[Executor]":
    """Run functions, arguments and results that can be pickled, while the context lasts.

    ``scheduler``: address such as ``tcp://host:8786``; None: so many ``processes`` here. A lost worker's jobs run again
    on others; workers need this package, and share no files with this machine. Raises
    :class:`seafoam.extras.MissingExtraError` without Dask, :class:`NoClusterError`.
    """
    if scheduler is None:
        # Here, because every command imports this module for its options.
        import multiprocessing
        from concurrent.futures import ProcessPoolExecutor

        # A fork would inherit threads that hold locks.
        with ProcessPoolExecutor(processes, mp_context=multiprocessing.get_context("spawn")) as pool:
            yield pool
        return
    require("cluster")
    # The same job may be asked for twice: a result that is kept would answer.
    with connected(scheduler) as client, client.get_executor(pure=False) as pool:
        yield pool
