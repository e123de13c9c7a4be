"""Request ids, the log as lines of JSON, and traces by OpenTelemetry."""

import asyncio
import io
import json
import logging
import re
from collections.abc import Callable, Iterator
from itertools import pairwise
from types import SimpleNamespace
from typing import get_args

import pytest
from opentelemetry.sdk.trace import TracerProvider
from opentelemetry.sdk.trace.export import SimpleSpanProcessor
from opentelemetry.sdk.trace.export.in_memory_span_exporter import InMemorySpanExporter
from starlette.responses import Response
from starlette.testclient import TestClient

from seafoam.api.frames.plans import ResolvedFrame
from seafoam.api.frames.respond import answer
from seafoam.api.watch import logs, metrics
from seafoam.extras import MissingExtraError
from seafoam.render.service.jobs import EncodedFrame, Origin
from support.command import imported
from support.serving import answering

Logged = Callable[[], list[dict[str, object]]]
"""What was written since, a line each."""


@pytest.fixture
def logged() -> Iterator[Logged]:
    """What was written since, a line each."""
    stream = io.StringIO()
    handler = logging.StreamHandler(stream)
    handler.setFormatter(logs.JsonLines())
    logs.log.addHandler(handler)
    level = logs.log.level
    logs.log.setLevel(logging.INFO)
    yield lambda: [json.loads(line) for line in stream.getvalue().splitlines()]
    logs.log.removeHandler(handler)
    logs.log.setLevel(level)


@pytest.fixture(scope="module")
def asked() -> TestClient:
    return answering(log_format="json")


def test_a_sane_id_is_kept_also_where_an_error_is_unexpected_and_another_replaced(
    asked: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("seafoam.api.routers.presets.every_parameter", lambda: 1 / 0)
    for sent in ("abc", "01J8-X_y.z:1", "a" * 128):
        for url, status in (("/api/presets/none", 404), ("/api/quality", 500)):
            response = asked.get(url, headers={"X-Request-ID": sent})
            assert (response.status_code, response.json()["request_id"]) == (status, sent)
            assert response.headers["X-Request-ID"] == sent
    assert len({asked.get("/healthz").headers["X-Request-ID"] for _ in range(2)}) == 2
    for sent in ("", " ", "a b", "a" * 129, '{"a":1}', "é".encode(), b"\xff", "a,b", "-a", "<b>"):
        response = asked.get("/healthz", headers={"X-Request-ID": sent})
        assert re.fullmatch("[0-9a-f]{32}", response.headers["X-Request-ID"]), sent


def test_a_line_for_each_request_but_for_probes(asked: TestClient, logged: Logged) -> None:
    response = asked.get("/api/presets/none?x=1", headers={"X-Request-ID": "one"})
    asked.head("/api/quality")
    for url in ("/learn/", "/healthz", "/readyz"):
        asked.get(url)
    first, second, third = logged()
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}\+00:00", str(first.pop("time")))
    assert 0.0 < float(str(first.pop("duration_ms"))) < 60_000.0
    assert first == {
        "level": "info", "logger": "seafoam.api.watch.logs", "message": "GET /api/presets/{preset} 422",
        "request_id": "one", "method": "GET", "route": "/api/presets/{preset}", "path": "/api/presets/none",
        "status": 422, "bytes": len(response.content), "client": "testclient",
    }  # fmt: skip
    assert (second["method"], second["route"], second["bytes"]) == ("HEAD", "/api/quality", 0)
    assert third["route"] == "(page)"


def test_a_key_is_logged_by_its_name(logged: Logged) -> None:
    key = "correct-horse-battery"
    restricted = answering(log_format="json", api_keys=f"alice:{key}")
    restricted.get("/api/quality", headers={"Authorization": f"Bearer {key}"})
    restricted.get("/api/quality")
    assert [(line["client"], line["status"]) for line in logged()] == [("alice", 200), ("testclient", 401)]
    assert key not in json.dumps(logged())


