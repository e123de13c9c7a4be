"""State that the request handlers of an application share."""

import asyncio
from typing import Annotated

from fastapi import Depends, Request

from seafoam.accuracy.cache import cache_dir
from seafoam.accuracy.model import Running, Sweep
from seafoam.accuracy.sweep import Subject
from seafoam.api.frames.plans import REQUESTS_KEPT, CompiledPlan, PlanIndex, RequestCache, compile_scene
from seafoam.api.frames.streams import Streams
from seafoam.api.jobs import PoolWorkers, ThreadPool, sweep_service
from seafoam.api.settings import Settings
from seafoam.api.watch.metrics import Metrics, Traces
from seafoam.extras import require
from seafoam.quality import Quality
from seafoam.render.service.frame_cache import FrameCache
from seafoam.scene.models import Scene
from seafoam.sequences.service import SequenceService


class Context:
    """What handlers share, for the running event loop, on which sweeps and sequences are drawn.

    frames: gives the pool's frames, and those that it has drawn before. traces: where spans go, if anywhere.
    """

    def __init__(self, settings: Settings, frames: FrameCache, metrics: Metrics, traces: Traces | None) -> None:
        loop = asyncio.get_running_loop()
        self.settings = settings
        self.pool = frames.pool
        self.frames = frames
        self.plan_index = PlanIndex(frames.disk)
        """The plans that have addresses."""
        self.request_cache = RequestCache(REQUESTS_KEPT)
        self.metrics = metrics
        self.traces = traces
        # Apart, so that a mask, which takes seconds, delays no plan, and one that takes minutes no other mask.
        self.plans, self.masks, self.slow_masks = ThreadPool(2, 64), ThreadPool(1, 8), ThreadPool(1, 2)
        self.sweeps = sweep_service(settings, self.pool, loop)
        workers, directory = PoolWorkers(self.pool, loop), (settings.cache or cache_dir()) / "sequences"
        bounds = {"waiting": settings.sequences_waiting, "kept": settings.sequences_kept}
        self.sequences = SequenceService(directory, lambda: workers, **bounds)
        self.streams = Streams(settings.streams)
        self.ahead: asyncio.Task[None] | None = None
        """Compiles the presets' programs ahead, if the settings say so."""

    async def compiled(self, scene: Scene, quality: Quality) -> CompiledPlan:
        """Run :func:`compile_scene` in a thread."""
        return await self.plans.run(compile_scene, scene, quality)

    async def addressed(self, scene: Scene, quality: Quality) -> CompiledPlan:
        """Compile a scene, and let its plan's hash be an address of its frames."""
        compiled = await self.compiled(scene, quality)
        if not self.plan_index.holds(compiled.sha256):
            await self.plans.run(self.plan_index.remember, compiled.sha256, scene, quality)
        return compiled

    async def measured(self, subject: Subject) -> Sweep | Running:
        """Return the sweep of a subject, or its progress. Raises the pool's errors if no renderer is available.

        Raises :class:`seafoam.extras.MissingExtraError` without the packages of the extra ``reports``.
        """
        require("reports")
        await self.pool.wait_until_settled()
        return await self.plans.run(self.sweeps.sweep, subject)


def _context(request: Request) -> Context:
    context: Context = request.app.state.context
    return context


InContext = Annotated[Context, Depends(_context)]
