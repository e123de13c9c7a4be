"""Sweeps of accuracy: the service that measures them on an application's render pool, and requests for them."""

import asyncio
import math
from concurrent.futures import TimeoutError as NotYet

from seafoam.accuracy.cache import Store
from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Rig, SweepSettings
from seafoam.accuracy.sweep_service import SweepService
from seafoam.accuracy.truth import SweepStoppedError
from seafoam.api.settings import Settings
from seafoam.render.service.errors import RendererUnavailableError
from seafoam.render.service.jobs import Drawn, MeasureJob
from seafoam.render.service.pool import RenderPool

LONGEST_WAIT = 15
"""Maximum delay between requests for a running measurement, s."""
_POLL_SECONDS = 0.2


def sweep_service(settings: Settings, pool: RenderPool, loop: asyncio.AbstractEventLoop) -> SweepService:
    """Return a service that measures on the pool; coroutines run on ``loop``."""

    def measure(job: MeasureJob) -> tuple[Drawn, ...]:
        future = asyncio.run_coroutine_threadsafe(pool.measure(job), loop)
        while True:
            try:
                return future.result(_POLL_SECONDS)
            except NotYet:
                # Also what a coroutine that timed out raises, which has nothing to wait for.
                if future.done():
                    raise
                if service.stopped:
                    future.cancel()
                    raise SweepStoppedError from None

    def rig() -> Rig:
        if pool.state != "ready":
            raise RendererUnavailableError(pool.remedy or "the renderer is not ready")
        return Rig(measure, pool.info, pool.threads)

    sizes = (settings.accuracy_width, settings.accuracy_height, settings.accuracy_samples, settings.accuracy_rounds)
    service = SweepService(Store(settings.cache), SweepSettings(*sizes), rig)
    return service


def retry_seconds(running: Running) -> int:
    """Return the delay before the next request, s."""
    return max(1, min(LONGEST_WAIT, math.ceil(running.eta_s or 2.0)))
