"""``/api/sequences``: started, followed, downloaded, cancelled, bounded, refused; behind visitors' frames."""

import io
import json
import time as clock
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from support.api_fakes import RAISE, FakeRenderer
from support.serving import SMALL, eventually, frame, problem, serving

SCENE = {"waves": [{"model": "parametric"}]}
GATE = 333.0


class Gated(FakeRenderer):
    """From a time on, waits for a file."""

    def __init__(self, gate: Path) -> None:
        super().__init__()
        self.gate = gate

    def render(self, plan, *, time, **options):
        while time >= GATE and not self.gate.exists():
            clock.sleep(0.02)
        return super().render(plan, time=time, **options)


def asked(**changes: Any) -> dict[str, Any]:
    return {"scene": SCENE, "quality": "fast", "stop": 0.25, "format": "zip", **SMALL, **changes}


def start(client: TestClient, **changes: Any) -> dict[str, Any]:
    response = client.post("/api/sequences", json=asked(**changes))
    assert response.status_code == 202, response.text
    body = response.json()
    assert response.headers["location"] == f"sequences/{body['id']}"
    assert response.headers["cache-control"] == "no-store"
    return body


def events(client: TestClient, name: str) -> list[dict[str, Any]]:
    """All events until the sequence ends."""
    response = client.get(f"/api/sequences/{name}/events")
    assert response.headers["content-type"].startswith("text/event-stream")
    parts = [part for part in response.text.split("\n\n") if part and not part.startswith(":")]
    assert all(part.startswith("event: status\ndata: ") for part in parts)
    return [json.loads(part.split("data: ", 1)[1]) for part in parts]


@pytest.fixture(scope="module")
def gate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file that the server's renderer waits for, beside its cache."""
    return tmp_path_factory.mktemp("cache") / "gate"


@pytest.fixture(scope="module")
def client(gate: Path) -> Iterator[TestClient]:
    with serving(partial(Gated, gate), cache=gate.parent) as running:
        yield running


def test_from_the_request_to_the_file(client: TestClient, described: Any) -> None:
    begun = start(client)
    assert begun["frames"] == 6
    assert begun["status"] in ("queued", "running")
    told = events(client, begun["id"])
    assert told[-1]["status"] == "done"
    assert [each["progress"] for each in told] == sorted(each["progress"] for each in told)
    response = client.get(f"/api/sequences/{begun['id']}")
    described("/api/sequences/{sequence}", response)
    assert (status := response.json()) == told[-1]
    assert (status["progress"], status["drawn"], status["eta_s"]) == (1.0, 6, None)
    file = client.get(f"/api/sequences/{begun['id']}/file")
    assert file.headers["content-type"] == "application/zip"
    assert len(file.content) == status["bytes"]
    with zipfile.ZipFile(io.BytesIO(file.content)) as archive:
        pictures = [archive.read(name) for name in archive.namelist()]
    assert len(set(pictures)) == 6
    single = {"scene": SCENE, "quality": "fast", "time": 3 / 24, **SMALL}
    assert pictures[3] == client.post("/api/frames", json=single).content
    part = client.get(f"/api/sequences/{begun['id']}/file", headers={"Range": "bytes=0-3"})
    assert (part.status_code, part.content) == (206, b"PK\x03\x04")
    tag, date = file.headers["ETag"], file.headers["Last-Modified"]
    for known in ({"If-None-Match": f'"x", {tag}'}, {"If-Modified-Since": date}):
        assert client.get(f"/api/sequences/{begun['id']}/file", headers=known).status_code == 304
    assert start(client) == status


