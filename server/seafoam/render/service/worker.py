"""Code of worker processes: one renderer, and a function for each kind of job."""

import logging
import os
import signal
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import NoReturn, TypeVar

import numpy as np

from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import NoRendererError
from seafoam.render.service.errors import DeadlineError, RenderError, RendererUnavailableError, RenderFailedError
from seafoam.render.service.jobs import Drawn, FrameJob, MeasureJob, Picture, Renderer, draw_frame, measure
from seafoam.render.service.shared_buffer import BufferAddress, send
from seafoam.scene import Scene, load_preset

log = logging.getLogger(__name__)

CANARY_SIDE = 20
"""Side of the test picture that a new worker draws, pixels. It is no power of two, nor is its half, third or quarter: a
software driver would compile other programs for those than for most pictures."""

T = TypeVar("T")


def draw_canary(renderer: Renderer, scene: Scene | None = None, quality: Quality = TIERS["fast"]) -> None:
    """Draw a scene small and check the picture; raises :class:`NoRendererError` if it is blank.

    Drivers can fail without an error: a lost context reads as zeros. scene: absent: an open sea.
    """
    scene = scene or Scene()
    plan, side = make_plan(scene, quality), CANARY_SIDE
    rendered = renderer.render(plan, time=0.0, camera=scene.camera, width=side, height=side, output="rgba8")
    if np.ptp(rendered.pixels[..., :3]) == 0:
        raise NoRendererError(f"{renderer.info['renderer']} draws blank frames; update or reinstall its driver")


_renderer: Renderer | RendererUnavailableError = RendererUnavailableError("this process is not a render worker")


def start_worker(factory: Callable[[], Renderer], threads: int) -> None:
    """Initialise a worker, on its main thread. Never raises: that would break Pebble's pool permanently."""
    global _renderer
    os.environ.setdefault("LP_NUM_THREADS", str(threads))
    try:
        renderer = factory()
        draw_canary(renderer)
        _renderer = renderer
    except NoRendererError as error:
        _renderer = RendererUnavailableError(str(error))
    except Exception as error:
        _renderer = RendererUnavailableError(f"the renderer does not start: {error!r}")


def work_canary() -> dict[str, str] | RenderError:
    """Draw what the page opens with, small, so that its programs are compiled, and report the renderer."""
    if isinstance(_renderer, RendererUnavailableError):
        return _renderer
    try:
        draw_canary(_renderer, load_preset("default").scene, TIERS["fast"])
        return dict(_renderer.info)
    except Exception:
        _give_way()


def _give_way() -> NoReturn:
    """End this process after an error that another one may not have: the pool tries the job there."""
    log.exception("A render worker gives way to another")
    os._exit(1)


def _failed(renderer: Renderer, error: Exception) -> RenderFailedError:
    """Return the response to an error, if there is memory left and the renderer still draws; else end this process."""
    if isinstance(error, MemoryError):
        _give_way()
    failed = RenderFailedError(traceback.format_exc())
    try:
        draw_canary(renderer)
    except Exception:
        _give_way()
    return failed


_compiled: set[tuple[str, str]] = set()
"""Hashes of the programs that this process has drawn."""


def _compile(renderer: Renderer, job: FrameJob) -> None:
    """Draw a frame small, where it has programs that this process has not drawn: drivers compile at the first draw.

    On a slow machine that takes longer than a frame may. A process that is stopped while it compiles leaves nothing to
    the next one.
    """
    programs = {(each.vertex.sha256, each.fragment.sha256) for plan in job.plans for each in plan.programs.values()}
    if not programs <= _compiled:
        draw_frame(renderer, replace(job, width=CANARY_SIDE, height=CANARY_SIDE))
        _compiled.update(programs)


@contextmanager
def _ended_at(expires: float) -> Iterator[None]:
    """End this process if it is late. By the system's timer: a driver that hangs holds Python's lock."""
    signal.setitimer(signal.ITIMER_REAL, max(0.001, expires - time.time()))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)


def _answer(expires: float, work: Callable[[Renderer], T]) -> T | RenderError:
    """Do work, unless it arrives too late (``expires``: of ``time.time()``). work: may raise DeadlineError itself.

    Returned, since not all exceptions can be pickled: :class:`RendererUnavailableError`, :class:`DeadlineError` of a
    job that arrived too late, or :class:`RenderFailedError` with the traceback.
    """
    if isinstance(_renderer, RendererUnavailableError):
        return _renderer
    try:
        _check_time(expires)
        return work(_renderer)
    except DeadlineError as error:
        return error
    except Exception as error:
        return _failed(_renderer, error)


def _check_time(expires: float) -> None:
    if time.time() >= expires:
        raise DeadlineError("the job has expired")


def work_frame(job: FrameJob, expires: float, buffer: BufferAddress) -> Picture | RenderError:
    """Render one frame, unless it has expired; the parent encodes it, beside the next.

    expires: of ``time.time()``; from then on the process may only compile. buffer: the parent's memory for the pixels.
    """

    def draw(renderer: Renderer) -> Picture:
        _compile(renderer, job)
        _check_time(expires)
        with _ended_at(expires):
            drawn = draw_frame(renderer, job)
            if not drawn.pixels.any():
                # A night may be black in float32; a lost context is, without an error.
                draw_canary(renderer)
        return replace(drawn, pixels=send(drawn.pixels, buffer))

    return _answer(expires, draw)


def work_measure(job: MeasureJob, expires: float) -> tuple[Drawn, ...] | RenderError:
    """Measure, unless the job has expired. expires: of ``time.time()``."""

    def draw(renderer: Renderer) -> tuple[Drawn, ...]:
        drawn = measure(renderer, job)
        # A lost context takes time too, and draws zeros, without an error.
        draw_canary(renderer)
        return drawn

    return _answer(expires, draw)
