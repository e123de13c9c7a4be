"""``/healthz``, ``/readyz`` and ``/metrics``: answered by the web process, never behind the render queue."""

import time
from typing import Annotated, Literal

from fastapi import APIRouter, Query
from pydantic import BaseModel, Field
from starlette.responses import JSONResponse, Response

from seafoam.api.caching import NO_STORE
from seafoam.api.context import InContext
from seafoam.api.errors import BusyError, problem_responses
from seafoam.api.metrics import CONTENT_TYPE_LATEST
from seafoam.api.parameters import Parameters
from seafoam.render.service.pool import RendererUnavailableError

router = APIRouter(tags=["health"])


class Alive(BaseModel):
    """The web process answers."""

    status: Literal["alive"] = "alive"


class RendererInfo(BaseModel):
    """The GL in use."""

    vendor: str = Field(examples=["Mesa"])
    renderer: str = Field(examples=["llvmpipe (LLVM 15.0.6, 256 bits)"])
    version: str = Field(examples=["4.5 (Core Profile) Mesa 22.3.6"])


class Ready(BaseModel):
    """Frames can be rendered."""

    status: Literal["ready"] = "ready"
    renderer: RendererInfo
    last_drawn: float = Field(description="Seconds since a canary or frame was last drawn")
    workers: int = Field(description="Render processes")
    active: int = Field(description="Of them at work")
    waiting: int = Field(description="Frames that wait")
    queue: int = Field(description="Frames that may wait")


@router.get("/healthz", responses=problem_responses(422))
async def get_health(_: Annotated[Parameters, Query()], response: Response) -> Alive:
    """Whether the web process is alive."""
    response.headers["Cache-Control"] = NO_STORE
    return Alive()


@router.get("/readyz", response_model=Ready, responses=problem_responses(422, 503))
async def get_readiness(_: Annotated[Parameters, Query()], context: InContext) -> Response:
    """Whether frames can be rendered, and by what. Plans, masks and the page need no renderer."""
    pool = context.pool
    if pool.state == "starting":
        raise BusyError("the renderer is starting", retry_after=1)
    if pool.state != "ready":
        raise RendererUnavailableError(pool.remedy or "the renderer is stopped")
    ready = Ready(
        renderer=RendererInfo.model_validate({key: pool.info[key] for key in RendererInfo.model_fields}),
        last_drawn=round(time.time() - pool.succeeded_at, 3),
        workers=pool.workers,
        active=pool.active,
        waiting=pool.waiting,
        queue=pool.queue,
    )
    return JSONResponse(ready.model_dump(), headers={"Cache-Control": NO_STORE})


@router.get(
    "/metrics",
    response_class=Response,
    responses=problem_responses(422)
    | {200: {"description": "Prometheus' text format", "content": {"text/plain": {"schema": {"type": "string"}}}}},
)
async def get_metrics(_: Annotated[Parameters, Query()], context: InContext) -> Response:
    """Counters and durations for Prometheus."""
    return Response(
        context.metrics.exposition(), headers={"Cache-Control": NO_STORE, "Content-Type": CONTENT_TYPE_LATEST}
    )
