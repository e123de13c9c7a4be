"""Every error as RFC 9457 problem+json, from one table.

Routers raise those of :mod:`seafoam.api.http.problems`, and what the layers below raise.
"""

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse

from seafoam.accuracy.sweep_service import FailedError
from seafoam.api.http import problems
from seafoam.api.http.problems import BadRequestError, FieldProblem, Schema, allowed_at
from seafoam.api.watch.logs import request_id
from seafoam.extras import MissingExtraError
from seafoam.masks.catalogue import MaskTooSlowError
from seafoam.planner import PlanError
from seafoam.render.service import errors as render
from seafoam.render.service.queues import BackgroundFullError
from seafoam.sequences.service import NotFinishedError, UnknownSequenceError
from seafoam.sequences.spec import OutputError

log = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"


class Problem(BaseModel):
    """An error, as defined by RFC 9457."""

    model_config = ConfigDict(extra="forbid")

    type: str = Field(description="URN of the problem type", examples=["urn:seafoam:problem:bad-request"])
    title: str = Field(description="Short description of the problem type")
    status: int = Field(description="HTTP status code")
    detail: str = Field(description="Description of this occurrence of the problem")
    instance: str = Field(description="Path of the request")
    request_id: str | None = Field(default=None, description="The request's X-Request-ID, as in the server's log")
    errors: list[FieldProblem] | None = Field(default=None, description="Errors of single fields and parameters")
    remedy: str | None = Field(default=None, description="How the operator of the server can fix it")


@dataclass(frozen=True, slots=True)
class ProblemType:
    """HTTP status, name and title of an error; without a name it is the status alone."""

    status: int
    name: str = ""
    title: str = ""


_NOT_FOUND = ProblemType(404, "not-found", "Not found")
_BUSY = ProblemType(503, "busy", "The server is busy")
_INVALID = ProblemType(422, "bad-request", "Invalid request")

PROBLEM_TYPES: dict[type[Exception], ProblemType] = {
    problems.NotFoundError: _NOT_FOUND,
    UnknownSequenceError: _NOT_FOUND,
    problems.UnsupportedMediaError: ProblemType(415, "unsupported-media-type", "The request body must be JSON"),
    BadRequestError: _INVALID,
    OutputError: _INVALID,
    PlanError: _INVALID,
    render.FrameTooLargeError: ProblemType(422, "frame-too-large", "The frame exceeds the size limit"),
    MaskTooSlowError: ProblemType(422, "mask-too-slow", "The mask would take too long to generate"),
    render.RenderFailedError: ProblemType(500, "render-failed", "The frame could not be rendered"),
    FailedError: ProblemType(500, "measurement-failed", "The measurement failed"),
    MissingExtraError: ProblemType(501, "not-installed", "A package that the answer needs is not installed"),
    problems.NotBuiltError: ProblemType(501, "not-built", "A part of the server is not built"),
    NotFinishedError: ProblemType(409, "not-finished", "The sequence is not finished"),
    problems.BusyError: _BUSY,
    BackgroundFullError: _BUSY,
    problems.NotMeasuredError: ProblemType(503, "not-measured", "The cost of accuracy is still being measured"),
    problems.StreamsFullError: ProblemType(503, "streams-full", "All streams are taken"),
    render.RenderQueueFullError: ProblemType(503, "queue-full", "The render queue is full"),
    render.RendererUnavailableError: ProblemType(503, "no-renderer", "No renderer is available"),
    render.StartingError: ProblemType(503, "starting", "The renderer is starting"),
    render.DeadlineError: ProblemType(504, "deadline", "The request timed out"),
}
"""Maps exceptions to HTTP errors."""


