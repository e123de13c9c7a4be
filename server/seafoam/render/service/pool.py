"""Rendering outside the web server: worker processes that each own one GL context.

A GL call holds Python's lock until the picture is read, a context belongs to one thread for life, and a driver that
hangs or crashes takes its process with it. So the parent never calls GL: spawned workers do, and they are killed and
replaced when a frame exceeds its deadline. What a worker compiles for a frame is finished all the same.

Errors: :mod:`seafoam.render.service.errors`.
"""

import asyncio
import contextlib
import logging
import math
import multiprocessing
import os
import signal
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import CancelledError as CancelledFuture
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from typing import Any, Literal

from pebble import ProcessExpired, ProcessPool

from seafoam.render.gl.executor import Executor
from seafoam.render.service import errors
from seafoam.render.service.jobs import Drawn, EncodedFrame, FrameJob, MeasureJob, Picture, Renderer, encode_frame
from seafoam.render.service.queues import PrioritySemaphore, Ticket
from seafoam.render.service.shared_buffer import BufferPool, SharedBuffer
from seafoam.render.service.worker import T, start_worker, work_canary, work_frame, work_measure

log = logging.getLogger(__name__)

START_SECONDS = 180.0
"""Timeout of the default picture, s, by which the server is ready; then the renderer is unavailable."""
COMPILE_SECONDS = 120.0
"""Time after its frame's deadline for which a worker may compile, s: the next request finds it done."""
MEASURE_SECONDS = 120.0
"""Timeout of a measurement, waiting included, s: one draws a point of a sweep once or twice."""
BACKGROUND_SECONDS = 60.0
"""Time for which a frame in the background may wait, s: for every visitor's."""
BACKGROUND_QUEUE = 64
"""Capacity of the background's own queue, frames: the thumbnails of a gallery."""

State = Literal["starting", "ready", "unavailable", "stopped"]
Work = Callable[..., T | errors.RenderError]
"""A function of workers: its result, or why there is none."""
DIED = (ProcessExpired, BrokenProcessPool, CancelledFuture)
"""What a future raises whose worker died."""


