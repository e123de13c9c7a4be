"""The pool when things go wrong: no GL, hung and dying workers, a full queue, clients that leave."""

import asyncio
import os
import signal
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest

from seafoam.quality import TIERS
from seafoam.render.service.errors import (
    DeadlineError,
    FrameTooLargeError,
    RendererUnavailableError,
    RenderFailedError,
    RenderQueueFullError,
)
from seafoam.render.service.jobs import Draw, FrameJob, MeasureJob
from seafoam.render.service.limits import FrameLimits
from seafoam.render.service.pool import BACKGROUND_SECONDS, RenderPool
from seafoam.render.service.priority import Ticket
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from support.api_fakes import (
    COMPILING_SECONDS,
    CRASH,
    GREEDY,
    HANG,
    LOST,
    RAISE,
    REMEDY,
    SLOW,
    SLOW_SECONDS,
    BlankRenderer,
    CompilingRenderer,
    DyingRenderer,
    FakeRenderer,
    LostRenderer,
)
from support.serving import eventually

SCENE = Scene()


def job(at=1.0):
    return FrameJob(SCENE, TIERS["draft"], at, SCENE.camera, 8, 8, "png")


NEW = replace(job(), scene=load_preset("storm").scene)
"""With programs that the test picture does not have."""


def with_pool(work, **settings):
    """Run ``work(pool)`` with a started pool, on a loop of its own."""

    async def run():
        pool = RenderPool(**{"factory": FakeRenderer, "deadline": 60.0, **settings})
        await pool.start()
        try:
            return await work(pool)
        finally:
            await pool.stop()

    return asyncio.run(run())


async def worker_of(pool):
    await pool.wait_until_settled()
    (worker,) = pool._processes._pool_manager.worker_manager.workers
    return worker


def test_a_frame_past_its_deadline_is_given_up_and_the_next_succeeds():
    async def work(pool):
        await pool.wait_until_settled()
        pool.deadline = 1.0
        with pytest.raises(DeadlineError):
            await pool.render(job(HANG))
        # The hung worker is killed and replaced, which the next frame may have to wait for.
        pool.deadline = 20.0
        assert (await pool.render(job())).content
        assert pool.restarts["deadline"] == 1

    with_pool(work)


def test_what_a_worker_compiles_past_a_deadline_serves_the_next_request():
    async def work(pool):
        worker = await worker_of(pool)
        pool.deadline = COMPILING_SECONDS / 4
        with pytest.raises(DeadlineError):
            await pool.render(NEW)
        await eventually(lambda: pool.active == 0)
        assert (await pool.render(NEW)).content
        assert await worker_of(pool) == worker
        assert not +pool.restarts

    with_pool(work, factory=CompilingRenderer)


def test_a_worker_does_not_compile_for_ever(monkeypatch):
    monkeypatch.setattr("seafoam.render.service.pool.COMPILE_SECONDS", COMPILING_SECONDS / 4)

    async def work(pool):
        await pool.wait_until_settled()
        pool.deadline = COMPILING_SECONDS / 4
        with pytest.raises(DeadlineError):
            await pool.render(NEW)
        await eventually(lambda: pool.restarts["deadline"] == 1)

    with_pool(work, factory=CompilingRenderer)


def test_a_server_is_ready_when_it_has_drawn_the_default_picture(serve):
    with serve(CompilingRenderer) as client:
        pool = client.app.state.context.pool
        pool.deadline = 0.1
        early = client.get("/api/frames/default.png?width=8&height=8")
        assert (early.status_code, early.json()["type"]) == (503, "urn:seafoam:problem:starting")
        assert early.headers["Retry-After"]
        while (answer := client.get("/readyz")).status_code == 503:
            assert answer.headers["Retry-After"]
            time.sleep(0.05)
        pool.deadline = COMPILING_SECONDS / 4
        assert client.get("/api/frames/default.png?width=8&height=8").status_code == 200


def test_the_deadline_counts_waiting():
    async def work(pool):
        await pool.wait_until_settled()
        pool.deadline = 1.5 * SLOW_SECONDS
        results = await asyncio.gather(*(pool.render(job(SLOW)) for _ in range(3)), return_exceptions=True)
        assert sum(isinstance(result, DeadlineError) for result in results) >= 1
        assert not isinstance(results[0], Exception)

    with_pool(work)


@pytest.mark.parametrize("ticket", [Ticket(stream=True), Ticket(background=True)], ids=["stream", "background"])
def test_what_gives_way_and_begins_late_costs_no_worker(monkeypatch, ticket):
    passed = 0.0
    monkeypatch.setattr("seafoam.render.service.pool.time", SimpleNamespace(time=lambda: time.time() + passed))

    async def work(pool):
        nonlocal passed
        await pool.wait_until_settled()
        await pool._free_workers.acquire()
        waiting = asyncio.ensure_future(pool.render(job(SLOW), ticket))
        await eventually(lambda: pool.waits(ticket))
        passed = (BACKGROUND_SECONDS if ticket.background else pool.deadline) - SLOW_SECONDS / 10
        pool._free_workers.release()
        assert (await waiting).content
        assert not +pool.restarts

    with_pool(work)