def problem(
    path: str,
    kind: ProblemType,
    detail: str,
    *,
    errors: Sequence[FieldProblem] = (),
    remedy: str | None = None,
    headers: Mapping[str, str] | None = None,
) -> JSONResponse:
    """Return a problem+json response, which is never cached. path: of the request."""
    content = Problem(
        type=f"urn:seafoam:problem:{kind.name}" if kind.name else "about:blank",
        title=kind.title or HTTPStatus(kind.status).phrase,
        status=kind.status,
        detail=detail,
        instance=path,
        request_id=request_id.get(),
        errors=list(errors) or None,
        remedy=remedy,
    )
    sent = {"Cache-Control": "no-store", **(headers or {})}
    return JSONResponse(content.model_dump(mode="json", exclude_none=True), kind.status, sent, MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Install handlers that turn every error of the application into a problem."""
    for kind in PROBLEM_TYPES:
        app.add_exception_handler(kind, _known)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _http)
    app.add_exception_handler(Exception, unexpected)


def pointer_of(location: Sequence[str | int], value: Any, missing: bool) -> tuple[str | int, ...]:
    """Convert a pydantic location to a path into ``value``, without the names of union members."""
    path: list[str | int] = []
    for index, step in enumerate(location):
        named = isinstance(value, dict) and step in value
        if named or (isinstance(value, list) and isinstance(step, int) and step < len(value)):
            path.append(step)
            value = value[step]
        elif missing and index == len(location) - 1:
            path.append(step)
    return tuple(path)


def _field_error(item: Mapping[str, Any], body: Any, openapi: Schema, operation: Schema) -> FieldProblem:
    source, *location = item["loc"]
    message: str = item["msg"].removeprefix("Value error, ")
    if source != "body":
        name = str(location[0]) if location else ""
        parameters = operation.get("parameters", ())
        declared = next((parameter for parameter in parameters if parameter["name"] == name), None)
        if declared is None:
            known = sorted(parameter["name"] for parameter in parameters if parameter["in"] == source)
            said = {"members": known} if known else None
            return FieldProblem(parameter=name, detail=f"{name} is not a parameter of this operation", allowed=said)
        allowed = allowed_at(declared["schema"], openapi, ())
        return FieldProblem(parameter=name, detail=f"{name}: {message}", allowed=allowed)
    if item["type"] == "json_invalid":
        at = f" at character {location[0]}" if location else ""
        return FieldProblem(pointer="", detail=f"invalid JSON: {item['ctx']['error']}{at}")
    path = pointer_of(location, body, item["type"] == "missing")
    pointer = "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)
    schema = operation.get("requestBody", {}).get("content", {}).get("application/json", {}).get("schema", {})
    unknown = item["type"] == "extra_forbidden"
    allowed = allowed_at(schema, openapi, path[:-1] if unknown else path, body)
    return FieldProblem(pointer=pointer, detail=f"{pointer or 'the body'}: {message}", allowed=allowed)


async def _known(request: Request, error: Exception) -> JSONResponse:
    kind = next(PROBLEM_TYPES[base] for base in type(error).__mro__ if base in PROBLEM_TYPES)
    errors: list[FieldProblem] = getattr(error, "errors", [])
    detail, posted = str(error), request.method != "GET"
    match error:
        case UnknownSequenceError():
            errors = [FieldProblem(parameter="sequence", detail=detail)]
        case OutputError():
            errors = [FieldProblem(pointer=f"/{error.field}", detail=detail)]
        case PlanError():
            # Set by the query parameter of the same name, or in a body, which is the scene or has it as a member.
            member = error.pointer.rpartition("/")[2]
            parameter = member if not posted and member in request.query_params else None
            within = "/scene" if posted and not request.url.path.endswith("/scenes") else ""
            pointer = None if parameter else within + error.pointer
            detail = f"{parameter or pointer or 'scene'}: {error.message}"
            errors = [FieldProblem(pointer=pointer, parameter=parameter, detail=detail)]
        case render.FrameTooLargeError():
            bounds = {"minimum": 1, "maximum": error.greatest}
            pointer, parameter = (f"/{error.field}", None) if posted else (None, error.field)
            errors = [FieldProblem(pointer=pointer, parameter=parameter, detail=detail, allowed=bounds)]
    wait, remedy = getattr(error, "retry_after", None), getattr(error, "remedy", None)
    headers = {} if wait is None else {"Retry-After": str(wait)}
    return problem(request.url.path, kind, detail, errors=errors, remedy=remedy, headers=headers)


async def _invalid(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    openapi = request.app.openapi()
    route = request.scope["route"]
    operation = openapi["paths"].get(route.path_format, {}).get(request.method.lower(), {})
    items = error.errors()
    # A list with a bad item also counts as too short, which says nothing new.
    telling = [item for item in items if item["type"] != "too_short" or item["input"] in ([], {}, "")]
    errors = [_field_error(dict(item), error.body, openapi, operation) for item in telling or items]
    detail = "; ".join(item.detail for item in errors)
    return problem(request.url.path, _INVALID, detail, errors=errors)


async def _http(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    detail = error.detail
    if error.status_code == HTTPStatus.BAD_REQUEST and error.__cause__ is not None:
        # Of what reading a body may raise, FastAPI knows errors of JSON's grammar alone.
        said = "the body is no JSON that can be read: not UTF-8, or too many levels or digits"
        return await _known(request, BadRequestError(FieldProblem(pointer="", detail=said)))
    elif error.status_code == HTTPStatus.NOT_FOUND:
        detail = f"{request.url.path} was not found"
    return problem(request.url.path, ProblemType(error.status_code), detail, headers=error.headers)


async def unexpected(request: Request, error: Exception) -> JSONResponse:
    # The server's log has the traceback; a client learns nothing of the inside.
    detail = "internal server error; the server log has the details"
    return problem(request.url.path, ProblemType(500, "internal", "Internal server error"), detail)
