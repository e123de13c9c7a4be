"""Rendering outside the web server: worker processes that each own one GL context.

A GL call holds Python's lock until the picture is read, a context belongs to one thread for life, and a driver that
hangs or crashes takes its process with it. So the parent never calls GL: spawned workers do, and they are killed and
replaced when a frame exceeds its deadline.

Errors::

    RenderError
    ├── FrameTooLargeError        the frame exceeds the size limits
    ├── QueueFullError            the render queue is full
    ├── DeadlineError             timeout, waiting included
    ├── RendererUnavailableError  no usable GL, with the remedy
    └── RenderFailedError         the worker raised an error, or crashed twice
"""

import asyncio
import contextlib
import logging
import math
import multiprocessing
import os
import time
import traceback
from collections import Counter
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError as CancelledFuture
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from typing import Any, Generic, Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray
from pebble import ProcessExpired, ProcessPool

from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.encode import FrameFormat, encode, needs_linear
from seafoam.render.gl.executor import Executor, NoRendererError
from seafoam.scene.models import Camera, Scene

log = logging.getLogger(__name__)

CANARY_SIDE = 16
"""Side of the test picture that a new worker draws, pixels."""
START_SECONDS = 60.0
"""Timeout of a worker's test picture, s; then the renderer is unavailable."""
STUCK_SECONDS = 10.0
"""Grace period after its deadline, s; if Pebble has not killed a worker by then, the whole pool is replaced."""
MEASURE_SECONDS = 120.0
"""Timeout of a measurement, waiting included, s: one draws a point of a sweep once or twice."""
EARLIEST_RETRY = 1
"""Minimum delay before a retry when the queue is full, s."""

State = Literal["starting", "ready", "unavailable", "stopped"]

T = TypeVar("T")


class RenderError(Exception):
    """Base class of errors that prevent a frame from being rendered."""


class FrameTooLargeError(RenderError):
    """The frame exceeds the size limits. ``field``: what to lower; its bounds are inclusive."""

    def __init__(self, field: Literal["width", "height", "quality"], detail: str, least: int, greatest: int) -> None:
        super().__init__(detail)
        self.field = field
        self.least = least
        self.greatest = greatest


class QueueFullError(RenderError):
    """The render queue is full; retry after ``retry_after`` seconds."""

    def __init__(self, waiting: int, retry_after: int) -> None:
        super().__init__(f"the render queue is full: {waiting} frames are waiting")
        self.retry_after = retry_after


class DeadlineError(RenderError):
    """A frame was not finished before its deadline, waiting included."""


class RendererUnavailableError(RenderError):
    """No usable GL. The text gives the remedy."""


class RenderFailedError(RenderError):
    """A worker raised an error or crashed while rendering."""


