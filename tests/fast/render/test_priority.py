"""Whose frame is drawn next, and programs that are compiled meanwhile."""

import asyncio
import multiprocessing
import os
import time
from collections.abc import Callable

import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render import ahead
from seafoam.render.service.frame_cache import InFlight
from seafoam.render.service.queues import STREAMED, PrioritySemaphore, Ticket
from seafoam.scene import load_preset
from support.api_fakes import FakeRenderer
from support.serving import serving

pytestmark = pytest.mark.anyio


async def settle() -> None:
    for _ in range(5):
        await asyncio.sleep(0)


async def served(
    tickets: dict[str, Ticket], new: Callable[[str], tuple[str, Ticket] | None] = lambda name: None
) -> list[str]:
    """In which order one worker serves callers. new: who comes when a caller has been served."""
    slots, order, tasks = PrioritySemaphore(1), [], []
    await slots.acquire()

    async def wait(name: str, ticket: Ticket) -> None:
        await slots.acquire(ticket)
        order.append(name)
        if (come := new(name)) is not None:
            tasks.append(asyncio.ensure_future(wait(*come)))

    tasks += [asyncio.ensure_future(wait(name, ticket)) for name, ticket in tickets.items()]
    await settle()
    while len(order) < len(tasks):
        slots.release()
        await settle()
    await asyncio.gather(*tasks)
    assert slots.locked()
    slots.release()
    assert not slots.locked()
    return order


async def test_frames_of_streams_go_between_visitors_and_the_background_in_order_of_arrival() -> None:
    tickets = {"b1": Ticket(True), "s1": Ticket(stream=True), "b2": Ticket(True), "v1": Ticket(), "b3": Ticket(True)}
    tickets |= {"s2": Ticket(stream=True), "v2": Ticket()}

    def asked_for_by_a_visitor(name: str) -> None:
        tickets["b3"].background = False

    assert await served(tickets, asked_for_by_a_visitor) == ["v1", "b3", "v2", "s1", "s2", "b1", "b2"]


async def test_the_background_is_served_while_streams_always_wait() -> None:
    """Two streams ask for the next frame whenever one has come."""
    left = iter(range(5 * STREAMED))

    def again(name: str) -> tuple[str, Ticket] | None:
        return (name, Ticket(stream=True)) if name == "stream" and next(left, None) is not None else None

    tickets = {f"b{number}": Ticket(True) for number in range(2)}
    tickets |= {"stream": Ticket(stream=True), "v": Ticket()}
    order = await served(tickets, again)
    assert order[0] == "v"
    assert [place for place, name in enumerate(order) if name.startswith("b")] == [STREAMED + 1, 2 * STREAMED + 2]


async def test_no_worker_is_lost_with_a_caller_that_gives_up() -> None:
    slots = PrioritySemaphore(1)
    await slots.acquire()
    first, second = (asyncio.ensure_future(slots.acquire()) for _ in range(2))
    await settle()
    first.cancel()
    slots.release()  # before the cancelled one has run
    await settle()
    assert second.done()
    third, fourth = (asyncio.ensure_future(slots.acquire()) for _ in range(2))
    await settle()
    slots.release()
    third.cancel()  # given and cancelled at once
    await settle()
    assert fourth.done()
    assert not fourth.cancelled()
    slots.release()
    assert not slots.locked()


async def test_identical_calls_share_a_run_and_its_failure() -> None:
    runs: InFlight[int] = InFlight()
    starts = []

    async def work(ticket: Ticket) -> int:
        starts.append(ticket)
        await asyncio.sleep(0.01)
        if len(starts) == 2:
            raise KeyError("lost")
        return len(starts)

    async def three(background: bool) -> list[int | BaseException]:
        calls = (runs.run("a", work, background=background) for _ in range(3))
        return await asyncio.gather(*calls, return_exceptions=True)

    assert await three(False) == [1, 1, 1]
    assert [type(error) for error in await three(True)] == [KeyError] * 3
    assert await three(True) == [3, 3, 3]
    assert [ticket.background for ticket in starts] == [False, True, True]


async def test_a_run_ends_with_its_last_caller_and_goes_to_the_front_with_its_first_visitor() -> None:
    runs: InFlight[int] = InFlight()
    tickets: list[Ticket] = []
    ended: list[bool] = []

    async def work(ticket: Ticket) -> int:
        tickets.append(ticket)
        try:
            await asyncio.sleep(60)
        finally:
            ended.append(True)
        return 0

    background = asyncio.ensure_future(runs.run("a", work, background=True))
    await settle()
    visitor = asyncio.ensure_future(runs.run("a", work, background=False))
    await settle()
    assert len(tickets) == 1
    assert not tickets[0].background
    background.cancel()
    await settle()
    assert not ended
    visitor.cancel()
    await settle()
    assert ended
    assert "a" not in runs
    for task in (background, visitor):
        with pytest.raises(asyncio.CancelledError):
            await task


FEW = ("paper-height", "default", "swell")


class Recording(FakeRenderer):
    """Knows the plans that it drew."""

    drawn: list[str]

    def __init__(self):
        super().__init__()
        self.drawn = []

    def render(self, plan, **how):
        self.drawn.append(plan.sha256)
        return super().render(plan, **how)


@pytest.fixture
def renderer(monkeypatch):
    # The process of the tests keeps its priority and its threads; planning all presets takes ten seconds.
    monkeypatch.setattr(os, "nice", lambda more: 0)
    monkeypatch.setattr(ahead, "preset_names", lambda: FEW)
    monkeypatch.setenv("LP_NUM_THREADS", "1")
    return Recording()


def test_every_preset_is_drawn_once_at_both_tiers_the_page_s_first_preset_first(renderer):
    ahead.draw_ahead(lambda: renderer, os.getppid())
    order = "default fast, default standard, paper-height fast, swell fast, paper-height standard, swell standard"
    pairs = [pair.split() for pair in order.split(", ")]
    assert renderer.drawn == [make_plan(load_preset(name).scene, TIERS[tier]).sha256 for name, tier in pairs]


def test_nothing_is_drawn_for_a_server_that_has_ended(renderer):
    ahead.draw_ahead(lambda: renderer, -1)
    assert renderer.drawn == []


def compiling() -> list[multiprocessing.process.BaseProcess]:
    return [child for child in multiprocessing.active_children() if child.name == "compile ahead"]


def test_the_process_ends_with_its_server(monkeypatch):
    """Without the setting there is none: test_api_resources.py."""
    monkeypatch.delenv("MESA_SHADER_CACHE_DISABLE", raising=False)
    with serving(compile_ahead=True) as client:
        client.get("/api/frames/default.png?width=16&height=16")
        until = time.monotonic() + 30.0
        while not compiling() and time.monotonic() < until:
            time.sleep(0.05)
        (child,) = compiling()
    child.join(30.0)
    assert not child.is_alive()