def test_a_worker_that_dies_while_idle_is_replaced():
    async def work(pool):
        for seconds_before_the_next_job in (0.5, 0.0):
            os.kill(await worker_of(pool), signal.SIGKILL)
            await asyncio.sleep(seconds_before_the_next_job)
            assert (await pool.render(job())).content
        assert pool.restarts["crash"] >= 2

    with_pool(work)


def test_a_worker_killed_at_work_has_its_frame_rendered_by_another():
    async def work(pool):
        worker = await worker_of(pool)
        rendering = asyncio.ensure_future(pool.render(job(SLOW)))
        await asyncio.sleep(SLOW_SECONDS / 2)
        os.kill(worker, signal.SIGKILL)
        assert (await rendering).content
        assert pool.restarts["crash"] == 1

    with_pool(work)


def test_a_frame_that_kills_two_workers_fails_and_the_next_succeeds():
    async def work(pool):
        with pytest.raises(RenderFailedError):
            await pool.render(job(CRASH))
        assert (await pool.render(job())).content
        assert pool.state == "ready"

    with_pool(work)


def test_an_exception_in_a_worker_costs_neither_worker_nor_pool():
    async def work(pool):
        worker = await worker_of(pool)
        with pytest.raises(RenderFailedError):
            await pool.render(job(RAISE))
        assert (await pool.render(job())).content
        assert await worker_of(pool) == worker

    with_pool(work)


def test_a_worker_out_of_memory_gives_it_back():
    """Its frame is tried by another, which fails as well; the next has all the memory again."""

    async def work(pool):
        worker = await worker_of(pool)
        with pytest.raises(RenderFailedError, match="twice"):
            await pool.render(job(GREEDY))
        assert (await pool.render(job())).content
        assert await worker_of(pool) != worker
        assert pool.restarts["crash"] == 2
        assert pool.state == "ready"

    with_pool(work)


@pytest.mark.parametrize("at_work", [True, False], ids=["at work", "idle"])
def test_a_lost_context_costs_a_worker_and_no_frame(monkeypatch, tmp_path, at_work):
    """No black picture is answered; an idle pool finds out by its test picture."""
    monkeypatch.setenv(LOST, str(tmp_path / "lost"))

    async def work(pool):
        sound = (await pool.render(job())).content
        worker = await worker_of(pool)
        (tmp_path / "lost").touch()
        if not at_work:
            await eventually(lambda: pool.restarts["crash"] == 1)
        assert (await pool.render(job())).content == sound
        assert await worker_of(pool) != worker
        assert pool.restarts["crash"] == 1
        assert pool.state == "ready"

    with_pool(work, factory=LostRenderer, check_seconds=600.0 if at_work else 0.2)


def test_a_lost_context_is_not_measured(monkeypatch, tmp_path):
    monkeypatch.setenv(LOST, str(tmp_path / "lost"))
    draws = (Draw(16, 9, "rgba8"), Draw(16, 9, "rgba8", keep=True))
    asked = MeasureJob(SCENE, TIERS["draft"], 0.0, SCENE.camera, draws)

    async def work(pool):
        sound = (await pool.measure(asked))[1].pixels
        (tmp_path / "lost").touch()
        assert ((await pool.measure(asked))[1].pixels == sound).all()
        assert sound.any()
        assert pool.restarts["crash"] == 1
        assert pool.state == "ready"

    with_pool(work, factory=LostRenderer, check_seconds=600.0)


def test_a_full_queue_refuses_at_once_and_says_when_to_ask_again():
    async def work(pool):
        await pool.wait_until_settled()
        waiting = [asyncio.ensure_future(pool.render(job(SLOW))) for _ in range(3)]
        await eventually(lambda: pool.active == 1 and pool.waiting == 2)
        with pytest.raises(RenderQueueFullError) as refused:
            await pool.render(job())
        assert 1 <= refused.value.retry_after <= 10
        assert all(frame.content for frame in await asyncio.gather(*waiting))
        assert pool.waiting == pool.active == 0
        assert (await pool.render(job())).content

    with_pool(work, queue=2)


def test_a_waiting_frame_whose_client_left_gives_its_place_back():
    async def work(pool):
        await pool.wait_until_settled()
        first, second = (asyncio.ensure_future(pool.render(job(SLOW))) for _ in range(2))
        await eventually(lambda: pool.active == 1 and pool.waiting == 1)
        second.cancel()
        await eventually(lambda: pool.waiting == 0)
        assert (await first).content
        assert (await pool.render(job())).timings["queue"] < SLOW_SECONDS

    with_pool(work)


def test_a_running_frame_whose_client_left_keeps_its_worker():
    async def work(pool):
        worker = await worker_of(pool)
        running = asyncio.ensure_future(pool.render(job(SLOW)))
        await eventually(lambda: pool.active == 1)
        running.cancel()
        assert (await pool.render(job())).timings["queue"] > SLOW_SECONDS / 2
        assert await worker_of(pool) == worker
        assert not +pool.restarts

    with_pool(work)


