"""Who is served first, and who shares a run: visitors before streams and background, and identical calls once."""

import asyncio
from collections.abc import Callable

import pytest

from seafoam.render.service.sharing import Sharing
from seafoam.render.service.slots import STREAMED, Slots, Turn


async def settle() -> None:
    for _ in range(5):
        await asyncio.sleep(0)


def test_visitors_go_before_the_background_in_order_of_arrival() -> None:
    async def run() -> None:
        slots, served = Slots(1), []
        await slots.acquire()
        turns = {"b1": Turn(True), "b2": Turn(True), "v1": Turn(), "b3": Turn(True), "v2": Turn()}

        async def wait(name: str) -> None:
            await slots.acquire(turns[name])
            served.append(name)

        tasks = [asyncio.ensure_future(wait(name)) for name in turns]
        await settle()
        turns["b3"].background = False  # a visitor asks for the same
        for _ in turns:
            slots.release()
            await settle()
        assert served == ["v1", "b3", "v2", "b1", "b2"]
        assert slots.locked()
        slots.release()
        assert not slots.locked()
        await asyncio.gather(*tasks)

    asyncio.run(run())


def served(turns: dict[str, Turn], new: Callable[[str], tuple[str, Turn] | None] = lambda name: None) -> list[str]:
    """In which order one worker serves callers. new: who comes when a caller has been served."""

    async def run() -> list[str]:
        slots, order = Slots(1), []
        await slots.acquire()
        tasks = []

        async def wait(name: str, turn: Turn) -> None:
            await slots.acquire(turn)
            order.append(name)
            if (come := new(name)) is not None:
                tasks.append(asyncio.ensure_future(wait(*come)))

        tasks += [asyncio.ensure_future(wait(name, turn)) for name, turn in turns.items()]
        await settle()
        while len(order) < len(tasks):
            slots.release()
            await settle()
        await asyncio.gather(*tasks)
        return order

    return asyncio.run(run())


def test_frames_of_streams_go_between_visitors_and_the_background() -> None:
    turns = {"b1": Turn(True), "s1": Turn(stream=True), "v1": Turn(), "s2": Turn(stream=True), "v2": Turn()}
    assert served(turns) == ["v1", "v2", "s1", "s2", "b1"]


def test_the_background_is_served_while_streams_always_wait() -> None:
    """Two streams ask for the next frame whenever one has come."""
    left = iter(range(5 * STREAMED))

    def again(name: str) -> tuple[str, Turn] | None:
        return (name, Turn(stream=True)) if name == "stream" and next(left, None) is not None else None

    turns = {f"b{number}": Turn(True) for number in range(2)}
    turns |= {"stream": Turn(stream=True), "v": Turn()}
    order = served(turns, again)
    assert order[0] == "v"
    assert [place for place, name in enumerate(order) if name.startswith("b")] == [STREAMED + 1, 2 * STREAMED + 2]


def test_no_worker_is_lost_with_a_caller_that_gives_up() -> None:
    async def run() -> None:
        slots = Slots(1)
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

    asyncio.run(run())


def test_identical_calls_share_a_run_and_its_failure() -> None:
    async def run() -> None:
        sharing: Sharing[int] = Sharing()
        starts = []

        async def work(turn: Turn) -> int:
            starts.append(turn)
            await asyncio.sleep(0.01)
            if len(starts) == 2:
                raise KeyError("lost")
            return len(starts)

        async def three(background: bool) -> list[int | BaseException]:
            calls = (sharing.run("a", work, background=background) for _ in range(3))
            return await asyncio.gather(*calls, return_exceptions=True)

        assert await three(False) == [1, 1, 1]
        assert [type(error) for error in await three(True)] == [KeyError] * 3
        assert await three(True) == [3, 3, 3]
        assert [turn.background for turn in starts] == [False, True, True]

    asyncio.run(run())


def test_a_run_ends_with_its_last_caller_and_goes_to_the_front_with_its_first_visitor() -> None:
    async def run() -> None:
        sharing: Sharing[int] = Sharing()
        turns: list[Turn] = []
        ended: list[bool] = []

        async def work(turn: Turn) -> int:
            turns.append(turn)
            try:
                await asyncio.sleep(60)
            finally:
                ended.append(True)
            return 0

        background = asyncio.ensure_future(sharing.run("a", work, background=True))
        await settle()
        visitor = asyncio.ensure_future(sharing.run("a", work, background=False))
        await settle()
        assert len(turns) == 1
        assert not turns[0].background
        background.cancel()
        await settle()
        assert not ended
        visitor.cancel()
        await settle()
        assert ended
        assert not sharing.in_flight("a")
        for task in (background, visitor):
            with pytest.raises(asyncio.CancelledError):
                await task

    asyncio.run(run())
