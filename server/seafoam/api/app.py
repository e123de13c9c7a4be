"""Assembles the application: routers, errors, limits and the render pool."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from functools import partial
from importlib.metadata import version
from typing import Any

from fastapi import Depends, FastAPI
from fastapi.openapi.utils import get_openapi
from starlette.middleware import Middleware
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from seafoam.api import errors, pages
from seafoam.api.context import Context
from seafoam.api.errors import Problem, problem_responses
from seafoam.api.measuring import sweep_service
from seafoam.api.metrics import MeasureRequests, Metrics
from seafoam.api.middleware import HeadAsGet, LimitBody, SecurityHeaders
from seafoam.api.parameters import one_value_each
from seafoam.api.routers import accuracy, export, frames, health, masks, plans, presets, scenes, sequences, textures
from seafoam.api.sequencing import sequence_service
from seafoam.api.settings import Settings
from seafoam.api.threads import ThreadPool
from seafoam.quality import QualityExtensions
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import Renderer
from seafoam.render.service.pool import RenderPool
from seafoam.scene.models import SceneExtensions

GZIP_LEVEL = 4
"""Level 4 compresses plans to a tenth; level 9 gains little more."""
NOT_WORTH_GZIP = (
    *DEFAULT_EXCLUDED_CONTENT_TYPES,
    "application/octet-stream",
    "application/x-npy",
    "application/zip",
    "image/*",
    "font/*",
    "video/*",
)

_DESCRIPTION = """
Water with halftoned foam, after Yingst, Alford and Parberry (2011).

A **scene** describes the water, its foam, the light and the camera; a **quality** says how exactly to compute them.
Both are compiled into a **frame plan**, which the server and the browser execute alike. A frame depends only on scene,
quality, camera, size and time, so the same request returns the same bytes. Units are SI units and radians; +y points
up. Errors are `application/problem+json` (RFC 9457) and name the field and its allowed values.
"""


def create_app(settings: Settings | None = None, *, renderer: Callable[[], Renderer] | None = None) -> FastAPI:
    """Create the server's application.

    settings: absent: read from the environment. renderer: factory of the workers' renderer, absent: the GL executor;
    must be importable, because the workers are spawned.
    """
    settings = settings or Settings()
    pool = RenderPool(
        workers=settings.workers,
        queue=settings.queue,
        deadline=settings.deadline,
        recycle=settings.recycle,
        factory=renderer or partial(Executor, settings.device_index),
    )
    metrics = Metrics(pool)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        sweeps = sweep_service(settings, pool, asyncio.get_running_loop())
        sequences_made = sequence_service(settings, pool, asyncio.get_running_loop())
        app.state.context = Context(
            settings,
            pool,
            metrics,
            plans=ThreadPool(2, 64),
            masks=ThreadPool(1, 8),
            sweeps=sweeps,
            sequences=sequences_made,
        )
        await pool.start()
        warming = asyncio.create_task(presets.warm(app.state.context.plans))
        yield
        warming.cancel()
        with suppress(asyncio.CancelledError, errors.BusyError):
            await warming
        await asyncio.to_thread(sweeps.stop)
        await asyncio.to_thread(sequences_made.stop)
        await pool.stop()

    app = FastAPI(
        title="Seafoam",
        version=version("seafoam"),
        description=_DESCRIPTION,
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
        dependencies=[Depends(one_value_each)],
        middleware=[
            Middleware(HeadAsGet),
            Middleware(SecurityHeaders),
            Middleware(MeasureRequests, metrics=metrics),
            Middleware(GZipMiddleware, compresslevel=GZIP_LEVEL, exclude_content_types=NOT_WORTH_GZIP),
            Middleware(LimitBody, limit=settings.max_body),
        ],
    )
    for router in (
        presets.router,
        scenes.router,
        plans.router,
        frames.router,
        sequences.router,
        accuracy.router,
        masks.router,
        textures.router,
        export.router,
    ):
        app.include_router(router, responses=problem_responses(400, 500))
    app.include_router(health.router)
    errors.install(app)
    pages.install(app)
    _describe(app, settings)
    return app


def _describe(app: FastAPI, settings: Settings) -> None:
    """Add the problem schema and the limits from the settings to the OpenAPI document."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            document = get_openapi(
                title=app.title,
                version=app.version,
                description=app.description,
                routes=app.routes,
                # A scene is one type in the clients' code, whichever way it travels.
                separate_input_output_schemas=False,
            )
            schemas = document["components"]["schemas"]
            problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
            schemas |= problem.pop("$defs") | {"Problem": problem}
            for unused in (one for one in (SceneExtensions, QualityExtensions) if not one.known):
                del schemas[unused.__name__]
            frame = document["paths"]["/api/frames/{preset}.{format}"]["get"]
            sides = [schemas["FrameRequest"]["properties"][name] for name in ("width", "height")]
            sides += [
                parameter["schema"] for parameter in frame["parameters"] if parameter["name"] in ("width", "height")
            ]
            for schema in sides:
                for alternative in schema.get("anyOf", [schema]):
                    if alternative["type"] == "integer":
                        alternative["maximum"] = settings.max_side
            app.openapi_schema = document
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]
