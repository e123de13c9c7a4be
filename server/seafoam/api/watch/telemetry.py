"""OpenTelemetry, where its standard variables ask for traces. Its SDK and exporter are imported only then."""

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

from fastapi.telemetry import TelemetryConfig

from seafoam.extras import require

if TYPE_CHECKING:
    from seafoam.api.watch.traces import Traces

NO_TELEMETRY: TelemetryConfig = {"tracing": False, "metrics": False, "logs": False, "auto_configure": False}
_ENDPOINTS = ("OTEL_EXPORTER_OTLP_TRACES_ENDPOINT", "OTEL_EXPORTER_OTLP_ENDPOINT")
_PROTOCOLS = ("OTEL_EXPORTER_OTLP_TRACES_PROTOCOL", "OTEL_EXPORTER_OTLP_PROTOCOL")
_PROTOCOL = "http/protobuf"


class UnsupportedTelemetryError(ValueError):
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


def traces() -> "Traces | None":
    """Return where spans go, None if nothing asks for them.

    Raises :class:`~seafoam.extras.MissingExtraError` without the extra ``telemetry``, and what :func:`configured` does.
    """
    if not configured():
        return None
    require("telemetry")
    from seafoam.api.watch.traces import Traces

    return Traces()
