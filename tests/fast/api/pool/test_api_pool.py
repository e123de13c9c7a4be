"""The pool when things go wrong: no GL, hung and dying workers, a full queue, clients that leave."""

import asyncio
import os
import signal
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest

from seafoam.quality import TIERS
from seafoam.render.service import errors
from seafoam.render.service.jobs import Draw, FrameJob, MeasureJob
from seafoam.render.service.pool import BACKGROUND_SECONDS, RenderPool
from seafoam.render.service.queues import Ticket
from seafoam.scene import Scene, load_preset
from support import api_fakes as fakes
from support.serving import SMALL, busy, eventually, left_status, problem, serving

pytestmark = pytest.mark.anyio
SCENE = Scene()


def job(at=1.0):
    return FrameJob(SCENE, TIERS["fast"], at, SCENE.camera, 8, 8, "png")


NEW = replace(job(), scene=load_preset("storm").scene)
"""With programs that the test picture does not have."""


@pytest.fixture
async def pool(request, monkeypatch, tmp_path):
    """Started; a file named lost takes the context of its :class:`LostRenderer`."""
    monkeypatch.setenv(fakes.LOST, str(tmp_path / "lost"))
    pool = RenderPool(**{"factory": fakes.FakeRenderer, "deadline": 60.0, **getattr(request, "param", {})})
    await pool.start()
    yield pool
    await pool.stop()


def pooled(**settings):
    """With a pool of these settings."""
    return pytest.mark.parametrize("pool", [settings], indirect=True, ids=[""])


async def worker_of(pool):
    await pool.wait_until_settled()
    (worker,) = pool._processes._pool_manager.worker_manager.workers
    return worker


@pooled(factory=fakes.CompilingRenderer)
async def test_what_a_worker_compiles_past_a_deadline_serves_the_next_request_but_not_for_ever(pool, monkeypatch):
    worker = await worker_of(pool)
    pool.deadline = fakes.COMPILING_SECONDS / 4
    with pytest.raises(errors.DeadlineError):
        await pool.render(NEW)
    await eventually(lambda: pool.active == 0)
    pool.deadline = 60.0
    assert (await pool.render(NEW)).content
    # Another would have compiled it again.
    assert await worker_of(pool) == worker
    assert not +pool.restarts
    monkeypatch.setattr("seafoam.render.service.pool.COMPILE_SECONDS", fakes.COMPILING_SECONDS / 4)
    pool.deadline = fakes.COMPILING_SECONDS / 4
    with pytest.raises(errors.DeadlineError):
        await pool.render(replace(NEW, quality=TIERS["high"]))
    await eventually(lambda: pool.restarts["deadline"] == 1)


def test_a_server_is_ready_when_it_has_drawn_what_the_page_opens_with():
    with serving(fakes.CompilingRenderer) as client:
        pool = client.app.state.context.pool
        pool.deadline = 0.1
        early = client.get("/api/frames/default.png?width=8&height=8")
        assert problem(early, 503)["type"] == "urn:seafoam:problem:starting"
        assert early.headers["Retry-After"]
        while (answer := client.get("/readyz")).status_code == 503:
            assert answer.headers["Retry-After"]
            time.sleep(0.05)
        pool.deadline = fakes.COMPILING_SECONDS / 4
        assert client.get("/api/frames/default.png?width=8&height=8&quality=fast").status_code == 200


@pooled(queue=2)
async def test_what_is_slow_costs_no_worker(pool, monkeypatch):
    """Waiting, a full queue, a client that leaves, and what gives way and begins late."""
    worker = await worker_of(pool)
    await a_full_queue_refuses_at_once_and_says_when_to_ask_again(pool)
    await a_running_frame_whose_client_left_is_finished(pool)
    for ticket in (Ticket(stream=True), Ticket(background=True)):
        with monkeypatch.context() as patched:
            await what_gives_way_may_begin_late(pool, patched, ticket)
    with pytest.raises(errors.RenderFailedError):  # an exception in the worker
        await pool.render(job(fakes.RAISE))
    assert (await pool.render(job())).content
    assert await worker_of(pool) == worker
    assert not +pool.restarts
    pool.deadline = 1.5 * fakes.SLOW_SECONDS  # which counts waiting
    results = await asyncio.gather(*(pool.render(job(fakes.SLOW)) for _ in range(3)), return_exceptions=True)
    assert sum(isinstance(result, errors.DeadlineError) for result in results) >= 1
    assert not isinstance(results[0], Exception)


async def a_full_queue_refuses_at_once_and_says_when_to_ask_again(pool):
    waiting = [asyncio.ensure_future(pool.render(job(fakes.SLOW))) for _ in range(3)]
    await eventually(lambda: pool.active == 1 and pool.waiting == 2)
    with pytest.raises(errors.RenderQueueFullError) as refused:
        await pool.render(job())
    assert 1 <= refused.value.retry_after <= 10
    assert all(frame.content for frame in await asyncio.gather(*waiting))
    assert pool.waiting == pool.active == 0
    assert (await pool.render(job())).content


async def a_running_frame_whose_client_left_is_finished(pool):
    running = asyncio.ensure_future(pool.render(job(fakes.SLOW)))
    await eventually(lambda: pool.active == 1)
    running.cancel()
    assert (await pool.render(job())).timings["queue"] > fakes.SLOW_SECONDS / 2


