"""The browser's frames against the server's: same text, same pixels on the same Mesa; a stated tolerance elsewhere."""

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page

from seafoam.framegraph.visibility import applies_to, eye_of
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.render.gl.executor import Executor
from support.browser.lanes import rendered
from support.exact import UNFILTERED
from support.pictures import draw
from support.report import REPORT
from support.scenes import load_preset, preset_names
from support.sweep import crossed, spread

TIMES = (0.0, 2.7, 1e9)
ELSEWHERE = TIMES[1:]
"""On the other renderer, which takes as long for a frame as all else together."""
SIZE = (160, 90)
HARD = {"mean": 3.0, "share_over_2": 0.06}
SOFT = {"mean": 0.6, "share_over_2": 0.025}
"""What SwiftShader may differ by: mean difference in levels, and share of pixels that differ by more than 2 levels.

Its sine is good to 2e-4 only (WebGL asks no more), so phases shift by that much. Filtered and textured foam move by
less than a level; a hard threshold flips the pixels whose saturation lies that close to the mask, and glitter, which
magnifies slopes a hundredfold, changes level here and there: 1.9 % of the pixels of swell, half of which glitters."""
WOUND = {"mean": 0.6, "share_over_2": 0.04}
"""Of drifting foam: vortices draw it out into threads a pixel wide, which SwiftShader's sine moves by its 2e-4."""
FOCUSED = {"mean": 0.6, "share_over_2": 0.045}
"""Of caustics: SwiftShader places corners to 1/16 of a texel, and where light is focused triangles are as thin.
Shallows, whose floor fills the picture, has most: 3.5 %."""

WATERLINE = {"any": 2e-3, "over_1": 5e-4}
"""Shares of pixels that may differ on the same renderer, and by more than a level: where a hull or its mirror image,
broken by ripples, cuts the water, the last bit of a ray decides which it meets, and ANGLE hands the driver another
order of the same sums. Shallows has most: 0.09 and 0.02 %."""


def apart(page: Page, executor: Executor, preset: str, time: float) -> NDArray[np.int64]:
    """By how many levels each pixel of the page's frame of a preset differs from the server's; it is no blank one."""
    pixels = rendered(page, preset, time=time, size=SIZE, quality="standard")
    assert pixels[..., :3].std() > 5.0, "a blank picture"
    scene = load_preset(preset).scene
    want = draw(executor, make_plan(scene, TIERS["standard"]), scene.camera, time=time, size=SIZE)
    return np.abs(pixels.astype(int) - want.astype(int)).max(axis=-1)


@pytest.mark.parametrize(("preset", "time"), crossed(preset_names(), TIMES, len(TIMES), 3, 2))
def test_same_pixels_on_the_same_renderer(page: Page, executor: Executor, preset: str, time: float) -> None:
    difference = apart(page, executor, preset, time)
    equal = float((difference == 0).mean())
    REPORT.add(
        "Browser against server, both llvmpipe, 160 × 90",
        preset=preset,
        time=f"{time:g} s",
        equal=f"{100 * equal:.4f} %",
        worst=str(difference.max()),
    )
    allowed = WATERLINE if load_preset(preset).scene.boats else {"any": 1e-4, "over_1": 0.0}
    assert 1.0 - equal <= allowed["any"]
    assert float((difference > 1).mean()) <= allowed["over_1"]


STANDARD = TIERS["standard"]
WAYS = (
    ("default", "fast", TIERS["fast"]),
    ("spray-on-rocks", "more samples", STANDARD.model_copy(update={"samples_max": 16})),
    ("paper-halftone", "reference", TIERS["reference"]),
    ("default", "more samples", STANDARD.model_copy(update={"samples_max": 16})),
    ("default", "high", TIERS["high"]),
    ("default", "reference", TIERS["reference"]),
    ("default", "mesh", STANDARD.model_copy(update={"surface": SurfaceQuality(method="mesh", cells=112, refine=2)})),
    ("paper-halftone", "fast", TIERS["fast"]),
    ("paper-halftone", "high", TIERS["high"]),
    ("paper-halftone", "exact", UNFILTERED),
    ("default", "exact", UNFILTERED),
)
"""Presets and qualities: the other tiers, and ways to draw that no tier has."""


@pytest.mark.parametrize("way", spread(WAYS, 3, name=lambda way: f"{way[0]}, {way[1]}"))
def test_same_pixels_by_every_way(page: Page, executor: Executor, way: tuple[str, str, Quality]) -> None:
    preset, _, quality = way
    scene = load_preset(preset).scene
    plan = make_plan(scene, quality)
    pixels = rendered(page, plan, time=2.7, size=SIZE, camera=scene.camera)
    assert pixels[..., :3].std() > 5.0, "a blank picture"
    difference = np.abs(pixels.astype(int) - draw(executor, plan, scene.camera, time=2.7, size=SIZE).astype(int))
    assert (difference == 0).all(axis=-1).mean() >= 0.9999
    assert quality not in TIERS.values() or difference.max() <= 1


@pytest.mark.parametrize("preset", spread(preset_names(), 15))
def test_the_driver_gets_the_text_of_the_plan(page: Page, preset: str) -> None:
    scene = load_preset(preset).scene
    plan = make_plan(scene, TIERS["fast"])
    asked = {"time": 0.0, "width": 16, "height": 9, "quality": "fast"}
    answer = page.evaluate("([name, asked]) => window.seafoam.render(name, asked)", [preset, asked])
    # What only cameras at other heights need is not compiled.
    needed = {one.program for one in plan.passes if applies_to(one, eye_of(plan, scene.camera))}
    programs = {name: plan.programs[name] for name in needed}
    assert answer["sources"] == {
        name: {"vertex": one.vertex.sha256, "fragment": one.fragment.sha256} for name, one in programs.items()
    }


@pytest.mark.parametrize(("preset", "time"), crossed(preset_names(), ELSEWHERE, len(ELSEWHERE), 10, 1))
def test_close_on_another_renderer(other: Page, executor: Executor, preset: str, time: float) -> None:
    difference = apart(other, executor, preset, time)
    mean, over = float(difference.mean()), float((difference > 2).mean())
    REPORT.add(
        "SwiftShader against server on llvmpipe, 160 × 90",
        preset=preset,
        time=f"{time:g} s",
        mean=f"{mean:.3f}",
        over_2=f"{100 * over:.2f} %",
        worst=str(difference.max()),
    )
    scene = load_preset(preset).scene
    foam = scene.foam
    allowed = SOFT if foam is None or foam.look in ("filtered", "textured") else HARD
    if scene.drift is not None:
        allowed = WOUND
    if scene.light is not None and scene.light.caustics is not None:
        allowed = FOCUSED
    assert mean <= allowed["mean"]
    assert over <= allowed["share_over_2"]
