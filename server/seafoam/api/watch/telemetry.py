"""OpenTelemetry, where its standard variables ask for traces. Its SDK and exporter are imported only then."""

import os
import time
from collections.abc import Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING

from fastapi.telemetry import TelemetryConfig

from seafoam.api.frames.streams import is_frame
from seafoam.api.watch.logs import PROBES
from seafoam.extras import UnableError, require

if TYPE_CHECKING:
    from opentelemetry.sdk.trace.export import SpanExporter

NO_TELEMETRY: TelemetryConfig = {"tracing": False, "metrics": False, "logs": False, "auto_configure": False}
_ENDPOINTS = ("OTEL_EXPORTER_OTLP_TRACES_ENDPOINT", "OTEL_EXPORTER_OTLP_ENDPOINT")
_PROTOCOLS = ("OTEL_EXPORTER_OTLP_TRACES_PROTOCOL", "OTEL_EXPORTER_OTLP_PROTOCOL")
_PROTOCOL = "http/protobuf"


class UnsupportedTelemetryError(UnableError):
    """A variable asks for what is not supported."""


def configured(environment: Mapping[str, str] = os.environ) -> bool:
    """Whether an OTLP endpoint is named, and neither the SDK nor the exporter of traces is switched off.

    Raises :class:`UnsupportedTelemetryError` for another exporter or protocol than OTLP over HTTP.
    """
    exporter = environment.get("OTEL_TRACES_EXPORTER") or "otlp"
    off = environment.get("OTEL_SDK_DISABLED", "").lower() == "true" or exporter == "none"
    if off or not any(environment.get(name) for name in _ENDPOINTS):
        return False
    if exporter != "otlp":
        raise UnsupportedTelemetryError(f"OTEL_TRACES_EXPORTER: must be otlp or none, not {exporter!r}")
    for name in _PROTOCOLS:
        if (protocol := environment.get(name) or _PROTOCOL) != _PROTOCOL:
            raise UnsupportedTelemetryError(f"{name}: must be {_PROTOCOL}, not {protocol!r}")
    return True


class Traces:
    """Spans of a frame's stages within those that FastAPI itself makes of requests, and where all of them go.

    A tracer of its own, sampled and exported as the variables ``OTEL_*`` say; closed with the application.

    exporter: absent: OTLP over HTTP.
    """

    def __init__(self, exporter: "SpanExporter | None" = None) -> None:
        from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
        from opentelemetry.sdk.resources import SERVICE_NAME, SERVICE_VERSION, Resource
        from opentelemetry.sdk.trace import TracerProvider
        from opentelemetry.sdk.trace.export import BatchSpanProcessor

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


def traces() -> Traces | None:
    """Return where spans go, None if nothing asks for them.

    Raises :class:`~seafoam.extras.MissingExtraError` without the extra ``telemetry``, and what :func:`configured` does.
    """
    if not configured():
        return None
    require("telemetry")
    return Traces()
