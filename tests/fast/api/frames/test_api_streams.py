"""Streams of frames: who gets one, which frames are drawn and which given up, and what the rest of the server keeps."""

import asyncio
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from httpx2 import Response
from starlette.testclient import TestClient

from seafoam.api.frames.streams import FRAMES_AT_ONCE, LEASE_SECONDS, RETRY_SECONDS, Stream, Streams
from seafoam.api.routers.streams import LATE_FRAMES
from seafoam.quality import TIERS
from seafoam.render.service.errors import DeadlineError
from seafoam.render.service.queues import Ticket
from seafoam.scene import Scene, load_preset
from support.serving import SMALL, Clock, answering, busy, eventually, left_status, picture, problem, serving

pytestmark = pytest.mark.anyio
FAST = {"scene": {}, "quality": "fast"}
VIEW = {"x": 0.0, "y": 4.0, "z": 0.0, "yaw": 0.2, "pitch": -0.1, "roll": 0.0, "fov": 0.9}
KEY = "correct-horse-battery"


@pytest.fixture(scope="module")
def streaming() -> Iterator[TestClient]:
    """A server that gives two streams, whose leases do not end: on a busy machine a step takes longer than one."""
    with serving(streams=2, cache_memory=4 << 20) as client:
        client.app.state.context.streams._clock = Clock()
        yield client


@pytest.fixture
def context(streaming: TestClient) -> Iterator[Any]:
    """What the server is made of; none of its streams is left open."""
    context = streaming.app.state.context
    yield context
    for id in list(context.streams._open):
        streaming.delete(f"/api/streams/{id}")


def opened(client: TestClient, **body: Any) -> str:
    response = client.post("/api/streams", json=FAST | body)
    assert response.status_code == 201, response.text
    return str(response.json()["id"])


def ask(client: TestClient, stream: str, **changes: Any) -> Response:
    return client.get(f"/api/streams/{stream}/frame.jpg", params=SMALL | VIEW | {"time": 1.0} | changes)


def drawn(client: TestClient, stream: str, **changes: Any) -> Response:
    response = ask(client, stream, **changes)
    assert response.status_code == 200, response.text
    return response


async def settle() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


# Opening and ending


def test_a_stream_is_opened_shown_and_ended_which_is_told_and_may_be_done_again(streaming, context) -> None:
    response = streaming.post("/api/streams", json=FAST)
    state = response.json()
    assert (response.status_code, response.headers["Location"]) == (201, f"streams/{state['id']}")
    assert (state["lease"], state["limit"], state["open"]) == (LEASE_SECONDS, 2, 1)
    drawn(streaming, state["id"])
    assert streaming.delete(f"/api/streams/{state['id']}").status_code == 204
    after = streaming.get("/api/streams").json()
    assert after == {"limit": 2, "open": 0}
    id = opened(streaming)
    for _ in range(2):
        assert streaming.delete(f"/api/streams/{id}").status_code == 204
    for response in (ask(streaming, id), streaming.put(f"/api/streams/{id}", json=FAST)):
        assert problem(response, 404)["errors"][0]["parameter"] == "stream"


def test_a_stream_shows_another_scene_without_another_place_and_none_that_is_refused(streaming, context) -> None:
    id = opened(streaming)
    first = drawn(streaming, id).content
    assert drawn(streaming, id).content == first
    other = {"scene": {"waves": [{"model": "parametric"}]}, "quality": "fast"}
    assert streaming.put(f"/api/streams/{id}", json=other).status_code == 204
    assert drawn(streaming, id).content != first
    assert streaming.put(f"/api/streams/{id}", json=FAST | {"quality": "standard"}).status_code == 204
    assert context.streams.find(id).quality == TIERS["standard"]
    frame = drawn(streaming, id).content
    bad = {"scene": {"water": {"roughness": -1}}, "quality": "fast"}
    for send, path in ((streaming.post, ""), (streaming.put, f"/{id}")):
        assert send(f"/api/streams{path}", json=bad).status_code == 422
    assert drawn(streaming, id).content == frame
    assert streaming.get("/api/streams").json()["open"] == 1


def test_where_all_are_taken_the_answer_says_when_to_ask_again_and_nothing_is_planned(
    streaming, context, monkeypatch
) -> None:
    first, _ = opened(streaming), opened(streaming)
    refused = streaming.post("/api/streams", json=FAST)
    assert problem(refused, 503)["type"] == "urn:seafoam:problem:streams-full"
    assert refused.headers["Retry-After"] == str(RETRY_SECONDS)
    streaming.delete(f"/api/streams/{first}")
    first = opened(streaming)
    monkeypatch.setattr("seafoam.api.context.compile_scene", None)
    assert streaming.post("/api/streams", json=FAST).status_code == 503
    streaming.delete(f"/api/streams/{first}")
    assert streaming.post("/api/streams", json=FAST).status_code == 500


# Leases