def test_frames_of_streams_are_logged_if_they_are_refused(monkeypatch: pytest.MonkeyPatch, logged: Logged) -> None:
    asked = answering(log_format="json")
    path = "/api/streams/x/frame.jpg"
    asked.get(path)
    monkeypatch.setattr("seafoam.api.guard.access_control.AccessControl.__call__", Response(status_code=204))
    asked.get(path)
    asked.get("/api/streams")
    assert [(line["path"], line["status"]) for line in logged()] == [(path, 422), ("/api/streams", 204)]


ENDPOINT = {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:4318"}
PARENT = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01"


@pytest.fixture
def exporter(monkeypatch: pytest.MonkeyPatch) -> InMemorySpanExporter:
    """Has the spans of applications that are made from now on."""
    kept, provider, configured = InMemorySpanExporter(), TracerProvider(), metrics.telemetry
    provider.add_span_processor(SimpleSpanProcessor(kept))
    monkeypatch.setattr(metrics, "_TRACER", provider.get_tracer("seafoam"))
    monkeypatch.setattr("seafoam.api.app.telemetry", lambda: {**configured(), "tracer_provider": provider})
    return kept


def test_without_the_packages_the_error_names_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(*next(iter(ENDPOINT.items())))
    monkeypatch.setattr("seafoam.extras._installed", lambda module: False)
    with pytest.raises(MissingExtraError, match=r"seafoam\[telemetry\]"):
        metrics.telemetry()


def test_nothing_is_imported_where_nothing_asks_for_it() -> None:
    # FastAPI imports the API of OpenTelemetry itself.
    found = imported("from seafoam.api.app import create_app; create_app()")
    assert [name for name in found if name.startswith(("opentelemetry.sdk", "opentelemetry.exporter"))] == []


def test_a_span_for_each_request_of_which_an_unexpected_error_is_one(
    exporter: InMemorySpanExporter, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = answering()
    client.get("/api/presets/none", headers={"traceparent": PARENT})
    client.head("/api/quality")
    for untraced in ("/healthz", "/api/streams/x/frame.jpg"):
        client.get(untraced)
    monkeypatch.setattr("seafoam.api.routers.presets.every_parameter", lambda: 1 / 0)
    client.get("/api/quality")
    first, second, failed = exporter.get_finished_spans()
    assert first.name == "GET /api/presets/{preset}"
    assert first.attributes.items() >= {"http.response.status_code": 404, "url.path": "/api/presets/none"}.items()
    assert f"{first.parent.trace_id:032x}" == PARENT.split("-")[1]
    assert (first.status.is_unset, second.name, second.parent) == (True, "HEAD /api/quality", None)
    assert (failed.status.is_ok, failed.status.is_unset) == (False, False)


def test_a_drawn_frames_stages_are_spans_within_its_request(exporter: InMemorySpanExporter) -> None:
    timings = {"queue": 0.5, "plan": 0.001, "render": 0.02, "read": 0.001, "encode": 0.004}

    async def draw(*_: object, **__: object) -> EncodedFrame:
        return EncodedFrame(b"", timings, origin)

    async def leave() -> None:
        await asyncio.Event().wait()

    for origin in get_args(Origin):
        counting = SimpleNamespace(count_frame=lambda *_: None)
        context = SimpleNamespace(frames=SimpleNamespace(frame=draw), metrics=counting)
        request = SimpleNamespace(method="POST", receive=leave)
        with metrics._TRACER.start_as_current_span(origin):
            asyncio.run(answer(ResolvedFrame(SimpleNamespace(format="png"), "", {}, None), request, context))
    spans = exporter.get_finished_spans()
    parent = next(each for each in spans if each.name == "drawn")
    stages = [each for each in spans if each.name not in get_args(Origin)]
    assert [each.name for each in stages] == list(timings)
    for before, after in pairwise(stages):
        assert before.end_time == after.start_time
    for each in stages:
        assert each.parent.span_id == parent.context.span_id
        assert each.end_time - each.start_time == pytest.approx(1e9 * timings[each.name], abs=1)
