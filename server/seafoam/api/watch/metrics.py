"""Prometheus metrics of one application, in a registry of its own."""

import time
from collections.abc import Iterator
from typing import get_args

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Counter, Gauge, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily
from prometheus_client.registry import Collector
from starlette.types import ASGIApp, Receive, Scope, Send

from seafoam.api.http.asgi import CountingSend, HttpMiddleware, route_of
from seafoam.render.service.frame_cache import FrameCache
from seafoam.render.service.jobs import EncodedFrame, Origin
from seafoam.render.service.pool import RenderPool, State

_SECONDS = (0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0)


class Metrics:
    """Metrics with the prefix ``seafoam_``; durations in seconds."""

    def __init__(self, pool: RenderPool, frames: FrameCache) -> None:
        self.registry = CollectorRegistry()
        self.requests = Counter(
            "seafoam_requests", "Requests answered", ("method", "route", "status"), registry=self.registry
        )
        self.durations = Histogram(
            "seafoam_request_duration_seconds",
            "Time from the start of a request to the last byte of its response",
            ("method", "route"),
            buckets=_SECONDS,
            registry=self.registry,
        )
        self.sent = Counter("seafoam_response_bytes", "Bytes of response bodies", ("route",), registry=self.registry)
        self.frames = Counter("seafoam_frames", "Frames rendered", ("format",), registry=self.registry)
        self.stages = Histogram(
            "seafoam_frame_stage_seconds",
            "Time per frame and stage: queue, plan, render, read, encode",
            ("stage",),
            buckets=_SECONDS,
            registry=self.registry,
        )
        for name, text, read in (
            ("seafoam_queue_waiting", "Frames waiting for a render worker", lambda: pool.waiting),
            ("seafoam_background_waiting", "Frames that wait behind every visitor's", lambda: pool.waiting_background),
            ("seafoam_queue_limit", "Capacity of the render queue, frames", lambda: pool.queue),
            ("seafoam_workers", "Render workers", lambda: pool.workers),
            ("seafoam_workers_active", "Busy render workers", lambda: pool.active),
        ):
            Gauge(name, text, registry=self.registry).set_function(read)
        state = Gauge(
            "seafoam_renderer_state",
            "State of the renderer: 1 for the current state, 0 for the others",
            ("state",),
            registry=self.registry,
        )
        for name in get_args(State):
            state.labels(name).set_function(lambda name=name: float(pool.state == name))  # type: ignore[misc]
        self.registry.register(_Counts(pool, frames))

    def count_frame(self, frame: EncodedFrame, format: str) -> None:
        """Count a rendered frame."""
        self.frames.labels(format).inc()
        for stage, seconds in frame.timings.items():
            self.stages.labels(stage).observe(seconds)

    def exposition(self) -> bytes:
        """Return all metrics in Prometheus text format, :data:`CONTENT_TYPE_LATEST`."""
        return generate_latest(self.registry)


class _Counts(Collector):
    """Counters that pool and caches keep themselves."""

    def __init__(self, pool: RenderPool, frames: FrameCache) -> None:
        self._pool = pool
        self._frames = frames

    def collect(self) -> Iterator[CounterMetricFamily]:
        """Yield each with its present values."""
        restarts = CounterMetricFamily("seafoam_worker_restarts", "Render workers replaced", labels=("reason",))
        for reason in ("deadline", "crash", "recycled"):
            restarts.add_metric((reason,), self._pool.restarts[reason])
        yield restarts
        origins = CounterMetricFamily("seafoam_frame_origins", "Frames by where they came from", labels=("origin",))
        for origin in get_args(Origin):
            origins.add_metric((origin,), self._frames.origins[origin])
        yield origins
        disk = self._frames.disk
        yield CounterMetricFamily(
            "seafoam_cache_damaged", "Files of the cache that were damaged, and removed", disk.damaged if disk else 0
        )
        yield CounterMetricFamily(
            "seafoam_cache_failures", "Writes to the cache that failed", disk.failures if disk else 0
        )


class MeasureRequests(HttpMiddleware):
    """ASGI middleware: counts requests, their duration and bytes, by route template."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        super().__init__(app)
        self.metrics = metrics

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        began = time.perf_counter()
        sent = CountingSend(send)
        try:
            await self.app(scope, receive, sent)
        finally:
            route = route_of(scope)
            self.metrics.requests.labels(scope["method"], route, str(sent.status)).inc()
            self.metrics.durations.labels(scope["method"], route).observe(time.perf_counter() - began)
            self.metrics.sent.labels(route).inc(sent.bytes)


__all__ = ["CONTENT_TYPE_LATEST", "MeasureRequests", "Metrics"]