def stream_of(streams: Streams) -> Stream:
    return streams.open(Scene(), TIERS["fast"])


def test_a_stream_that_is_not_asked_ends_and_its_place_is_free() -> None:
    clock = Clock()
    streams = Streams(1, clock)
    stream = stream_of(streams)
    assert streams.open(Scene(), TIERS["fast"]) is None
    for _ in range(2):
        clock.now += LEASE_SECONDS - 1.0
        assert streams.find(stream.id) is stream  # the lease begins anew
    clock.now += LEASE_SECONDS + 1.0
    assert (len(streams), streams.find(stream.id)) == (0, None)
    # An id says nothing of the one before.
    ids = {stream_of(Streams(1)).id for _ in range(100)} | {stream.id, stream_of(streams).id}
    assert len(ids) == 102
    assert min(map(len, ids)) >= 16


def test_a_late_frame_does_not_end_its_stream_and_where_none_comes_it_is_said(streaming, context, monkeypatch) -> None:
    clock = Clock()
    monkeypatch.setattr(context.streams, "_clock", clock)
    id = opened(streaming)

    async def late(job: Any, ticket: Ticket) -> None:
        clock.now += 5 * LEASE_SECONDS
        raise DeadlineError("timeout")

    for _ in range(2):
        with monkeypatch.context() as patched:
            patched.setattr(context.pool, "render", late)
            assert [ask(streaming, id).status_code for _ in range(LATE_FRAMES)] == [204] * LATE_FRAMES
            assert problem(ask(streaming, id), 504)["type"] == "urn:seafoam:problem:deadline"
        drawn(streaming, id)


# Frames


def test_a_frame_is_lossy_and_neither_kept_nor_shared(streaming, context) -> None:
    scene = load_preset("default").scene.model_dump(mode="json")
    id = opened(streaming, scene=scene)
    size = {"width": 160, "height": 90}
    count = context.metrics.frames.labels("jpeg")._value
    before = count.get()
    response, *others = (drawn(streaming, id, **size) for _ in range(3))
    assert {other.content for other in others} == {response.content}
    assert (count.get(), dict(context.frames.origins)) == (before + 3, {})
    assert (response.headers["Content-Type"], response.headers["Cache-Control"]) == ("image/jpeg", "no-store")
    assert "ETag" not in response.headers
    stages = [part.split(";")[0] for part in response.headers["Server-Timing"].split(", ")]
    assert stages == ["queue", "plan", "render", "read", "encode"]
    assert (picture(response).format, picture(response).size) == ("JPEG", (160, 90))
    camera = {name: value for name, value in VIEW.items() if name not in "xyz"}
    camera |= {"position": [VIEW[axis] for axis in "xyz"]}
    body = {"scene": scene, "quality": "fast", "camera": camera, "time": 1.0, "dither": False, **size}
    exact = streaming.post("/api/frames", json=body)
    difference = np.asarray(picture(response).convert("RGB"), float) - np.asarray(picture(exact), float)
    assert 0.0 < np.sqrt(np.mean(difference**2)) < 4.0


