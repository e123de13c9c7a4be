"""Prometheus metrics of one application, in a registry of its own."""

import time

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Counter, Gauge, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily
from prometheus_client.registry import Collector
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seafoam.render.service.jobs import EncodedFrame
from seafoam.render.service.pool import RenderPool, State
from seafoam.render.service.source import FrameSource, Origin

_SECONDS = (0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0)
_ORIGINS: tuple[Origin, ...] = ("memory", "disk", "shared", "drawn")
_STATES: tuple[State, ...] = ("starting", "ready", "unavailable", "stopped")


class Metrics:
    """Metrics with the prefix ``seafoam_``; durations in seconds."""

    def __init__(self, pool: RenderPool, source: FrameSource) -> None:
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
        for name in _STATES:
            state.labels(name).set_function(lambda name=name: float(pool.state == name))  # type: ignore[misc]
        self.registry.register(_Restarts(pool))
        self.registry.register(_Origins(source))

    def count_frame(self, frame: EncodedFrame, format: str) -> None:
        """Count a rendered frame."""
        self.frames.labels(format).inc()
        for stage, seconds in frame.timings.items():
            self.stages.labels(stage).observe(seconds)

    def exposition(self) -> bytes:
        """Return all metrics in Prometheus text format, :data:`CONTENT_TYPE_LATEST`."""
        return generate_latest(self.registry)


class _Restarts(Collector):
    def __init__(self, pool: RenderPool) -> None:
        self._pool = pool

    def collect(self) -> list[CounterMetricFamily]:
        family = CounterMetricFamily("seafoam_worker_restarts", "Render workers replaced", labels=("reason",))
        for reason in ("deadline", "crash", "recycled"):
            family.add_metric((reason,), self._pool.restarts[reason])
        return [family]


class _Origins(Collector):
    def __init__(self, source: FrameSource) -> None:
        self._source = source

    def collect(self) -> list[CounterMetricFamily]:
        family = CounterMetricFamily("seafoam_frame_origins", "Frames by where they came from", labels=("origin",))
        for origin in _ORIGINS:
            family.add_metric((origin,), self._source.origins[origin])
        disk = self._source.disk
        damaged = CounterMetricFamily("seafoam_cache_damaged", "Files of the cache that were damaged, and removed")
        damaged.add_metric((), disk.damaged if disk else 0)
        failures = CounterMetricFamily("seafoam_cache_failures", "Writes to the cache that failed")
        failures.add_metric((), disk.failures if disk else 0)
        return [family, damaged, failures]


class MeasureRequests:
    """ASGI middleware: counts requests, their duration and bytes, by route template."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self.app = app
        self.metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        began = time.perf_counter()
        status = 500
        sent = 0

        async def counting(message: Message) -> None:
            nonlocal status, sent
            if message["type"] == "http.response.start":
                status = message["status"]
            elif message["type"] == "http.response.body":
                sent += len(message.get("body", b""))
            await send(message)

        try:
            await self.app(scope, receive, counting)
        finally:
            # A path as it stands would be a label for every misspelling.
            route = getattr(scope.get("route"), "path_format", "(page)")
            self.metrics.requests.labels(scope["method"], route, str(status)).inc()
            self.metrics.durations.labels(scope["method"], route).observe(time.perf_counter() - began)
            self.metrics.sent.labels(route).inc(sent)


__all__ = ["CONTENT_TYPE_LATEST", "MeasureRequests", "Metrics"]
