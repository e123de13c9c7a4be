"""Workers on this and other machines, by Dask distributed. It needs the extra ``cluster``.

Every worker process owns one GL context, created by its first task in the thread that draws for good: a context belongs
to one thread, so a worker has only one. Dask runs the frames of a lost worker again on the others, and takes waiting
frames from slow ones; a scheduler that went away and came back is asked for them once more. A frame depends on its job
alone, so the bytes are the same wherever it is drawn.
"""

import os
import threading
import time
from collections.abc import Callable, Generator, Iterator, Mapping
from concurrent.futures import CancelledError
from contextlib import ExitStack
from functools import partial
from itertools import chain, islice
from queue import Empty, Queue
from typing import TYPE_CHECKING, Any, cast

from seafoam import processes
from seafoam.extras import require
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import FrameJob, Renderer, render_frame
from seafoam.sequences.spec import DrawnFrames, MixedFleetError, SequenceError, Units

if TYPE_CHECKING:
    from distributed import Client

AHEAD = 4
"""Frames for each worker that are asked for before they are needed: enough that none waits, few to lose by a stop."""
RETURN_SECONDS = 120.0
"""How long a scheduler that went away is waited for, until it is back with a worker, s."""
RETURN_POLL = 0.5
"""Interval of the attempts, s."""
POLL_SECONDS = 1.0
"""How long a frame is waited for before the scheduler is looked at again, s."""
_mine = threading.local()
_Unit = tuple[int, FrameJob]


class DaskWorkers(ExitStack):
    """Draws on a Dask cluster, and leaves it at the end of the context, in which a local one ends.

    scheduler: address such as ``tcp://host:8786``; absent: ``workers`` processes on this machine. mixed: allow workers
    with other renderers than the first one's: their frames differ in single levels. factory: creates the renderer in
    a worker; must be importable there.

    Raises MissingExtraError without Dask, :class:`MixedFleetError`, :class:`SequenceError` if there is no cluster.
    """

    def __init__(
        self,
        scheduler: str | None = None,
        *,
        workers: int = 2,
        mixed: bool = False,
        factory: Callable[[], Renderer] = Executor,
    ) -> None:
        super().__init__()
        require("cluster")
        self._scheduler, self._workers, self._mixed, self._factory = scheduler, workers, mixed, factory
        self.info: Mapping[str, str] = {}
        self._connect()

    def draw(self, units: Units) -> DrawnFrames:
        """Draw frames, each as soon as a worker is free, in the order in which they are finished.

        Raises :class:`SequenceError` if the scheduler goes away and does not return within ``RETURN_SECONDS``.
        """
        waiting = iter(units)
        while lost := (yield from self._draw_while_connected(waiting)):
            self._rejoin()
            waiting = chain(lost, waiting)

    def _draw_while_connected(self, waiting: Iterator[_Unit]) -> Generator[tuple[int, bytes], None, list[_Unit]]:
        """Draw until nothing is left; return the frames that were lost with the connection to the scheduler."""
        finished: Queue[Any] = Queue()
        running: dict[Any, _Unit] = {}
        lost: list[_Unit] = []

        def submit(units: Units) -> None:
            for unit in units:
                future = self.client.submit(partial(_drawn, self._factory), unit[1], pure=False)
                running[future] = unit
                future.add_done_callback(finished.put)

        scheduler = self._scheduler_id()
        try:
            submit(islice(waiting, AHEAD * max(1, len(self._addresses()))))
            while running:
                try:
                    future = finished.get(timeout=POLL_SECONDS)
                except Empty:
                    # A scheduler that came back between two looks knows nothing of what its predecessor was asked for.
                    if scheduler != self._scheduler_id():
                        return [*lost, *running.values()]
                    continue
                unit = running.pop(future)
                try:
                    content, info = future.result()
                except (CancelledError, OSError):
                    if future.status == "error":
                        raise
                    lost.append(unit)
                    continue
                self._compare(info)
                submit(islice(waiting, 0 if lost else 1))
                yield unit[0], content
        finally:
            self.client.cancel(list(running))
        return lost

    def _scheduler_id(self) -> str | None:
        """Name of the connected scheduler's process; None while there is no connection."""
        if self.client.status != "running":
            return None
        return str(self.client.scheduler_info(n_workers=0)["id"])

    def _rejoin(self) -> None:
        """Connect anew to a scheduler that went away, when it is back with a worker."""
        self.close()
        until = time.monotonic() + RETURN_SECONDS
        while True:
            try:
                return self._connect()
            except MixedFleetError:
                raise
            except SequenceError as error:
                if time.monotonic() > until:
                    raise SequenceError(f"the scheduler went away and did not return: {error}") from error
                time.sleep(RETURN_POLL)

    def _connect(self) -> None:
        """Connect to the scheduler, or start a cluster here, and compare the workers' renderers."""
        try:
            self.client = self._connected()
            self.callback(self.client.close)
            self._common_renderer()
        except BaseException:
            self.close()
            raise

    def _connected(self) -> "Client":
        from distributed import Client, LocalCluster

        if self._scheduler is not None:
            try:
                return processes.connected(self._scheduler)
            except processes.NoClusterError as error:
                raise SequenceError(str(error)) from error
        cluster = LocalCluster(
            n_workers=self._workers,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            env={"LP_NUM_THREADS": str(max(1, (os.cpu_count() or 1) // self._workers))},
        )
        self.callback(cluster.close)
        return Client(cluster, set_as_default=False)

    def _addresses(self) -> dict[str, Any]:
        return cast(dict[str, Any], self.client.scheduler_info(n_workers=-1)["workers"])

    def _common_renderer(self) -> None:
        """Ask every worker for its renderer, in the thread that will draw; the first one's is that of the fleet."""
        workers = self._addresses()
        if not workers:
            raise SequenceError("the cluster has no workers: start some with: dask worker ADDRESS --nthreads 1")
        threaded = [address for address, worker in workers.items() if worker["nthreads"] != 1]
        if threaded:
            raise SequenceError(f"{threaded[0]} has several threads, and GL belongs to one: start it with --nthreads 1")
        asked = [
            self.client.submit(_report, self._factory, workers=[address], pure=False, allow_other_workers=False)
            for address in workers
        ]
        reports: list[dict[str, str]] = self.client.gather(asked)
        self.info = self.info or reports[0]
        for report in reports:
            self._compare(report)

    def _compare(self, info: Mapping[str, str]) -> None:
        """Raise :class:`MixedFleetError` for another renderer; a worker can join at any time."""
        if not self._mixed and dict(info) != dict(self.info):
            names = " and ".join(f"{one['renderer']}, {one['version']}" for one in (self.info, info))
            raise MixedFleetError(f"the workers have different renderers: {names}; their frames differ")


def _renderer(factory: Callable[[], Renderer]) -> Renderer:
    """Return the renderer of this worker, which belongs to this thread."""
    if not hasattr(_mine, "renderer"):
        _mine.renderer = factory()
    return cast(Renderer, _mine.renderer)


def _report(factory: Callable[[], Renderer]) -> dict[str, str]:
    return dict(_renderer(factory).info)


def _drawn(factory: Callable[[], Renderer], job: FrameJob) -> tuple[bytes, dict[str, str]]:
    renderer = _renderer(factory)
    return render_frame(renderer, job).content, dict(renderer.info)