@dataclass(frozen=True, slots=True)
class FrameLimits:
    """Size limits of a frame. Checked before anything is allocated."""

    side: int = 4096
    """Width and height, pixels."""
    sampled_side: int = 8192
    """Width and height times samples along them: limited by the render targets of every supported GL."""
    samples: int = 8_400_000
    """Width × height × samples per pixel."""

    def allows(self, width: int, height: int, samples: int) -> bool:
        """Whether :meth:`check` accepts a frame."""
        try:
            self.check(width, height, samples)
        except FrameTooLargeError:
            return False
        return True

    def check(self, width: int, height: int, samples: int) -> None:
        """Raise :class:`FrameTooLargeError` naming the field to lower; ``samples``: per pixel."""
        along = math.isqrt(samples)
        side = min(self.side, self.sampled_side // along)
        sides: tuple[tuple[Literal["width", "height"], int], ...] = (("width", width), ("height", height))
        for field, value in sides:
            if not 1 <= value <= side:
                why = "" if side == self.side else f" at {samples} samples per pixel"
                raise FrameTooLargeError(field, f"{field} must be 1 to {side} pixels{why}, not {value}", 1, side)
        asked = width * height * samples
        if asked > self.samples:
            most = max(1, self.samples // (width * samples))
            raise FrameTooLargeError(
                "height",
                f"{width} × {height} pixels with {samples} samples each are {asked:,} samples; the limit "
                f"is {self.samples:,}: lower width, height or the quality's samples",
                1,
                most,
            )


@dataclass(frozen=True, slots=True)
class FrameJob:
    """One frame to render: everything that its bytes depend on."""

    scene: Scene
    quality: Quality
    time: float
    """Seconds, |time| ≤ 1e9."""
    camera: Camera
    width: int
    """Pixels."""
    height: int
    """Pixels."""
    format: FrameFormat


@dataclass(frozen=True, slots=True)
class Frame:
    """An encoded frame and its times: seconds by ``queue``, ``plan``, ``render``, ``read``, ``encode``."""

    content: bytes
    timings: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Draw:
    """One drawing of a measurement. ``keep``: return its pixels."""

    width: int
    height: int
    output: Literal["rgba8", "linear"]
    keep: bool = False


@dataclass(frozen=True, slots=True)
class MeasureJob:
    """A frame to draw several times, to measure its time."""

    scene: Scene
    quality: Quality
    time: float
    """Seconds of the scene."""
    camera: Camera
    draws: tuple[Draw, ...]


@dataclass(frozen=True, slots=True)
class Drawn:
    """Time of one drawing, from the first call until it was finished, and its pixels if requested."""

    seconds: float
    pixels: NDArray[Any] | None


class Rendered(Protocol):
    """Result of a renderer."""

    @property
    def pixels(self) -> NDArray[Any]:
        """(height, width, 4), top row first; uint8 or, linear, float32."""

    @property
    def timings(self) -> Mapping[str, float]:
        """Seconds by ``render`` and ``read``."""


class Renderer(Protocol):
    """What a worker renders with: :class:`seafoam.render.gl.executor.Executor`, or a test's stand-in."""

    @property
    def info(self) -> Mapping[str, str]:
        """``vendor``, ``renderer`` and ``version``."""

    def render(
        self,
        plan: FramePlan,
        *,
        time: float,
        camera: Camera,
        width: int,
        height: int,
        output: Literal["rgba8", "linear"],
    ) -> Rendered:
        """Draw one frame."""


def render_frame(renderer: Renderer, job: FrameJob) -> Frame:
    """Plan, render and encode one frame in this process.

    Raises :class:`seafoam.planner.PlanError` for a scene that cannot be planned, and what the renderer raises.
    """
    began = time.perf_counter()
    plan = make_plan(job.scene, job.quality)
    planned = time.perf_counter()
    rendered = renderer.render(
        plan,
        time=job.time,
        camera=job.camera,
        width=job.width,
        height=job.height,
        output="linear" if needs_linear(job.format) else "rgba8",
    )
    encoding = time.perf_counter()
    content = encode(rendered.pixels, job.format)
    return Frame(
        content,
        {
            "plan": planned - began,
            "render": rendered.timings["render"],
            "read": rendered.timings["read"],
            "encode": time.perf_counter() - encoding,
        },
    )


def measure(renderer: Renderer, job: MeasureJob) -> tuple[Drawn, ...]:
    """Plan a frame and draw it as often as the job requires, in this process. Raises as :func:`render_frame` does."""
    plan = make_plan(job.scene, job.quality)
    drawn = []
    for draw in job.draws:
        rendered = renderer.render(
            plan, time=job.time, camera=job.camera, width=draw.width, height=draw.height, output=draw.output
        )
        drawn.append(Drawn(rendered.timings["render"], rendered.pixels if draw.keep else None))
    return tuple(drawn)


def draw_canary(renderer: Renderer) -> None:
    """Draw a small open sea and check the picture; raises :class:`NoRendererError` if it is blank.

    Drivers can fail without an error: a lost context reads as zeros.
    """
    scene = Scene()
    rendered = renderer.render(
        make_plan(scene, TIERS["draft"]),
        time=0.0,
        camera=scene.camera,
        width=CANARY_SIDE,
        height=CANARY_SIDE,
        output="rgba8",
    )
    if np.ptp(rendered.pixels[..., :3]) == 0:
        raise NoRendererError(f"{renderer.info['renderer']} draws blank frames; update or reinstall its driver")


@dataclass(frozen=True, slots=True)
class _Unavailable:
    """Response of a worker without a renderer."""

    remedy: str


@dataclass(frozen=True, slots=True)
class _Failed:
    """Response of a worker that raised an error; not all exceptions can be pickled."""

    traceback: str


@dataclass(frozen=True, slots=True)
class _Expired:
    """Response to a job that reached its worker after its deadline."""


@dataclass(frozen=True, slots=True)
class _Answer(Generic[T]):
    """Response of a worker, and which worker sent it."""

    worker: int
    value: T | _Unavailable | _Failed | _Expired


_renderer: Renderer | _Unavailable = _Unavailable("this process is not a render worker")


def _start_worker(factory: Callable[[], Renderer], threads: int) -> None:
    """Initialise a worker, on its main thread. Never raises: that would break Pebble's pool permanently."""
    global _renderer
    os.environ.setdefault("LP_NUM_THREADS", str(threads))
    try:
        renderer = factory()
        draw_canary(renderer)
        _renderer = renderer
    except NoRendererError as error:
        _renderer = _Unavailable(str(error))
    except Exception as error:
        _renderer = _Unavailable(f"the renderer does not start: {error!r}")


def _work_canary() -> _Answer[dict[str, str]]:
    """Draw the test picture again and report the renderer."""
    if isinstance(_renderer, _Unavailable):
        return _Answer(os.getpid(), _renderer)
    try:
        draw_canary(_renderer)
        return _Answer(os.getpid(), dict(_renderer.info))
    except NoRendererError as error:
        return _Answer(os.getpid(), _Unavailable(str(error)))
    except Exception:
        return _Answer(os.getpid(), _Failed(traceback.format_exc()))


def _work_frame(job: FrameJob, expires: float) -> _Answer[Frame]:
    """Render one frame, unless it has expired. expires: of ``time.time()``."""
    if isinstance(_renderer, _Unavailable):
        return _Answer(os.getpid(), _renderer)
    if time.time() >= expires:
        return _Answer(os.getpid(), _Expired())
    try:
        return _Answer(os.getpid(), render_frame(_renderer, job))
    except Exception:
        return _Answer(os.getpid(), _Failed(traceback.format_exc()))


def _work_measure(job: MeasureJob, expires: float) -> _Answer[tuple[Drawn, ...]]:
    """Measure, unless the job has expired. expires: of ``time.time()``."""
    if isinstance(_renderer, _Unavailable):
        return _Answer(os.getpid(), _renderer)
    if time.time() >= expires:
        return _Answer(os.getpid(), _Expired())
    try:
        return _Answer(os.getpid(), measure(_renderer, job))
    except Exception:
        return _Answer(os.getpid(), _Failed(traceback.format_exc()))


class RenderPool:
    """Worker processes behind a bounded queue, for one event loop.

    workers: processes, each with a GL context; at least 1.
    queue: capacity of the queue, frames; absent: twice the number of workers.
    deadline: timeout of a frame, waiting included, s.
    recycle: frames after which a worker is replaced, because GL stacks leak; 0: never.
    check_seconds: interval at which an idle pool draws its test picture, and a pool without GL looks for one again.
    factory: creates the renderer, in the worker; must be importable there.
    """

    def __init__(
        self,
        *,
        workers: int = 1,
        queue: int | None = None,
        deadline: float = 10.0,
        recycle: int = 1000,
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
        self.waiting = 0
        self.active = 0
        self.restarts: Counter[Literal["deadline", "crash", "recycled"]] = Counter()
        self._recycle = recycle
        self._check_seconds = check_seconds
        self.threads = max(1, (os.cpu_count() or 1) // workers)
        """Number of threads that a software renderer can use in each worker."""
        self._initargs = (factory, self.threads)
        self._jobs_of_worker: Counter[int] = Counter()
        self._recent_seconds = 1.0
        self._processes: ProcessPool | None = None
        self._settled = asyncio.Event()
        self._slots = asyncio.Semaphore(workers)
        self._tasks: set[asyncio.Task[None]] = set()

    async def start(self) -> None:
        """Start the workers and return at once; :attr:`state` tells when they are ready."""
        self.state, self.active = "starting", 0
        # They belong to the loop that first waits for them, which after a restart is another.
        self._settled = asyncio.Event()
        self._slots = asyncio.Semaphore(self.workers)
        self._keep(self._watch())

    async def stop(self) -> None:
        """Kill the workers and wait until they have ended."""
        self.state = "stopped"
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        processes, self._processes = self._processes, None
        if processes is not None:
            await asyncio.to_thread(_discard, processes)

    async def render(self, job: FrameJob) -> Frame:
        """Render one frame in a worker.

        Raises :class:`QueueFullError`, :class:`DeadlineError`, :class:`RendererUnavailableError` or
        :class:`RenderFailedError`. If the call is cancelled while it waits, it leaves the queue; a frame
        that is being rendered is finished, because stopping it would kill the worker.
        """
        began = time.time()
        expires = began + self.deadline
        await self._admit(expires)
        frame = await self._run(_work_frame, (job, expires), expires)
        worked = sum(frame.timings.values())
        self._recent_seconds += 0.2 * (worked - self._recent_seconds)
        return replace(frame, timings={"queue": max(0.0, time.time() - began - worked), **frame.timings})

    async def measure(self, job: MeasureJob) -> tuple[Drawn, ...]:
        """Measure in a worker, in turn with the frames, without taking a place in their queue.

        Raises what :meth:`render` raises, except for a full queue.
        """
        expires = time.time() + MEASURE_SECONDS
        await self.wait_until_settled()
        await self._take_worker(expires)
        return await self._run(_work_measure, (job, expires), expires)

    async def wait_until_settled(self) -> None:
        """Wait until the state of the renderer is known; raises what :meth:`render` raises if there is none."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(self.deadline):
                await self._settled.wait()
        if self.state == "starting":
            raise DeadlineError(f"timeout: the renderer did not start within {self.deadline:g} s")
        if self.state != "ready":
            raise RendererUnavailableError(self.remedy or "the renderer is stopped")

    async def _admit(self, expires: float) -> None:
        """Wait in the queue for a free worker, and reserve it."""
        if self.state in ("unavailable", "stopped"):
            raise RendererUnavailableError(self.remedy or "the renderer is stopped")
        if self.waiting >= self.queue and (self.state == "starting" or self._slots.locked()):
            ahead = math.ceil(self._recent_seconds * (self.waiting + 1) / self.workers)
            raise QueueFullError(self.waiting, max(EARLIEST_RETRY, ahead))
        self.waiting += 1
        try:
            await self.wait_until_settled()
            await self._take_worker(expires)
        finally:
            self.waiting -= 1

    async def _take_worker(self, expires: float) -> None:
        try:
            async with asyncio.timeout(max(0.0, expires - time.time())):
                await self._slots.acquire()
        except TimeoutError:
            raise DeadlineError(f"timeout: no render worker was free within {self.deadline:g} s") from None

    async def _run(self, work: Callable[..., _Answer[T]], args: tuple[Any, ...], expires: float) -> T:
        """Run work in the reserved worker, which is released when it is idle again."""
        try:
            answer = await self._attempt(work, args, expires)
        except (ProcessExpired, BrokenProcessPool, CancelledFuture) as error:
            # A frame is a pure function of its job, so a dead worker is no reason to fail before a second try.
            log.warning("A render worker died: %r", error)
            await self._take_worker(expires)
            try:
                answer = await self._attempt(work, args, expires)
            except (ProcessExpired, BrokenProcessPool, CancelledFuture) as again:
                raise RenderFailedError("the render worker crashed twice") from again
        return self._accept(answer)

    async def _attempt(self, work: Callable[..., _Answer[T]], args: tuple[Any, ...], expires: float) -> _Answer[T]:
        try:
            future = self._schedule(work, args, max(0.01, expires - time.time()))
        except BaseException:
            self._slots.release()
            raise
        loop = asyncio.get_running_loop()
        self.active += 1
        future.add_done_callback(lambda _: loop.call_soon_threadsafe(self._free))
        wrapped = asyncio.wrap_future(future)
        # Marks a failure as seen: nobody may be left to see it.
        wrapped.add_done_callback(lambda done: done.cancelled() or done.exception())
        try:
            done, _ = await asyncio.wait({wrapped}, timeout=max(0.0, expires - time.time()))
            if not done:
                raise TimeoutError
            return wrapped.result()
        except TimeoutError:
            # Pebble counts from where the worker starts on the job, so the deadline passes here first.
            if future.running() or future.done():
                self.restarts["deadline"] += 1
            self._keep(self._replace_if_stuck(future))
            raise DeadlineError(f"timeout: the frame was not finished within {self.deadline:g} s") from None
        except (ProcessExpired, BrokenProcessPool, CancelledFuture):
            self.restarts["crash"] += 1
            raise

    def _accept(self, answer: _Answer[T]) -> T:
        self._jobs_of_worker[answer.worker] += 1
        if self._jobs_of_worker[answer.worker] == self._recycle:
            del self._jobs_of_worker[answer.worker]
            self.restarts["recycled"] += 1
        value = answer.value
        if isinstance(value, _Unavailable):
            self._give_up(value.remedy)
            raise RendererUnavailableError(value.remedy)
        if isinstance(value, _Failed):
            log.error("A frame failed:\n%s", value.traceback)
            raise RenderFailedError("the renderer failed; the server log has the details")
        if isinstance(value, _Expired):
            raise DeadlineError(f"timeout: the frame was not started within {self.deadline:g} s")
        self.succeeded_at = time.time()
        return value

    def _schedule(self, work: Callable[..., _Answer[T]], args: tuple[Any, ...], timeout: float) -> Future[_Answer[T]]:
        if self._processes is not None:
            try:
                return self._processes.schedule(work, args, timeout=timeout)
            except RuntimeError:
                # Pebble gives a pool up for good when a worker dies that had nothing to do.
                self.restarts["crash"] += 1
                self._drop_processes()
        self._processes = self._new_processes()
        return self._processes.schedule(work, args, timeout=timeout)

    def _new_processes(self) -> ProcessPool:
        return ProcessPool(
            max_workers=self.workers,
            max_tasks=self._recycle,
            initializer=_start_worker,
            initargs=self._initargs,
            context=multiprocessing.get_context("spawn"),
        )

    def _drop_processes(self) -> None:
        processes, self._processes = self._processes, None
        if processes is not None:
            self._keep(asyncio.to_thread(_discard, processes))

    def _free(self) -> None:
        self.active -= 1
        self._slots.release()

    async def _replace_if_stuck(self, future: Future[_Answer[T]]) -> None:
        await asyncio.sleep(STUCK_SECONDS)
        if not future.done():
            log.error("A render worker could not be stopped; all of them are replaced")
            self._drop_processes()

    async def _watch(self) -> None:
        """Draw a test picture at the start, and again whenever nothing was drawn for a while."""
        while True:
            if self.state != "ready" or (
                time.time() - self.succeeded_at >= self._check_seconds and not self._slots.locked()
            ):
                await self._check()
            await asyncio.sleep(self._check_seconds)

    async def _check(self) -> None:
        await self._slots.acquire()
        try:
            self.info = await self._run(_work_canary, (), time.time() + START_SECONDS)
            self.state, self.remedy = "ready", ""
        except RendererUnavailableError as error:
            log.warning("No renderer: %s", error)
        except RenderError as error:
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


def _discard(processes: ProcessPool) -> None:
    processes.stop()  # type: ignore[no-untyped-call]
    processes.join()
