"""Rendering apart from the web server: worker processes that each own one GL context.

A GL call holds Python's lock until the picture is read, a context belongs to one thread for life, and a driver that
hangs or crashes takes its process along. So the parent never touches GL: spawned workers do, and they are killed and
replaced when a frame outlasts its deadline.

Errors::

    RenderError
    ├── FrameTooLargeError        asked for more than the limits allow
    ├── QueueFullError            as many frames wait as may
    ├── DeadlineError             not finished in time, waiting included
    ├── RendererUnavailableError  no usable GL, with the remedy
    └── RenderFailedError         the worker raised, or died twice
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
"""Side of the picture that a new worker draws to show that it can, pixels."""
START_SECONDS = 60.0
"""Within which a worker has drawn its canary, or the renderer counts as unusable."""
STUCK_SECONDS = 10.0
"""After its deadline; a worker that Pebble has not killed by then costs the whole pool."""
MEASURE_SECONDS = 120.0
"""Within which a measurement is finished, waiting included: one draws a point of a sweep once or twice."""
EARLIEST_RETRY = 1
"""Seconds, the least to wait before asking again when the queue is full."""

State = Literal["starting", "ready", "unavailable", "stopped"]

T = TypeVar("T")


class RenderError(Exception):
    """Base of what keeps a frame from being rendered."""


class FrameTooLargeError(RenderError):
    """Asked for more than the limits allow. ``field`` names what to lower; its bounds are inclusive."""

    def __init__(self, field: Literal["width", "height", "quality"], detail: str, least: int, greatest: int) -> None:
        super().__init__(detail)
        self.field = field
        self.least = least
        self.greatest = greatest


class QueueFullError(RenderError):
    """As many frames wait as may; ask again after ``retry_after`` seconds."""

    def __init__(self, waiting: int, retry_after: int) -> None:
        super().__init__(f"{waiting} frames are waiting already, as many as may wait")
        self.retry_after = retry_after


class DeadlineError(RenderError):
    """A frame was not finished in time, waiting included."""


class RendererUnavailableError(RenderError):
    """No usable GL. The text says how to get one."""


class RenderFailedError(RenderError):
    """A worker raised, or died while rendering."""


@dataclass(frozen=True, slots=True)
class FrameLimits:
    """The largest frame that is rendered. Checked before anything is allocated."""

    side: int = 4096
    """Width and height, pixels."""
    sampled_side: int = 8192
    """Width and height times samples along them: what every supported GL can draw into."""
    samples: int = 8_400_000
    """Width × height × samples a pixel."""

    def allows(self, width: int, height: int, samples: int) -> bool:
        """Whether :meth:`check` lets a frame pass."""
        try:
            self.check(width, height, samples)
        except FrameTooLargeError:
            return False
        return True

    def check(self, width: int, height: int, samples: int) -> None:
        """Raise :class:`FrameTooLargeError` naming the field to lower; ``samples``: drawn for a pixel."""
        along = math.isqrt(samples)
        side = min(self.side, self.sampled_side // along)
        sides: tuple[tuple[Literal["width", "height"], int], ...] = (("width", width), ("height", height))
        for field, value in sides:
            if not 1 <= value <= side:
                why = "" if side == self.side else f" at {samples} samples a pixel"
                raise FrameTooLargeError(field, f"{field} must be 1 to {side} pixels{why}, not {value}", 1, side)
        asked = width * height * samples
        if asked > self.samples:
            most = max(1, self.samples // (width * samples))
            raise FrameTooLargeError(
                "height",
                f"{width} × {height} pixels of {samples} samples are {asked:,} samples; at most {self.samples:,} are "
                f"rendered: lower width, height or the samples of quality",
                1,
                most,
            )


@dataclass(frozen=True, slots=True)
class FrameJob:
    """One frame to render: all that its bytes depend on."""

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
    """An encoded frame and where its time went: seconds by ``queue``, ``plan``, ``render``, ``read``, ``encode``."""

    content: bytes
    timings: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Draw:
    """One drawing of a measurement. ``keep``: whether its pixels come back."""

    width: int
    height: int
    output: Literal["rgba8", "linear"]
    keep: bool = False


@dataclass(frozen=True, slots=True)
class MeasureJob:
    """A frame to draw several times over, to be timed rather than seen."""

    scene: Scene
    quality: Quality
    time: float
    """Seconds of the scene."""
    camera: Camera
    draws: tuple[Draw, ...]


@dataclass(frozen=True, slots=True)
class Drawn:
    """What one drawing took, from the first call until it was finished, and its pixels where they were wanted."""

    seconds: float
    pixels: NDArray[Any] | None


class Rendered(Protocol):
    """What a renderer returns."""

    @property
    def pixels(self) -> NDArray[Any]:
        """(height, width, 4), rows from the top; uint8 or, linear, float32."""

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
    """Plan a frame and draw it as often as the job says, in this process. Raises what :func:`render_frame` raises."""
    plan = make_plan(job.scene, job.quality)
    drawn = []
    for draw in job.draws:
        rendered = renderer.render(
            plan, time=job.time, camera=job.camera, width=draw.width, height=draw.height, output=draw.output
        )
        drawn.append(Drawn(rendered.timings["render"], rendered.pixels if draw.keep else None))
    return tuple(drawn)


def draw_canary(renderer: Renderer) -> None:
    """Draw a small open sea and see that it is a picture; raises :class:`NoRendererError` if it is blank.

    Drivers fail without an error: a lost context reads as zeros.
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
        raise NoRendererError(f"{renderer.info['renderer']} draws blank pictures: update or reinstall its driver")