def test_workers_are_recycled():
    async def work(pool):
        first = await worker_of(pool)
        for _ in range(3):
            assert (await pool.render(job())).content
        assert pool.restarts["recycled"] >= 1
        assert await worker_of(pool) != first

    with_pool(work, recycle=2)


def test_a_renderer_that_draws_nothing_is_no_renderer():
    async def work(pool):
        with pytest.raises(RendererUnavailableError, match="blank"):
            await pool.render(job())
        assert pool.state == "unavailable"

    with_pool(work, factory=BlankRenderer)


def test_a_driver_that_crashes_is_no_renderer():
    async def work(pool):
        with pytest.raises(RendererUnavailableError, match="does not start"):
            await pool.render(job())

    with_pool(work, factory=DyingRenderer)


def test_a_renderer_that_comes_back_is_found_again():
    async def work(pool):
        await pool.wait_until_settled()
        pool._give_up("for a moment")
        with pytest.raises(RendererUnavailableError, match="for a moment"):
            await pool.render(job())
        await eventually(lambda: pool.state == "ready")
        assert (await pool.render(job())).content

    with_pool(work, check_seconds=0.2)


def test_an_idle_pool_draws_its_canary():
    async def work(pool):
        await pool.wait_until_settled()
        first = pool.succeeded_at
        await eventually(lambda: pool.succeeded_at > first)

    with_pool(work, check_seconds=0.2)


def test_a_stopped_pool_leaves_no_worker():
    async def work(pool):
        return await worker_of(pool)

    worker = with_pool(work)
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


def test_limits_are_checked_before_anything_is_allocated():
    limits = FrameLimits(side=100, sampled_side=150, samples=5000)
    limits.check(100, 50, 1)
    for (width, height, samples), field in {
        (101, 1, 1): "width",
        (1, 0, 1): "height",
        (76, 1, 4): "width",
        (100, 51, 1): "height",
    }.items():
        with pytest.raises(FrameTooLargeError) as refused:
            limits.check(width, height, samples)
        assert refused.value.field == field


# Over HTTP


def test_without_gl_everything_but_frames_is_served(without_gl):
    for url in (
        "/",
        "/docs",
        "/api/presets",
        "/api/plans/default",
        "/api/masks/vac-6/data.png",
        "/healthz",
        "/metrics",
    ):
        assert without_gl.get(url).status_code == 200, url


@pytest.mark.parametrize("url", ["/api/frames/default.png?width=8&height=8", "/readyz"])
def test_without_gl_frames_say_what_to_do(without_gl, url):
    response = without_gl.get(url)
    assert response.status_code == 503
    assert response.headers["Content-Type"] == "application/problem+json"
    assert response.headers["Retry-After"]
    assert response.json()["remedy"] == REMEDY


def test_a_full_queue_over_http(serve):
    with serve(queue=0) as client:
        url = "/api/frames/default.png?width=8&height=8"
        assert client.get(url).status_code == 200
        pool = client.app.state.context.pool
        client.portal.call(pool._free_workers.acquire)
        response = client.get(url)
        assert response.status_code == 503
        assert int(response.headers["Retry-After"]) >= 1
        assert response.json()["type"] == "urn:seafoam:problem:queue-full"
        client.portal.call(pool._free_workers.release)
        assert client.get(url).status_code == 200


def test_a_deadline_over_http(serve):
    with serve() as client:
        assert client.get("/api/frames/default.png?width=8&height=8").status_code == 200
        client.app.state.context.pool.deadline = 1.0
        response = client.get(f"/api/frames/default.png?width=8&height=8&time={HANG}")
        assert response.status_code == 504
        assert response.json()["type"] == "urn:seafoam:problem:deadline"
        client.app.state.context.pool.deadline = 20.0
        assert client.get("/api/frames/default.png?width=8&height=8").status_code == 200


def test_a_client_that_leaves_gives_its_place_back(serve):
    sent = []
    scope = {
        "type": "http", "method": "GET", "path": "/api/frames/default.png", "raw_path": b"/api/frames/default.png",
        "query_string": b"width=8&height=8", "headers": [], "http_version": "1.1", "scheme": "http", "root_path": "",
    }  # fmt: skip

    with serve() as client:
        assert client.get("/api/frames/default.png?width=8&height=8").status_code == 200
        pool = client.app.state.context.pool

        async def leave():
            arriving = iter([{"type": "http.request", "body": b"", "more_body": False}])

            async def receive():
                for message in arriving:
                    return message
                await eventually(lambda: pool.waiting == 1)
                return {"type": "http.disconnect"}

            async def send(message):
                sent.append(message)

            await pool._free_workers.acquire()
            await client.app(scope, receive, send)
            assert pool.waiting == 0
            pool._free_workers.release()

        client.portal.call(leave)
        assert client.get("/api/frames/default.png?width=8&height=8").status_code == 200
    assert sent[0]["status"] == 499
