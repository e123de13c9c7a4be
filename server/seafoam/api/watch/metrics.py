"""Requests counted and logged, Prometheus metrics in a registry of the application's own, traces by OpenTelemetry."""

import os
import time
import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from importlib.metadata import version
from typing import get_args

from fastapi.telemetry import TelemetryConfig
from opentelemetry import trace
from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram
from prometheus_client.core import CounterMetricFamily
from prometheus_client.registry import Collector
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import Receive, Scope, Send

from seafoam.api.frames.streams import is_frame
from seafoam.api.http.middleware import CountingSend, HttpMiddleware, altering
from seafoam.api.watch.logs import PROBES, REQUEST_ID, SANE, log, request_id, too_many
from seafoam.extras import require
from seafoam.render.service.frame_cache import FrameCache
from seafoam.render.service.jobs import EncodedFrame, Origin
from seafoam.render.service.pool import RenderPool, State

_SECONDS = (0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0)


class Metrics(Collector):
    """Metrics with the prefix ``seafoam_``; durations in seconds."""

    def __init__(self, pool: RenderPool, frames: FrameCache) -> None:
        self._pool = pool
        self._frames = frames
        self.registry = CollectorRegistry()
        counter = partial(Counter, registry=self.registry)
        gauge = partial(Gauge, registry=self.registry)
        histogram = partial(Histogram, registry=self.registry, buckets=_SECONDS)
        self.requests = counter("seafoam_requests", "Requests answered", ("method", "route", "status"))
        duration = "Time from the start of a request to the last byte of its response"
        self.durations = histogram("seafoam_request_duration_seconds", duration, ("method", "route"))
        self.frames = counter("seafoam_frames", "Frames rendered", ("format",))
        stages = "Time per frame and stage: queue, plan, render, read, encode"
        self.stages = histogram("seafoam_frame_stage_seconds", stages, ("stage",))
        for name, text, read in (
            ("seafoam_queue_waiting", "Frames waiting for a render worker", lambda: pool.waiting),
            ("seafoam_background_waiting", "Frames that wait behind every visitor's", lambda: pool.waiting_background),
            ("seafoam_queue_limit", "Capacity of the render queue, frames", lambda: pool.queue),
            ("seafoam_workers", "Render workers", lambda: pool.workers),
            ("seafoam_workers_active", "Busy render workers", lambda: pool.active),
        ):
            gauge(name, text).set_function(read)
        states = "State of the renderer: 1 for the current state, 0 for the others"
        state = gauge("seafoam_renderer_state", states, ("state",))
        for name in get_args(State):
            state.labels(name).set_function(lambda name=name: float(pool.state == name))  # type: ignore[misc]
        self.registry.register(self)

    def count_frame(self, frame: EncodedFrame, format: str) -> None:
        self.frames.labels(format).inc()
        for stage, seconds in frame.timings.items():
            self.stages.labels(stage).observe(seconds)

    def collect(self) -> Iterator[CounterMetricFamily]:
        """Yield the counters that pool and caches keep themselves."""
        restarts = CounterMetricFamily("seafoam_worker_restarts", "Render workers replaced", labels=("reason",))
        for reason in ("deadline", "crash"):
            restarts.add_metric((reason,), self._pool.restarts[reason])
        yield restarts
        origins = CounterMetricFamily("seafoam_frame_origins", "Frames by where they came from", labels=("origin",))
        for origin in get_args(Origin):
            origins.add_metric((origin,), self._frames.origins[origin])
        yield origins
        disk = self._frames.disk
        damaged, failures = (disk.damaged, disk.failures) if disk else (0, 0)
        yield CounterMetricFamily("seafoam_cache_damaged", "Files of the cache that were damaged, and removed", damaged)
        yield CounterMetricFamily("seafoam_cache_failures", "Writes to the cache that failed", failures)


@dataclass(eq=False)
class WatchRequests(HttpMiddleware):
    """ASGI middleware: gives each request an id, returns it, and counts and logs what was answered, by route template.

    An id that the client sends in ``X-Request-ID`` is kept if it is sane. logged: whether a line is written of each.
    """

    metrics: Metrics
    logged: bool

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        asked = Headers(scope=scope).get(REQUEST_ID, "")
        identity = asked if SANE.fullmatch(asked) else uuid.uuid4().hex
        # Not reset: each request is a task of its own, and the answer to an unexpected error is made outside of this.
        request_id.set(identity)
        scope.setdefault("state", {})
        began = time.perf_counter()
        sent = CountingSend(send)

        def mark(headers: MutableHeaders) -> None:
            headers[REQUEST_ID] = identity

        try:
            await self.app(scope, receive, altering(sent, mark))
        finally:
            method, seconds = scope["method"], time.perf_counter() - began
            # A path as it stands would be a name of its own for every misspelling.
            route = getattr(scope.get("route"), "path_format", "(page)")
            self.metrics.requests.labels(method, route, str(sent.status)).inc()
            self.metrics.durations.labels(method, route).observe(seconds)
            if self.logged and not too_many(scope["path"], sent.status):
                client = scope["state"].get("client") or (scope.get("client") or ("",))[0]
                fields = {"method": method, "route": route, "path": scope["path"], "status": sent.status}
                fields |= {"duration_ms": round(1000 * seconds, 3), "bytes": sent.bytes, "client": client}
                log.info("%(method)s %(route)s %(status)d", fields, extra={"fields": fields})


_ENDPOINTS = ("OTEL_EXPORTER_OTLP_TRACES_ENDPOINT", "OTEL_EXPORTER_OTLP_ENDPOINT")
_TRACER = trace.get_tracer("seafoam", version("seafoam"))


def telemetry() -> TelemetryConfig:
    """Return how FastAPI traces requests where an OTLP endpoint is named: a span for each but probes and stream frames.

    Raises :class:`~seafoam.extras.MissingExtraError` without the extra ``telemetry``.
    """
    if any(map(os.environ.get, _ENDPOINTS)):
        require("telemetry")
        os.environ.setdefault("OTEL_SERVICE_NAME", "seafoam")
    return {
        "auto_configure": True,
        "metrics": False,
        "logs": False,
        "operation_spans": False,
        "exclude": lambda scope: scope["type"] != "http" or scope["path"] in PROBES or is_frame(scope["path"]),
    }


def trace_stages(timings: Mapping[str, float]) -> None:
    """Add a span for each stage of a frame that has just been finished, one after the other until now.

    timings: duration by stage, s, in the order in which they were passed.
    """
    began = time.time_ns() - round(1e9 * sum(timings.values()))
    for stage, seconds in timings.items():
        span = _TRACER.start_span(stage, start_time=began)
        began += round(1e9 * seconds)
        span.end(began)
