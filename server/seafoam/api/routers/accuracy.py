"""``/api/accuracy``: what accuracy costs in time, measured on this server."""

from collections.abc import Callable
from functools import partial

from fastapi import APIRouter, Request
from starlette.responses import JSONResponse, Response

from seafoam.accuracy.model import Running, Sweep, SweepPoints
from seafoam.accuracy.points import points_of
from seafoam.accuracy.report import csv_of
from seafoam.accuracy.sweep import Subject, truth_info
from seafoam.api.context import Context, InContext, retry_seconds
from seafoam.api.http import answers
from seafoam.api.http.validation import NoParameters, PresetName, find_preset
from seafoam.render.encode import encode

router = APIRouter(prefix="/api", tags=["accuracy"], default_response_class=Response)

_RUNNING: answers.Responses = {
    202: {
        "model": Running,
        "description": "The measurement is running; the first request starts it",
        "headers": answers.headers_of({"Retry-After": "Delay before the next request, s"}),
    },
    **answers.NOT_MODIFIED,
}
_SWEEP = _RUNNING | answers.problems(404, 422, 500, 501, 503, 504)


def _wait(running: Running) -> Response:
    headers = {"Cache-Control": answers.NO_STORE, "Retry-After": str(retry_seconds(running))}
    return JSONResponse(running.model_dump(mode="json"), 202, headers)


def _subject(preset: str) -> Subject:
    return Subject.of_preset(find_preset(preset).name)


async def _shown(
    preset: str, request: Request, context: Context, render: Callable[[Sweep], bytes], media: str
) -> Response:
    """Return the sweep of a preset in one of its formats, or its progress."""
    sweep = await context.measured(_subject(preset))
    if isinstance(sweep, Running):
        return _wait(sweep)
    identity = (sweep.model_dump(mode="json"),)
    return await answers.kept(request, identity, partial(context.plans.run, render, sweep), media)


def _plot(sweep: Sweep) -> bytes:
    # Matplotlib takes a second to import, so only a server that is asked for a plot pays.
    from seafoam.accuracy.plots import plot_sweep

    return plot_sweep(sweep)


@router.get(
    "/accuracy/{preset}.csv",
    responses=answers.content("CSV with one row per point; times in milliseconds", "text/csv", schema=answers.TEXT)
    | _SWEEP,
)
async def get_accuracy_csv(preset: PresetName, _: NoParameters, request: Request, context: InContext) -> Response:
    """Get the measured cost of accuracy of a preset as CSV."""
    return await _shown(preset, request, context, lambda sweep: csv_of(sweep).encode(), "text/csv")


@router.get(
    "/accuracy/{preset}.png",
    responses=answers.content("Plot of time against error, with the Pareto front", "image/png") | _SWEEP,
)
async def get_accuracy_plot(preset: PresetName, _: NoParameters, request: Request, context: InContext) -> Response:
    """Get the measured cost of accuracy of a preset as a plot."""
    return await _shown(preset, request, context, _plot, "image/png")


@router.get(
    "/accuracy/{preset}/truth.npy",
    responses=answers.content(
        "float32 (height, width, 4): linear RGB and foam coverage; top row first", "application/x-npy"
    )
    | _RUNNING
    | answers.problems(404, 422, 500, 501, 503),
)
async def get_truth(preset: PresetName, _: NoParameters, request: Request, context: InContext) -> Response:
    """Get the converged float64 picture against which errors are measured. Requires no renderer."""
    subject = _subject(preset)
    found = await context.plans.run(context.sweeps.truth, subject)
    if isinstance(found, Running):
        return _wait(found)
    info = truth_info(subject, context.sweeps.settings)
    identity = (info.model_dump(), subject.scene.model_dump(mode="json"))
    make = partial(context.plans.run, encode, found, "npy")
    return await answers.kept(request, identity, make, "application/x-npy")


@router.get("/accuracy/{preset}/points", response_class=JSONResponse, responses=answers.problems(404, 422, 501, 503))
async def get_points(preset: PresetName, _: NoParameters, context: InContext) -> SweepPoints:
    """List the qualities that are measured for a preset: every tier, and tier standard with one setting changed.

    Responds at once, without measuring.
    """
    subject = _subject(preset)
    points = await context.plans.run(points_of, subject.scene)
    return SweepPoints(preset=preset, truth=truth_info(subject, context.sweeps.settings), points=points)


@router.get("/accuracy/{preset}", responses={200: {"model": Sweep, "description": "The measurement"}, **_SWEEP})
async def get_accuracy(preset: PresetName, _: NoParameters, request: Request, context: InContext) -> Response:
    """Get the measured cost of accuracy of a preset: times, errors, Pareto front, and the effect of each setting.

    The first request starts the measurement, which takes several minutes; until it is done, the status is 202.
    """
    return await _shown(preset, request, context, lambda sweep: sweep.model_dump_json().encode(), "application/json")
