"""Spans of a frame's stages within those that FastAPI itself makes of requests, and where all of them go.

Only :mod:`seafoam.api.watch.telemetry` imports this module.
"""

import os
import time
from collections.abc import Mapping
from importlib.metadata import version

from fastapi.telemetry import TelemetryConfig
from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
from opentelemetry.sdk.resources import SERVICE_NAME, SERVICE_VERSION, Resource
from opentelemetry.sdk.trace import TracerProvider
from opentelemetry.sdk.trace.export import BatchSpanProcessor, SpanExporter

from seafoam.api.frames.streams import is_frame
from seafoam.api.watch.logs import PROBES


class Traces:
    """A tracer of its own, sampled and exported as the variables ``OTEL_*`` say; closed with the application.

    exporter: absent: OTLP over HTTP.
    """

    def __init__(self, exporter: SpanExporter | None = None) -> None:
        attributes = {SERVICE_VERSION: version("seafoam")}
        # Given here, it would precede the environment's.
        if not os.environ.get("OTEL_SERVICE_NAME") and SERVICE_NAME not in os.environ.get(
            "OTEL_RESOURCE_ATTRIBUTES", ""
        ):
            attributes[SERVICE_NAME] = "seafoam"
        # Provider and exporter are closed with the application, not at the end of the process.
        self._provider = TracerProvider(resource=Resource.create(attributes), shutdown_on_exit=False)
        self._provider.add_span_processor(BatchSpanProcessor(exporter or OTLPSpanExporter()))
        self._tracer = self._provider.get_tracer("seafoam", version("seafoam"))

    @property
    def requests(self) -> TelemetryConfig:
        """Return how FastAPI traces requests: a span for each but probes and frames of streams."""
        return {
            "tracer_provider": self._provider,
            "metrics": False,
            "logs": False,
            "operation_spans": False,
            "exclude": lambda scope: scope["type"] != "http" or scope["path"] in PROBES or is_frame(scope["path"]),
        }

    def stages(self, timings: Mapping[str, float]) -> None:
        """Add a span for each stage of a frame that has just been finished, one after the other until now.

        timings: duration by stage, s, in the order in which they were passed.
        """
        began = time.time_ns() - round(1e9 * sum(timings.values()))
        for stage, seconds in timings.items():
            span = self._tracer.start_span(stage, start_time=began)
            began += round(1e9 * seconds)
            span.end(began)

    def close(self) -> None:
        """Send what is left, and stop."""
        self._provider.shutdown()
