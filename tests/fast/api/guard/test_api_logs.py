"""Request ids, and the log as lines of JSON."""

import io
import json
import logging
import re
from collections.abc import Callable, Iterator

import pytest
from starlette.responses import Response
from starlette.testclient import TestClient

from seafoam.api.watch import logs
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
def client() -> TestClient:
    return answering(log_format="json")


def test_each_request_has_an_id_also_where_an_error_is_unexpected(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, other = (client.get("/healthz").headers["X-Request-ID"] for _ in range(2))
    assert re.fullmatch("[0-9a-f]{32}", one)
    assert one != other
    monkeypatch.setattr("seafoam.api.routers.presets.every_parameter", lambda: 1 / 0)
    response = client.get("/api/quality", headers={"X-Request-ID": "one"})
    assert response.status_code == 500
    assert response.headers["X-Request-ID"] == response.json()["request_id"] == "one"


def test_a_sane_id_is_kept_and_another_replaced(client: TestClient) -> None:
    for sent in ("abc", "01J8-X_y.z:1", "a" * 128):
        response = client.get("/api/presets/none", headers={"X-Request-ID": sent})
        assert response.headers["X-Request-ID"] == response.json()["request_id"] == sent
    for sent in ("", " ", "a b", "a" * 129, '{"a":1}', "é".encode(), b"\xff", "a,b", "-a", "<b>"):
        response = client.get("/healthz", headers={"X-Request-ID": sent})
        assert re.fullmatch("[0-9a-f]{32}", response.headers["X-Request-ID"]), sent


def test_a_line_for_each_request_but_for_probes(client: TestClient, logged: Logged) -> None:
    response = client.get("/api/presets/none?x=1", headers={"X-Request-ID": "one"})
    client.head("/api/quality")
    client.get("/learn/")
    client.get("/healthz")
    client.get("/readyz")
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
    client = answering(log_format="json")
    path = "/api/streams/x/frame.jpg"
    client.get(path)
    monkeypatch.setattr("seafoam.api.guard.access_control.AccessControl.__call__", Response(status_code=204))
    client.get(path)
    client.get("/api/streams")
    assert [(line["path"], line["status"]) for line in logged()] == [(path, 422), ("/api/streams", 204)]


def test_an_exception_is_part_of_its_line() -> None:
    try:
        raise ValueError("two\nlines")
    except ValueError as error:
        record = logging.LogRecord("x", logging.ERROR, "", 0, "failed: %s", ("it",), (type(error), error, None))
    line = json.loads(logs.JsonLines().format(record))
    assert line["message"] == "failed: it"
    assert line["level"] == "error"
    assert "ValueError: two\nlines" in line["exception"]


def test_json_replaces_uvicorns_own_log_and_as_text_uvicorn_writes_the_lines(
    monkeypatch: pytest.MonkeyPatch, logged: Logged
) -> None:
    made: dict[str, object] = {}
    monkeypatch.setattr(logging, "basicConfig", lambda **options: made.update(options))
    assert logs.configure("json") == {"log_config": None, "access_log": False}
    assert isinstance(made["handlers"][0].formatter, logs.JsonLines)
    answering().get("/api/quality")
    assert logged() == []
