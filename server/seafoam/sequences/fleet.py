"""Workers on this and other machines, by Dask distributed. It needs the extra ``cluster``.

Every worker process owns one GL context, created by its first task in the thread that draws for good: a context belongs
to one thread, so a worker has only one. Dask runs the frames of a lost worker again on the others, and takes waiting
frames from slow ones. A frame depends on its job alone, so the bytes are the same wherever it is drawn.
"""

import os
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError
from contextlib import ExitStack, suppress
from functools import lru_cache, partial
from itertools import islice
from typing import TYPE_CHECKING, Any, cast

from seafoam import processes
from seafoam.extras import require
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import FrameJob, Renderer, render_frame
from seafoam.sequences.spec import DrawnFrames, MixedFleetError, SequenceError, Units

if TYPE_CHECKING:
    from distributed import Client, LocalCluster

AHEAD = 4
"""Frames for each worker that are asked for before they are needed: enough that none waits, few to lose by a stop."""


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
        try:
            self.client = self._connected()
            self.callback(self.client.close)
            self._common_renderer()
        except BaseException:
            self.close()
            raise

    def draw(self, units: Units) -> DrawnFrames:
        """Draw frames, each as soon as a worker is free, in the order in which they are finished.

        Raises :class:`SequenceError` if the connection to the scheduler is lost.
        """
        from distributed import as_completed

        waiting = iter(units)
        running: dict[Any, int] = {}
        finished = as_completed(loop=self.client.loop)

        def submit(units: Units) -> None:
            for index, job in units:
                future = self.client.submit(partial(_drawn, self._factory), job, pure=False)
                running[future] = index
                finished.add(future)

        try:
            submit(islice(waiting, AHEAD * max(1, len(self._addresses()))))
            for future in finished:
                index = running.pop(future)
                try:
                    content, info = future.result()
                except (CancelledError, OSError) as error:
                    if future.status == "error":
                        raise
                    raise SequenceError("the scheduler went away; the same command goes on from here") from error
                self._compare(info)
                submit(islice(waiting, 1))
                yield index, content
        finally:
            self.client.cancel(list(running))

    def _connected(self) -> "Client":
        from distributed import Client, LocalCluster

        if self._scheduler is not None:
            try:
                return processes.connected(self._scheduler)
            except processes.NoClusterError as error:
                raise SequenceError(str(error)) from error
        threads = {"LP_NUM_THREADS": str(max(1, (os.cpu_count() or 1) // self._workers))}
        here = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0"}
        cluster = LocalCluster(self._workers, threads_per_worker=1, processes=True, env=threads, **here)
        self.callback(_end, cluster)
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
        self.info: Mapping[str, str] = reports[0]
        for report in reports:
            self._compare(report)

    def _compare(self, info: Mapping[str, str]) -> None:
        """Raise :class:`MixedFleetError` for another renderer; a worker can join at any time."""
        if not self._mixed and dict(info) != dict(self.info):
            names = " and ".join(f"{one['renderer']}, {one['version']}" for one in (self.info, info))
            raise MixedFleetError(f"the workers have different renderers: {names}; their frames differ")


@lru_cache(maxsize=1)
def _renderer(factory: Callable[[], Renderer]) -> Renderer:
    """Return the renderer of this worker, which belongs to its only thread."""
    return factory()


def _end(cluster: "LocalCluster") -> None:
    """A worker may outlast the five seconds that Dask waits for it; killed by then, it costs no frame."""
    with suppress(TimeoutError):
        cluster.close()


def _report(factory: Callable[[], Renderer]) -> dict[str, str]:
    return dict(_renderer(factory).info)


def _drawn(factory: Callable[[], Renderer], job: FrameJob) -> tuple[bytes, dict[str, str]]:
    renderer = _renderer(factory)
    return render_frame(renderer, job).content, dict(renderer.info)
