"""The atlas that passes make of a mask is the one that Python makes, to the last bit."""

import numpy as np
import pytest

from seafoam.masks.catalogue import load_catalogue
from seafoam.masks.families import SIZES
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.textures.masks import MaskTexture
from seafoam.textures.store import texture
from support.pictures import draw
from support.scenes import Camera, Foam, HeightSaturation, Scene

CUSTOM = [f"blur:1:{size}:3" for size in SIZES if size < 512]


def scene(mask: str) -> Scene:
    return Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="filtered", mask=mask), light=None)


@pytest.mark.parametrize("mask", [*load_catalogue(), *CUSTOM])
def test_the_drawn_atlas_is_the_made_one(mask: str, executor: Executor) -> None:
    plan = make_plan(scene(mask), TIERS["standard"])
    draw(executor, plan, Camera(pitch=-1.0), time=0.0, size=(16, 9))
    framebuffer, *_ = executor._static.get(plan.kept["mask_atlas"], lambda: pytest.fail("not kept")).target
    made = texture(MaskTexture(masks=(mask,), table="atlas"))
    drawn = np.frombuffer(framebuffer.read(components=2, dtype="u4", alignment=1), np.uint32)
    assert (framebuffer.width, framebuffer.height) == (made.width, made.height)
    assert np.array_equal(drawn, np.frombuffer(made.data, np.uint32))
