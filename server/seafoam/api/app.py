"""Assembles the application: routers, errors, limits and the render pool."""

import asyncio
import os
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from functools import partial
from importlib.metadata import version

from fastapi import FastAPI
from starlette.middleware import Middleware
from starlette.middleware.errors import ServerErrorMiddleware
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from seafoam.accuracy.cache import cache_dir
from seafoam.api import site
from seafoam.api.context import Context
from seafoam.api.frames.respond import AnswerFromMemory
from seafoam.api.guard.access_control import AccessControl, OtherOrigins, TokenBuckets
from seafoam.api.guard.proxy_headers import Proxied
from seafoam.api.http import answers, errors
from seafoam.api.http.middleware import AnswerWhenStopped, HeadAsGet, LimitBody, SecurityHeaders
from seafoam.api.http.problems import BusyError
from seafoam.api.routers import accuracy, export, frames, health, masks, presets, sequences, streams, textures
from seafoam.api.settings import Settings
from seafoam.api.watch.metrics import Metrics, WatchRequests, telemetry
from seafoam.render.ahead import compile_ahead
from seafoam.render.gl.executor import Executor
from seafoam.render.service.frame_cache import DiskCache, FrameCache
from seafoam.render.service.jobs import Renderer
from seafoam.render.service.pool import RenderPool

GZIP_LEVEL = 4
"""Level 4 compresses plans to a tenth; level 9 gains little more."""
NOT_WORTH_GZIP = (
    *DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream", "application/x-npy", "application/zip", "image/*",
    "font/*", "video/*",
)  # fmt: skip


_DESCRIPTION = """
Water with halftoned foam, after Yingst, Alford and Parberry (2011).

A **scene** describes the water, its foam, the light and the camera; a **quality** says how exactly to compute them.
Both are compiled into a **frame plan**, which the server and the browser execute alike. A frame depends only on scene,
quality, camera, size and time, so the same request returns the same bytes. Units are SI units and radians; +y points
up. Numbers in addresses are written as `12`, `-0.5` or `1e3`: no spaces, underscores or other digits.
Errors are `application/problem+json` (RFC 9457) and name the field and its allowed values.
"""


def create_app(settings: Settings | None = None, *, renderer: Callable[[], Renderer] | None = None) -> FastAPI:
    """Create the server's application.

    settings: absent: read from the environment. renderer: factory of the workers' renderer, absent: the GL executor;
    must be importable, because the workers are spawned. Raises :class:`MissingExtraError`
    where ``OTEL_*`` variables ask for what is not there.
    """
    settings = settings or Settings()
    factory = renderer or partial(Executor, settings.device_index)
    # A worker with a core beside its own compiles on both.
    beside = settings.workers < (os.cpu_count() or 1)
    workers_factory = renderer or partial(Executor, settings.device_index, assisted=beside)
    pool = RenderPool(
        workers=settings.workers,
        queue=settings.queue,
        deadline=settings.deadline,
        recycle=settings.recycle,
        check_seconds=settings.canary,
        factory=workers_factory,
    )
    disk = DiskCache((settings.cache or cache_dir()) / "frames", settings.cache_size) if settings.cache_size else None
    frame_cache = FrameCache(pool, disk, settings.cache_memory)
    metrics = Metrics(pool, frame_cache)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        context = app.state.context = Context(settings, frame_cache, metrics)
        await pool.start()
        warming = [asyncio.create_task(presets.warm(context.plans))]
        if settings.compile_ahead:
            warming.append(asyncio.create_task(compile_ahead(pool, factory)))
        yield
        for task in warming:
            task.cancel()
            with suppress(asyncio.CancelledError, BusyError):
                await task
        await asyncio.to_thread(context.sweeps.stop)
        await asyncio.to_thread(context.sequences.stop)
        await pool.stop()

    app = FastAPI(
        title="Seafoam",
        version=version("seafoam"),
        description=_DESCRIPTION,
        # Relative to the document, wherever a proxy serves it.
        servers=[{"url": "."}],
        docs_url=None,
        redoc_url=None,
        # A scene is one type in the clients' code, whichever way it travels.
        separate_input_output_schemas=False,
        lifespan=lifespan,
        middleware=_middleware(settings, metrics),
        telemetry=telemetry(),
    )
    own = (each.router for each in (frames, streams, sequences, accuracy, masks, textures, export))
    for router in (presets.router, presets.plans, *own):
        app.include_router(router, responses=answers.problems(400, 401, 429, 500))
    app.include_router(health.router)
    errors.install(app)
    site.install(app)
    answers.install(app)
    return app


def _middleware(settings: Settings, metrics: Metrics) -> list[Middleware]:
    """Return what a request passes, from the outside in."""
    rates = TokenBuckets(settings.rate, settings.rate_burst) if settings.rate else None
    return [
        Middleware(Proxied, trusted=settings.trusted_proxies, root_path=settings.root_path.rstrip("/")),
        Middleware(WatchRequests, metrics=metrics, logged=settings.log_format == "json"),
        Middleware(OtherOrigins, public=not settings.access.restricted, origins=settings.cors_origins),
        Middleware(HeadAsGet),
        Middleware(SecurityHeaders),
        Middleware(AccessControl, access=settings.access, rates=rates),
        Middleware(AnswerWhenStopped),
        # Starlette's own lies outside of all these, and its answer lacks their headers.
        Middleware(ServerErrorMiddleware, handler=errors.unexpected),
        Middleware(AnswerFromMemory),
        Middleware(GZipMiddleware, compresslevel=GZIP_LEVEL, exclude_content_types=NOT_WORTH_GZIP),
        Middleware(LimitBody, limit=settings.max_body),
    ]