def test_a_size_beyond_the_limits_is_refused_before_it_is_drawn() -> None:
    client = answering(max_samples=1000, max_side=64)
    id = stream_of(client.app.state.context.streams).id
    for size, parameter, most in (({"width": 40, "height": 40}, "height", 1000 // 40), ({"width": 65}, "width", 64)):
        told = problem(ask(client, id, **size), 422)
        (error,) = told["errors"]
        assert told["type"] == "urn:seafoam:problem:frame-too-large"
        assert (error["parameter"], error["allowed"]) == (parameter, {"minimum": 1, "maximum": most})


# Which frames are drawn


def waits(client: TestClient, count: int) -> None:
    """Until so many frames wait for a worker."""
    pool = client.app.state.context.pool
    client.portal.call(eventually, lambda: len(pool._tickets) == count)


def test_a_third_frame_gives_up_the_oldest_that_waits(streaming, context) -> None:
    id = opened(streaming)
    drawn(streaming, id)
    (stream,) = context.streams._open.values()
    with ThreadPoolExecutor(3) as threads:
        with busy(streaming) as pool:
            asked = []
            for number in range(3):
                asked.append(threads.submit(ask, streaming, id, time=float(number)))
                waits(streaming, min(number + 1, FRAMES_AT_ONCE))
            overtaken = asked[0].result(30)
            assert (overtaken.status_code, overtaken.content) == (204, b"")
            assert overtaken.headers["Cache-Control"] == "no-store"
            # Neither a queue's place nor a worker is theirs.
            assert pool.waiting == 0
        assert [each.result().status_code for each in asked[1:]] == [200, 200]
    assert stream.frames == []
    drawn(streaming, id)


def test_a_stream_that_ends_or_a_page_that_leaves_gives_up_its_frames(streaming, context) -> None:
    id = opened(streaming)
    drawn(streaming, id)
    left = left_status(streaming, f"/api/streams/{id}/frame.jpg", **SMALL, **VIEW, time=1.0)
    assert (left, context.streams.find(id).frames, len(context.pool._tickets)) == (499, [], 0)
    with busy(streaming) as pool, ThreadPoolExecutor(2) as threads:
        asked = [threads.submit(ask, streaming, id, time=float(number)) for number in range(2)]
        waits(streaming, 2)
        assert streaming.delete(f"/api/streams/{id}").status_code == 204
        assert [each.result(30).status_code for each in asked] == [204, 204]
        assert not pool._tickets
    drawn(streaming, opened(streaming))


class Drawing:
    """Frames of one stream, which are begun and finished when told."""

    def __init__(self) -> None:
        self.stream = stream_of(Streams(1))
        self.queue: set[Ticket] = set()
        self.finish: dict[str, asyncio.Event] = {}
        self.begin: dict[str, asyncio.Event] = {}
        self.placed: list[str] = []
        self.ended: dict[str, str] = {}

    async def frame(self, name: str) -> None:
        ticket = Ticket(stream=True)
        try:
            async with self.stream.place(ticket, self.queue.__contains__):
                self.placed.append(name)
                self.queue.add(ticket)
                await self.begin[name].wait()
                self.queue.remove(ticket)
                await self.finish[name].wait()
            self.ended[name] = "drawn"
        except asyncio.CancelledError:
            self.ended[name] = "given up"

    async def ask(self, name: str, *, begun: bool = False) -> asyncio.Task[None]:
        self.begin[name], self.finish[name] = asyncio.Event(), asyncio.Event()
        task = asyncio.ensure_future(self.frame(name))
        if begun:
            self.begin[name].set()
        await settle()
        return task


async def test_a_page_that_asks_faster_than_frames_are_drawn_gets_what_was_begun() -> None:
    """With two workers, both frames are begun when a third comes, and a fourth before either is finished."""
    drawing = Drawing()
    tasks = [await drawing.ask(name, begun=True) for name in "ab"]
    tasks += [await drawing.ask(name) for name in "cde"]
    assert drawing.ended == {"c": "given up", "d": "given up"}
    assert drawing.placed == ["a", "b"]  # as many as there are places
    drawing.finish["a"].set()
    await settle()
    assert drawing.placed == ["a", "b", "e"]
    drawing.begin["e"].set()
    for name in "be":
        drawing.finish[name].set()
    await asyncio.gather(*tasks)
    assert drawing.ended == {"c": "given up", "d": "given up", "a": "drawn", "b": "drawn", "e": "drawn"}
    assert drawing.stream.frames == []


# The rest of the server


def test_single_frames_go_before_those_of_streams(streaming, context, monkeypatch) -> None:
    id = opened(streaming)
    drawn(streaming, id)
    pool = context.pool
    begun: list[str] = []
    run = pool._run

    async def noting(work: Any, args: Any, expires: float, grace: float = 0.0) -> Any:
        begun.append("stream" if args[0].lossy else "single")
        return await run(work, args, expires, grace)

    monkeypatch.setattr(pool, "_run", noting)
    monkeypatch.setattr(pool, "queue", 1)
    with ThreadPoolExecutor(3) as threads:
        with busy(streaming):
            asked = [threads.submit(ask, streaming, id, time=float(number)) for number in range(2)]
            waits(streaming, 2)
            # The queue has one place, which frames of streams do not take.
            asked.append(threads.submit(streaming.get, "/api/frames/default.png", params=SMALL))
            streaming.portal.call(eventually, lambda: pool.waiting == 1)
        assert [each.result().status_code for each in asked] == [200, 200, 200]
    assert begun == ["single", "stream", "stream"]


def test_a_frame_of_a_stream_has_no_rate_while_all_else_of_streams_has() -> None:
    client = answering(rate=0.001, rate_burst=1)
    streams = client.app.state.context.streams
    streams._clock = Clock()  # on a busy machine too no lease ends
    stream = stream_of(streams)
    for _ in range(5):  # refused for what they lack, not for their number
        assert client.get(f"/api/streams/{stream.id}/frame.jpg").status_code == 422
    # What opens, changes and ends them counts.
    assert client.delete(f"/api/streams/{stream.id}").status_code == 204
    assert client.post("/api/streams", json={}).status_code == 429
    for settings, refused in (({}, 422), ({"api_keys": f"alice:{KEY}"}, 401)):
        client = answering(rate=0.001, rate_burst=2, **settings)
        asked = [client.get("/api/streams/none/frame.jpg").status_code for _ in range(3)]
        assert asked == [refused, refused, 429]
    # That of an open stream needs a key as all else does.
    streams = client.app.state.context.streams
    streams._clock = Clock()
    assert client.get(f"/api/streams/{stream_of(streams).id}/frame.jpg").status_code == 401