class RenderPool:
    """Worker processes behind a bounded queue, for one event loop.

    workers: processes, each with a GL context; at least 1.
    queue: capacity of the queue, frames; absent: twice the number of workers.
    deadline: timeout of a frame, waiting included, s.
    recycle: frames after which a worker is replaced, because GL stacks leak; 0: never. Streams stand still meanwhile,
    for seconds, and no leak is known (llvmpipe, 4,000 frames of ``default``: 261 to 264 MB).
    check_seconds: interval at which an idle pool draws its test picture, and a pool without GL looks for one again.
    factory: creates the renderer, in the worker; must be importable there.
    """

    def __init__(
        self,
        *,
        workers: int = 1,
        queue: int | None = None,
        deadline: float = 10.0,
        recycle: int = 20_000,
        check_seconds: float = 60.0,
        factory: Callable[[], Renderer] = Executor,
    ) -> None:
        self.workers = workers
        self.queue = 2 * workers if queue is None else queue
        self.deadline = deadline
        self.state: State = "stopped"
        self.info: dict[str, str] = {}
        """Vendor, renderer and version of the GL in use; empty until ready."""
        self.remedy = ""
        """Why there is no renderer and the remedy, if the state is ``unavailable``."""
        self.succeeded_at = -math.inf
        """Time of the last test picture or frame, of ``time.time()``."""
        self.active = 0
        self._tickets: set[Ticket] = set()
        self.restarts: Counter[Literal["deadline", "crash"]] = Counter()
        self._recycle = recycle
        self._check_seconds = check_seconds
        self.threads = max(1, (os.cpu_count() or 1) // workers)
        """Number of threads that a software renderer can use in each worker."""
        self._initargs = (factory, self.threads)
        self._processes: ProcessPool | None = None
        self._settled = asyncio.Event()
        self._free_workers = PrioritySemaphore(workers)
        # One frame of each worker is encoded while it draws the next; more would only collect in memory.
        self._free_encoders = PrioritySemaphore(2 * workers)
        self._buffers = BufferPool(2 * workers)
        self._encoders: ThreadPoolExecutor | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    async def start(self) -> None:
        """Start the workers and return at once; :attr:`state` tells when they are ready."""
        self.state, self.active = "starting", 0
        # They belong to the event loop that first waits for them, and a restart has a new loop.
        self._settled = asyncio.Event()
        self._free_workers, self._free_encoders = PrioritySemaphore(self.workers), PrioritySemaphore(2 * self.workers)
        self._encoders = ThreadPoolExecutor(self.workers, "encode")
        self._keep(self._watch())

    async def stop(self) -> None:
        """Kill the workers and wait until they have ended."""
        self.state = "stopped"
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        if self._encoders is not None:
            self._encoders.shutdown(wait=False, cancel_futures=True)
        self._buffers.close()
        processes, self._processes = self._processes, None
        if processes is not None:
            await asyncio.to_thread(_discard, processes)

    @property
    def waiting(self) -> int:
        """Number of visitors' frames in the queue."""
        return sum(ticket.rank == 0 for ticket in self._tickets)

    @property
    def waiting_background(self) -> int:
        """Number of frames that wait until no visitor's does."""
        return sum(ticket.background for ticket in self._tickets)

    def waits(self, ticket: Ticket) -> bool:
        """Whether a frame is in the queue: not yet drawn."""
        return ticket in self._tickets

    async def render(self, job: FrameJob, ticket: Ticket | None = None) -> EncodedFrame:
        """Render one frame in a worker, and encode it here in a thread, while the worker draws the next.

        ticket: absent: a visitor's. A frame in the background has a queue and a deadline of its own; one of a stream
        takes no place in the queue, since its stream bounds how many wait. The deadline of both is for waiting; once
        begun they have :attr:`deadline`.

        Raises :class:`RenderQueueFullError`, :class:`DeadlineError`, :class:`RendererUnavailableError` or
        :class:`RenderFailedError`. If the call is cancelled while it waits, it leaves the queue; a frame
        that is being rendered is finished, because stopping it would kill the worker.
        """
        ticket = ticket or Ticket()
        began = time.time()
        expires = began + (BACKGROUND_SECONDS if ticket.background else self.deadline)
        self._admit(ticket)
        self._tickets.add(ticket)
        try:
            await self.wait_until_settled()
            # The worker first: one that waits in the background must not hold what a visitor needs.
            await self._take(self._free_workers, expires, ticket)
            try:
                await self._take(self._free_encoders, expires, ticket)
            except BaseException:
                self._free_workers.release()
                raise
        finally:
            self._tickets.discard(ticket)
        # What waits for all others often begins late, and must not cost the worker, which is killed at the deadline.
        # A renderer that hangs is found as soon as in any frame.
        late = time.time() + self.deadline
        expires = min(expires, late) if ticket.rank == 0 else late
        buffer = self._buffers.take(job.bytes)
        try:
            sent = await self._run(work_frame, (job, expires, buffer.address), expires, COMPILE_SECONDS)
            picture = replace(sent, pixels=buffer.received(sent.pixels))
        except BaseException:
            # Closed, since the worker may still write to it.
            buffer.close()
            self._free_encoders.release()
            raise
        frame = await self._encode(picture, job, buffer, expires)
        worked = sum(frame.timings.values())
        return replace(frame, timings={"queue": max(0.0, time.time() - began - worked), **frame.timings})

    async def _encode(self, picture: Picture, job: FrameJob, buffer: SharedBuffer, expires: float) -> EncodedFrame:
        """Encode in a thread; encoder and buffer are free when it ends, whether or not the caller still waits."""
        assert self._encoders is not None
        loop = asyncio.get_running_loop()
        encoding = loop.run_in_executor(self._encoders, encode_frame, picture, job)
        encoding.add_done_callback(lambda _: self._buffers.give_back(buffer))
        encoding.add_done_callback(lambda _: self._free_encoders.release())
        try:
            async with asyncio.timeout(max(0.0, expires - time.time())):
                return await asyncio.shield(encoding)
        except TimeoutError:
            raise errors.DeadlineError("timeout: the frame was drawn, but not encoded before its deadline") from None

    async def measure(self, job: MeasureJob) -> tuple[Drawn, ...]:
        """Measure in a worker, in turn with the frames, without taking a place in their queue.

        Raises what :meth:`render` raises, except for a full queue.
        """
        expires = time.time() + MEASURE_SECONDS
        await self.wait_until_settled()
        await self._take(self._free_workers, expires)
        return await self._run(work_measure, (job, expires), expires)

    async def wait_until_settled(self) -> None:
        """Wait until the state of the renderer is known; raises what :meth:`render` raises if there is none."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(self.deadline):
                await self._settled.wait()
        if self.state == "starting":
            raise errors.StartingError("the renderer is starting: it compiles the default picture")
        if self.state != "ready":
            raise errors.RendererUnavailableError(self.remedy or "the renderer is stopped")

    def _admit(self, ticket: Ticket) -> None:
        """Refuse a frame for which there is neither a worker nor a place in the queue."""
        if self.state in ("unavailable", "stopped"):
            raise errors.RendererUnavailableError(self.remedy or "the renderer is stopped")
        if ticket.stream:
            return
        waiting, capacity = (
            (self.waiting_background, BACKGROUND_QUEUE) if ticket.background else (self.waiting, self.queue)
        )
        if waiting >= capacity and (self.state == "starting" or self._free_workers.locked()):
            raise errors.RenderQueueFullError(f"the render queue is full: {waiting} frames are waiting")

    async def _take(self, places: PrioritySemaphore, expires: float, ticket: Ticket | None = None) -> None:
        try:
            async with asyncio.timeout(max(0.0, expires - time.time())):
                await places.acquire(ticket)
        except TimeoutError:
            raise errors.DeadlineError("timeout: no render worker was free before the frame's deadline") from None

    async def _run(self, work: Work[T], args: tuple[Any, ...], expires: float, grace: float = 0) -> T:
        """Run work in the reserved worker, which is released when it is idle again.

        grace: time after which a worker is killed that nobody waits for any more, s.
        """
        try:
            return await self._attempt(work, args, expires, grace)
        except DIED as error:
            # A frame depends only on its job, so it can be tried again in another worker.
            log.warning("A render worker died: %r", error)
            await self._take(self._free_workers, expires)
        try:
            return await self._attempt(work, args, expires, grace)
        except DIED as again:
            raise errors.RenderFailedError("the render worker crashed twice") from again

    async def _attempt(self, work: Work[T], args: tuple[Any, ...], expires: float, grace: float) -> T:
        try:
            future = self._schedule(work, args, max(0.01, expires - time.time()) + grace)
        except BaseException:
            self._free_workers.release()
            raise
        loop = asyncio.get_running_loop()
        self.active += 1
        future.add_done_callback(lambda done: loop.call_soon_threadsafe(self._free, _was_late(done)))
        wrapped = asyncio.wrap_future(future)
        # Retrieves the exception, which asyncio would report if the caller no longer waits.
        wrapped.add_done_callback(lambda done: done.cancelled() or done.exception())
        try:
            done, _ = await asyncio.wait({wrapped}, timeout=max(0.0, expires - time.time()))
            if not done:
                raise TimeoutError
            return self._accepted(wrapped.result())
        except TimeoutError:
            # Pebble's timeout starts with the worker's start on the job, so this deadline is reached first.
            raise self._past_deadline() from None
        except DIED:
            if _was_late(future):
                raise self._past_deadline() from None
            self.restarts["crash"] += 1
            raise

    def _past_deadline(self) -> errors.DeadlineError:
        return errors.DeadlineError(f"timeout: the frame was not finished within {self.deadline:g} s")

    def _accepted(self, answer: T | errors.RenderError) -> T:
        match answer:
            case errors.RendererUnavailableError() as error:
                self._give_up(str(error))
                raise error
            case errors.RenderFailedError() as error:
                log.error("A frame failed:\n%s", error)
                raise errors.RenderFailedError("the renderer failed; the server log has the details")
            case errors.RenderError():
                raise errors.DeadlineError(f"timeout: the frame was not started within {self.deadline:g} s")
            case value:
                self.succeeded_at = time.time()
                return value

    def _schedule(self, work: Work[T], args: tuple[Any, ...], timeout: float) -> Future[T | errors.RenderError]:
        if self._processes is not None:
            try:
                return self._processes.schedule(work, args, timeout=timeout)
            except RuntimeError:
                # Pebble closes a pool permanently if an idle worker dies.
                self.restarts["crash"] += 1
                self._drop_processes()
        self._processes = ProcessPool(
            max_workers=self.workers,
            max_tasks=self._recycle,
            initializer=start_worker,
            initargs=self._initargs,
            context=multiprocessing.get_context("spawn"),
        )
        return self._processes.schedule(work, args, timeout=timeout)

    def _drop_processes(self) -> None:
        processes, self._processes = self._processes, None
        if processes is not None:
            self._keep(asyncio.to_thread(_discard, processes))

    def _free(self, late: bool) -> None:
        self.active -= 1
        self.restarts["deadline"] += late
        self._free_workers.release()

    async def _watch(self) -> None:
        """Draw a test picture at the start, and again whenever nothing was drawn for a while."""
        while True:
            if self.state != "ready" or (
                time.time() - self.succeeded_at >= self._check_seconds and not self._free_workers.locked()
            ):
                await self._check()
            await asyncio.sleep(self._check_seconds)

    async def _check(self) -> None:
        await self._free_workers.acquire()
        try:
            self.info = await self._run(work_canary, (), time.time() + START_SECONDS)
            self.state, self.remedy = "ready", ""
        except errors.RendererUnavailableError as error:
            log.warning("No renderer: %s", error)
        except errors.RenderError as error:
            self._give_up(f"the renderer does not start: {error}")
        self._settled.set()

    def _give_up(self, remedy: str) -> None:
        self.state, self.remedy = "unavailable", remedy
        self._drop_processes()

    def _keep(self, work: Any) -> None:
        """Run a coroutine as a task that is not garbage-collected before it ends."""
        task: asyncio.Task[None] = asyncio.ensure_future(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


def _was_late(done: Future[Any]) -> bool:
    """Whether a worker was ended because it was late: by itself, or, where it compiled for too long, by Pebble."""
    error = None if done.cancelled() else done.exception()
    return isinstance(error, TimeoutError) or (isinstance(error, ProcessExpired) and error.exitcode == -signal.SIGALRM)


def _discard(processes: ProcessPool) -> None:
    processes.stop()  # type: ignore[no-untyped-call]
    processes.join()
