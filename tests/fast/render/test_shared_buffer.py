"""Pixels on their way from a worker: in shared memory, or in the answer where that is not possible."""

import asyncio
import os

import numpy as np
import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.encode import encode
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.shared_buffer import KEPT_BYTES, LEAST_BYTES, BufferPool, SharedBuffer, SharedPixels, send
from seafoam.scene.models import Scene
from support.api_fakes import FakeRenderer

SIDE = 512


def noise(seed: int, type: type = np.uint16) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (SIDE, SIDE, 4)).astype(type)


@pytest.mark.parametrize("type", [np.uint8, np.uint16, np.float32])
def test_pixels_arrive_and_stay_after_the_buffer_is_closed(type: type) -> None:
    buffer = SharedBuffer(noise(1, type).nbytes)
    sent = send(noise(1, type), buffer.address)
    assert isinstance(sent, SharedPixels)
    pixels = buffer.received(sent)
    buffer.close()
    np.testing.assert_array_equal(pixels, noise(1, type))


def test_small_pixels_and_those_that_do_not_fit_go_with_the_answer() -> None:
    assert SharedBuffer(LEAST_BYTES - 1).address is None
    buffer = SharedBuffer(LEAST_BYTES)
    for address in (None, buffer.address):
        assert send(noise(2), address) is not None
        assert not isinstance(send(noise(2), address), SharedPixels)
    pixels = noise(2)
    assert buffer.received(pixels) is pixels
    buffer.close()


def test_a_buffer_that_the_parent_has_closed_is_not_written_to() -> None:
    first = SharedBuffer(noise(3).nbytes)
    address = first.address
    first.close()
    np.testing.assert_array_equal(send(noise(3), address), noise(3))
    # Its file's number is another buffer's now.
    second = SharedBuffer(noise(3).nbytes)
    assert second.address.serial != address.serial
    second.close()


def test_buffers_are_used_again_within_bounds() -> None:
    buffers = BufferPool(2)
    taken = [buffers.take(1 << 20) for _ in range(3)]
    open_before = len(os.listdir("/proc/self/fd"))
    for buffer in taken:
        buffers.give_back(buffer)
    assert len(os.listdir("/proc/self/fd")) < open_before
    assert buffers.take(1 << 19) in taken
    assert buffers.take(1 << 14) not in taken  # far too large for it
    large = buffers.take(KEPT_BYTES + 1)
    buffers.give_back(large)
    assert large.address is None
    buffers.close()


@pytest.mark.anyio
async def test_frames_of_a_pool_are_what_its_renderer_drew() -> None:
    """Several at once and in turn, in one size, so that buffers are used again."""
    scene = Scene()
    pool = RenderPool(workers=1, queue=16, deadline=60.0, factory=FakeRenderer)
    await pool.start()
    try:
        jobs = [FrameJob(scene, TIERS["fast"], time, scene.camera, SIDE, SIDE, "npy") for time in range(8)]
        drawn = [frame.content for frame in await asyncio.gather(*(pool.render(job) for job in jobs))]
    finally:
        await pool.stop()
    renderer, plan = FakeRenderer(), make_plan(scene, TIERS["fast"])
    asked = {"camera": scene.camera, "width": SIDE, "height": SIDE, "output": "linear"}
    assert drawn == [encode(renderer.render(plan, time=time, **asked).pixels, "npy") for time in range(8)]
    assert len(set(drawn)) == 8