def test_it_goes_on_after_a_restart(tmp_path: Path) -> None:
    with serving(cache=tmp_path) as client:
        name = start(client)["id"]
        events(client, name)
        whole = client.get(f"/api/sequences/{name}/file").content
        other = start(client, start=RAISE - 2 / 24, stop=RAISE + 0.1)["id"]
        failed = events(client, other)[-1]
        assert (failed["status"], failed["drawn"]) == ("failed", 2)
        assert "could not be drawn" in failed["detail"]
        assert "secret" not in json.dumps(failed)
        assert "failed" in problem(client.get(f"/api/sequences/{other}/file"), 409)["detail"]
    with serving(cache=tmp_path) as client:
        assert client.get(f"/api/sequences/{name}").json()["status"] == "done"
        assert client.get(f"/api/sequences/{name}/file").content == whole
        assert client.get(f"/api/sequences/{other}").status_code == 404
        assert start(client, start=RAISE - 2 / 24, stop=RAISE + 0.1)["id"] == other
        assert events(client, other)[-1]["drawn"] == 2


def test_a_bounded_number_waits_and_each_can_be_cancelled(client: TestClient, gate: Path, monkeypatch) -> None:
    monkeypatch.setattr(client.app.state.context.sequences, "_most_waiting", 2)
    running = start(client, start=GATE, stop=GATE + 0.1)["id"]
    queued = start(client, start=GATE, stop=GATE + 0.2)["id"]
    full = client.post("/api/sequences", json=asked(start=GATE, stop=GATE + 0.3))
    assert problem(full, 503)["type"] == "urn:seafoam:problem:busy"
    assert int(full.headers["retry-after"]) > 0
    assert start(client, start=GATE, stop=GATE + 0.2)["id"] == queued
    assert client.get(f"/api/sequences/{queued}/file").status_code == 409
    assert client.delete(f"/api/sequences/{queued}").status_code == 204
    assert client.get(f"/api/sequences/{queued}").status_code == 404
    assert client.delete(f"/api/sequences/{running}").status_code == 204
    gate.touch()
    while (response := client.get(f"/api/sequences/{running}")).status_code == 200:
        assert response.json()["status"] == "cancelled"
    gate.unlink()
    last = start(client, stop=0.1)["id"]
    assert events(client, last)[-1]["status"] == "done"
    left = {each.name for each in (gate.parent / "sequences").iterdir()}
    assert (last in left, {running, queued} & left) == (True, set())
    assert client.delete(f"/api/sequences/{last}").status_code == 204
    assert client.get(f"/api/sequences/{last}/file").status_code == 404


def test_the_oldest_files_make_room(client: TestClient, gate: Path, monkeypatch) -> None:
    monkeypatch.setattr(client.app.state.context.sequences, "_kept", 2)
    names = [start(client, stop=stop)["id"] for stop in (0.1, 0.2, 0.3)]
    assert all(events(client, name) for name in names)
    assert [client.get(f"/api/sequences/{name}").status_code for name in names] == [404, 200, 200]
    assert {each.name for each in (gate.parent / "sequences").iterdir()} == set(names[1:])


def test_visitors_come_first(client: TestClient, gate: Path, monkeypatch) -> None:
    """While a visitor's frame is in the only worker, and another waits, no frame of the sequence is taken."""
    pool = client.app.state.context.pool
    monkeypatch.setattr(pool, "queue", 4)
    with ThreadPoolExecutor(2) as threads:
        visitors = [threads.submit(frame, client, time=GATE + number, quality="fast") for number in range(2)]
        client.portal.call(eventually, lambda: pool.active + pool.waiting == 2)
        name = start(client, stop=0.15)["id"]
        for _ in range(5):
            client.get("/healthz")
            assert client.get(f"/api/sequences/{name}").json()["drawn"] == 0
        gate.touch()
        assert all(visitor.result() for visitor in visitors)
    assert events(client, name)[-1]["status"] == "done"
    gate.unlink()


def test_without_pyav_or_gl(client: TestClient, without_gl: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    problem(without_gl.post("/api/sequences", json=asked()), 503)
    monkeypatch.setattr("seafoam.extras.find_spec", lambda name: None)
    told = problem(client.post("/api/sequences", json=asked(format="mp4")), 501)
    assert told["remedy"] == "pip install 'seafoam[video]'"


def test_names_that_nothing_has(client: TestClient) -> None:
    for path in ("", "/events", "/file"):
        problem(client.get(f"/api/sequences/{'0' * 32}{path}"), 404)
        problem(client.get(f"/api/sequences/UPPER{path}"), 422)
