"""Workers on this and other machines, by Dask distributed. It needs the extra ``cluster``.

Every worker process owns one GL context, created by its first task in the thread that draws for good: a context belongs
to one thread, so a worker has only one. Dask runs the frames of a lost worker again on the others, and takes waiting
frames from slow ones; a frame depends on its job alone, so the bytes are the same wherever it is drawn.
"""

import os
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING, Any

from seafoam.extras import require
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import FrameJob, Renderer, render_frame
from seafoam.sequences.errors import MixedFleetError, SequenceError
from seafoam.sequences.workers import Drawn, Units

if TYPE_CHECKING:
    from distributed import Client

AHEAD = 4
"""Frames for each worker that are asked for before they are needed: enough that none waits, few to lose by a stop."""
CONNECT_SECONDS = 10.0
"""Timeout of the connection to a scheduler, s."""
_mine = threading.local()


class DaskWorkers:
    """Draws on a Dask cluster. It is a context manager.

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
        require("cluster")
        self._mixed = mixed
        self._factory = factory
        self._stack = ExitStack()
        try:
            self.client = self._connected(scheduler, workers)
            self.info: Mapping[str, str] = self._common_renderer()
        except BaseException:
            self._stack.close()
            raise

    def draw(self, units: Units) -> Drawn:
        """Draw frames, each as soon as a worker is free, in the order in which they are finished."""
        from distributed import as_completed

        waiting = iter(units)
        ahead = AHEAD * max(1, len(self._addresses()))
        running = {self._submit(job): index for index, job in islice(waiting, ahead)}
        try:
            finished = as_completed(list(running), loop=self.client.loop, with_results=True)
            for future, (content, info) in finished:
                index = running.pop(future)
                self._compare(info)
                for following, job in islice(waiting, 1):
                    another = self._submit(job)
                    running[another] = following
                    finished.add(another)
                yield index, content
        finally:
            self.client.cancel(list(running))

    def close(self) -> None:
        """Leave the cluster, and end the local one."""
        self._stack.close()

    def __enter__(self) -> "DaskWorkers":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _connected(self, scheduler: str | None, workers: int) -> "Client":
        from distributed import Client, LocalCluster

        if scheduler is None:
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                env={"LP_NUM_THREADS": str(max(1, (os.cpu_count() or 1) // workers))},
            )
            self._stack.callback(cluster.close)
            client = Client(cluster, set_as_default=False)
        else:
            try:
                client = Client(scheduler, timeout=CONNECT_SECONDS, set_as_default=False)
            except (OSError, ValueError, TimeoutError) as error:
                raise SequenceError(f"no scheduler answers at {scheduler}") from error
        self._stack.callback(client.close)
        return client

    def _addresses(self) -> dict[str, Any]:
        found: dict[str, Any] = self.client.scheduler_info(n_workers=-1)["workers"]
        return found

    def _common_renderer(self) -> Mapping[str, str]:
        """Ask every worker for its renderer, in the thread that will draw."""
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
        self.info = reports[0]
        for report in reports:
            self._compare(report)
        return self.info

    def _compare(self, info: Mapping[str, str]) -> None:
        """Raise :class:`MixedFleetError` for another renderer; a worker can join at any time."""
        if not self._mixed and dict(info) != dict(self.info):
            names = " and ".join(f"{one['renderer']}, {one['version']}" for one in (self.info, info))
            raise MixedFleetError(f"the workers have different renderers: {names}; their frames differ")

    def _submit(self, job: FrameJob) -> Any:
        return self.client.submit(partial(_drawn, self._factory), job, pure=False)


def _renderer(factory: Callable[[], Renderer]) -> Renderer:
    """Return the renderer of this worker, which belongs to this thread."""
    if not hasattr(_mine, "renderer"):
        _mine.renderer = factory()
    renderer: Renderer = _mine.renderer
    return renderer


def _report(factory: Callable[[], Renderer]) -> dict[str, str]:
    return dict(_renderer(factory).info)


def _drawn(factory: Callable[[], Renderer], job: FrameJob) -> tuple[bytes, dict[str, str]]:
    renderer = _renderer(factory)
    return render_frame(renderer, job).content, dict(renderer.info)
