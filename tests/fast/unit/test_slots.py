"""Who is served first, and who shares a run: visitors before the background, and identical calls once."""

import asyncio

import pytest

from seafoam.render.service.sharing import Sharing
from seafoam.render.service.slots import Slots, Turn


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
