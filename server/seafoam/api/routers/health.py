"""``/healthz``, ``/readyz`` and ``/metrics``: answered by the web process, without the render queue."""

import math
import time
from typing import Literal

from fastapi import APIRouter
from prometheus_client import CONTENT_TYPE_LATEST, generate_latest
from pydantic import BaseModel, Field
from starlette.responses import Response

from seafoam.api.context import InContext
from seafoam.api.http.answers import NO_STORE, TEXT, content, problems
from seafoam.api.http.problems import BusyError
from seafoam.api.http.validation import NoParameters
from seafoam.render.service.errors import RendererUnavailableError

router = APIRouter(tags=["health"])


class Alive(BaseModel):
    """The web process responds."""

    status: Literal["alive"] = "alive"


class RendererInfo(BaseModel):
    """The OpenGL implementation in use."""

    vendor: str = Field(examples=["Mesa"])
    renderer: str = Field(examples=["llvmpipe (LLVM 15.0.6, 256 bits)"])
    version: str = Field(examples=["4.5 (Core Profile) Mesa 22.3.6"])


class Ready(BaseModel):
    """Frames can be rendered."""

    status: Literal["ready"] = "ready"
    renderer: RendererInfo
    last_drawn: float = Field(description="Time since the last rendered frame or test frame, s")


@router.get("/healthz", responses=problems(422))
async def get_health(_: NoParameters, response: Response) -> Alive:
    """Check whether the web process responds."""
    response.headers["Cache-Control"] = NO_STORE
    return Alive()


@router.get("/readyz", responses=problems(422, 503))
async def get_readiness(_: NoParameters, context: InContext, response: Response) -> Ready:
    """Check whether frames are rendered, by the age of the last one, and by which renderer.

    An idle renderer draws a test frame every minute. Plans, masks and the page need none.
    """
    pool = context.pool
    if pool.state == "starting":
        raise BusyError("the renderer is starting", retry_after=1)
    if pool.state != "ready":
        raise RendererUnavailableError(pool.remedy or "the renderer is stopped")
    age = time.time() - pool.succeeded_at
    if age > context.settings.ready_age:
        raise BusyError(
            f"the last frame was drawn {age:.0f} s ago, which is more than {context.settings.ready_age:g} s",
            retry_after=math.ceil(context.settings.canary),
        )
    response.headers["Cache-Control"] = NO_STORE
    return Ready(renderer=RendererInfo.model_validate(pool.info), last_drawn=round(age, 3))


@router.get(
    "/metrics",
    response_class=Response,
    responses=problems(422) | content("Prometheus' text format", "text/plain", schema=TEXT),
)
async def get_metrics(_: NoParameters, context: InContext) -> Response:
    """Get counters and durations for Prometheus."""
    headers = {"Cache-Control": NO_STORE, "Content-Type": CONTENT_TYPE_LATEST}
    return Response(generate_latest(context.metrics.registry), headers=headers)