async def what_gives_way_may_begin_late(pool, monkeypatch, ticket):
    passed = 0.0
    monkeypatch.setattr("seafoam.render.service.pool.time", SimpleNamespace(time=lambda: time.time() + passed))
    await pool._free_workers.acquire()
    waiting = asyncio.ensure_future(pool.render(job(fakes.SLOW), ticket))
    await eventually(lambda: pool.waits(ticket))
    passed = (BACKGROUND_SECONDS if ticket.background else pool.deadline) - fakes.SLOW_SECONDS / 10
    pool._free_workers.release()
    assert (await waiting).content


async def test_a_worker_that_dies_is_replaced_by_one_that_draws_what_it_was_at(pool):
    worker = await worker_of(pool)
    rendering = asyncio.ensure_future(pool.render(job(fakes.SLOW)))
    await asyncio.sleep(fakes.SLOW_SECONDS / 2)
    os.kill(worker, signal.SIGKILL)
    assert (await rendering).content
    assert pool.restarts["crash"] == 1
    for seconds_before_the_next_job in (0.5, 0.0):
        os.kill(await worker_of(pool), signal.SIGKILL)
        await asyncio.sleep(seconds_before_the_next_job)
        assert (await pool.render(job())).content
    assert pool.restarts["crash"] >= 3
    with pytest.raises(errors.RenderFailedError):
        await pool.render(job(fakes.CRASH))  # kills two
    assert (await pool.render(job())).content
    assert pool.state == "ready"


async def test_a_worker_out_of_memory_gives_it_back(pool):
    """Its frame is tried by another, which fails as well; the next has all the memory again."""
    worker = await worker_of(pool)
    with pytest.raises(errors.RenderFailedError, match="twice"):
        await pool.render(job(fakes.GREEDY))
    assert (await pool.render(job())).content
    assert await worker_of(pool) != worker
    assert (pool.restarts["crash"], pool.state) == (2, "ready")


@pooled(factory=fakes.LostRenderer, check_seconds=600.0)
async def test_a_lost_context_costs_a_worker_and_no_frame_and_is_found_when_idle(pool, tmp_path):
    """No black picture is answered or measured; an idle pool finds out by its test picture."""
    draws = (Draw(16, 9, "rgba8"), Draw(16, 9, "rgba8", keep=True))
    asked = MeasureJob(SCENE, TIERS["fast"], 0.0, SCENE.camera, draws)
    sound, measured = (await pool.render(job())).content, (await pool.measure(asked))[1].pixels
    assert measured.any()
    worker = await worker_of(pool)
    (tmp_path / "lost").touch()
    assert (await pool.render(job())).content == sound
    assert await worker_of(pool) != worker
    (tmp_path / "lost").touch()
    assert ((await pool.measure(asked))[1].pixels == measured).all()
    assert (pool.restarts["crash"], pool.state) == (2, "ready")
    (tmp_path / "lost").touch()
    await pool._check()
    assert (pool.restarts["crash"], pool.state) == (3, "ready")
    assert (await pool.render(job())).content == sound


@pytest.mark.parametrize(
    ("pool", "said"),
    [({"factory": fakes.BlankRenderer}, "blank"), ({"factory": fakes.DyingRenderer}, "does not start")],
    indirect=["pool"],
)
async def test_a_renderer_that_draws_nothing_or_a_driver_that_crashes_is_none(pool, said):
    with pytest.raises(errors.RendererUnavailableError, match=said):
        await pool.render(job())
    assert pool.state == "unavailable"


@pooled(check_seconds=0.2)
async def test_an_idle_pool_draws_its_canary_finds_a_renderer_that_comes_back_and_stops_without_a_worker(pool):
    await pool.wait_until_settled()
    first = pool.succeeded_at
    await eventually(lambda: pool.succeeded_at > first)
    pool._give_up("for a moment")
    with pytest.raises(errors.RendererUnavailableError, match="for a moment"):
        await pool.render(job())
    await eventually(lambda: pool.state == "ready")
    assert (await pool.render(job())).content
    worker = await worker_of(pool)
    await pool.stop()
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


# Over HTTP


def test_without_gl_everything_but_frames_is_served_and_they_say_what_to_do(without_gl):
    for url in ("/", "/docs", "/api/presets", "/api/plans/default", "/api/masks/vac-6/data.png", "/metrics"):
        assert without_gl.get(url).status_code == 200, url
    for url in ("/api/frames/default.png?width=8&height=8", "/readyz"):
        response = without_gl.get(url)
        assert problem(response, 503)["remedy"] == fakes.REMEDY
        assert response.headers["Retry-After"]


def test_a_full_queue_a_deadline_and_a_client_that_leaves_cost_the_next_frame_nothing():
    url = "/api/frames/default.png"
    with serving(queue=1) as client:
        assert client.get(url, params=SMALL).status_code == 200
        pool = client.app.state.context.pool
        assert left_status(client, url, **SMALL, time=2.0) == 499
        assert pool.waiting == 0
        pool.queue = 0
        with busy(client):
            response = client.get(url, params=SMALL)
        assert problem(response, 503)["type"] == "urn:seafoam:problem:queue-full"
        assert int(response.headers["Retry-After"]) >= 1
        pool.queue, pool.deadline = 1, 1.0
        late = client.get(url, params=SMALL | {"time": fakes.HANG})
        assert problem(late, 504)["type"] == "urn:seafoam:problem:deadline"
        # The hung worker is killed and replaced, which the next frame may have to wait for.
        pool.deadline = 20.0
        assert client.get(url, params=SMALL).status_code == 200
        assert pool.restarts["deadline"] == 1