@dataclass(frozen=True, slots=True)
class _Unavailable:
    """Answer of a worker without a renderer."""

    remedy: str


@dataclass(frozen=True, slots=True)
class _Failed:
    """Answer of a worker that raised; exceptions themselves do not all survive pickling."""

    traceback: str


@dataclass(frozen=True, slots=True)
class _Expired:
    """Answer to a job that reached its worker after its deadline."""


@dataclass(frozen=True, slots=True)
class _Answer(Generic[T]):
    """What a worker sends back, and which worker it was."""

    worker: int
    value: T | _Unavailable | _Failed | _Expired


_renderer: Renderer | _Unavailable = _Unavailable("this process has not been set up as a render worker")


def _start_worker(factory: Callable[[], Renderer], threads: int) -> None:
    """Set a worker up, on its main thread. Never raises: an initializer that fails breaks Pebble's pool for good."""
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
    """Draw the canary again and report the renderer."""
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
    """Render one frame, unless nobody waits for it any more. expires: of ``time.time()``."""
    if isinstance(_renderer, _Unavailable):
        return _Answer(os.getpid(), _renderer)
    if time.time() >= expires:
        return _Answer(os.getpid(), _Expired())
    try:
        return _Answer(os.getpid(), render_frame(_renderer, job))
    except Exception:
        return _Answer(os.getpid(), _Failed(traceback.format_exc()))


def _work_measure(job: MeasureJob, expires: float) -> _Answer[tuple[Drawn, ...]]:
    """Measure, unless nobody waits for it any more. expires: of ``time.time()``."""
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
    queue: frames that may wait for a worker; absent: twice the workers.
    deadline: seconds that a frame may take, waiting included.
    recycle: frames after which a worker is replaced, because GL stacks leak; 0: never.
    check_seconds: how often an idle pool draws its canary, and a pool without GL looks for one again.
    factory: makes the renderer, in the worker; must be importable there.
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
        """Why there is no renderer and what to do, where the state is ``unavailable``."""
        self.succeeded_at = -math.inf
        """When a canary or frame was last drawn, of ``time.time()``."""
        self.waiting = 0
        self.active = 0
        self.restarts: Counter[Literal["deadline", "crash", "recycled"]] = Counter()
        self._recycle = recycle
        self._check_seconds = check_seconds
        self.threads = max(1, (os.cpu_count() or 1) // workers)
        """That a software renderer may use in each worker."""
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
        """Kill the workers and wait until they are gone."""
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
        :class:`RenderFailedError`. Cancelling the call while it waits gives its place in the queue back; a frame
        that is being rendered is finished, because stopping it would cost the worker.
        """
        began = time.time()
        expires = began + self.deadline
        await self._admit(expires)
        frame = await self._run(_work_frame, (job, expires), expires)
        worked = sum(frame.timings.values())
        self._recent_seconds += 0.2 * (worked - self._recent_seconds)
        return replace(frame, timings={"queue": max(0.0, time.time() - began - worked), **frame.timings})

    async def measure(self, job: MeasureJob) -> tuple[Drawn, ...]:
        """Measure in a worker, in turn with the frames, whose queue it takes no place of.

        Raises what :meth:`render` raises, except for a full queue.
        """
        expires = time.time() + MEASURE_SECONDS
        await self.wait_until_settled()
        await self._take_worker(expires)
        return await self._run(_work_measure, (job, expires), expires)

    async def wait_until_settled(self) -> None:
        """Wait until it is known whether there is a renderer; raises what :meth:`render` raises if there is none."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(self.deadline):
                await self._settled.wait()
        if self.state == "starting":
            raise DeadlineError(f"the renderer did not start within {self.deadline:g} s")
        if self.state != "ready":
            raise RendererUnavailableError(self.remedy or "the renderer is stopped")

    async def _admit(self, expires: float) -> None:
        """Wait in the queue for a free worker, and take it."""
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
            raise DeadlineError(f"no worker was free within {self.deadline:g} s") from None

    async def _run(self, work: Callable[..., _Answer[T]], args: tuple[Any, ...], expires: float) -> T:
        """Run work in the worker that was taken; it is given back when it is free again."""
        try:
            answer = await self._attempt(work, args, expires)
        except (ProcessExpired, BrokenProcessPool, CancelledFuture) as error:
            # A frame is a pure function of its job, so a dead worker is no reason to fail before a second try.
            log.warning("A render worker died: %r", error)
            await self._take_worker(expires)
            try:
                answer = await self._attempt(work, args, expires)
            except (ProcessExpired, BrokenProcessPool, CancelledFuture) as again:
                raise RenderFailedError("the worker that rendered died, twice") from again
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
            raise DeadlineError(f"the frame was not finished within {self.deadline:g} s") from None
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
            raise RenderFailedError("the renderer raised an error, which the server's log has")
        if isinstance(value, _Expired):
            raise DeadlineError(f"the frame was not started within {self.deadline:g} s")
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
            log.error("A render worker cannot be stopped: replacing all of them")
            self._drop_processes()

    async def _watch(self) -> None:
        """Draw a canary at the start, and again whenever nothing was drawn for a while."""
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
        """Run a coroutine as a task that is not collected before it ends."""
        task: asyncio.Task[None] = asyncio.ensure_future(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


def _discard(processes: ProcessPool) -> None:
    processes.stop()  # type: ignore[no-untyped-call]
    processes.join()
