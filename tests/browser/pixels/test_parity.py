"""The browser's frames against the server's, of presets and of every effect's hard cases: same text, same pixels on the
same Mesa; a stated tolerance elsewhere."""

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page

from seafoam.effects import EFFECTS
from seafoam.effects.shader import Inline
from seafoam.framegraph.plan import FramePlan, Fullscreen, Pass, Program
from seafoam.framegraph.resources import TargetInput, Texture, TextureInput
from seafoam.framegraph.visibility import applies_to, eye_of
from seafoam.planner import make_plan
from seafoam.planner.glsl import assemble
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.render.gl.executor import Executor
from seafoam.textures.masks import MaskTexture
from seafoam.textures.store import texture, url_of
from support.browser.lanes import answered, rendered
from support.cases import HardCase, cases_of
from support.exact import UNFILTERED
from support.pictures import draw
from support.probe import WHOLE
from support.report import REPORT
from support.scenes import Camera, Foam, HeightSaturation, Scene, load_preset, preset_names
from support.sweep import crossed, rested, spread

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
STEEP = {"mean": 1.5, "share_over_2": 0.04}
"""Of soft looks in hard cases: 52 of 48 × 27 pixels, for steep crests and waves of 5 cm."""

WATERLINE = {"any": 2e-3, "over_1": 5e-4}
"""Shares of pixels that may differ on the same renderer, and by more than a level: where a hull or its mirror image,
broken by ripples, cuts the water, the last bit of a ray decides which it meets, and ANGLE hands the driver another
order of the same sums. Shallows has most: 0.09 and 0.02 %."""


STANDARD = TIERS["standard"]


def apart(pixels: NDArray[np.uint8], want: NDArray[np.uint8]) -> NDArray[np.int64]:
    """By how many levels each pixel of the page's frame differs from the server's."""
    return np.abs(pixels.astype(int) - want.astype(int)).max(axis=-1)


@pytest.mark.parametrize(("preset", "time"), crossed(preset_names(), TIMES, len(TIMES), 5, 2))
def test_same_text_and_pixels_on_the_same_renderer(page: Page, executor: Executor, preset: str, time: float) -> None:
    scene = load_preset(preset).scene
    plan = make_plan(scene, STANDARD)
    pixels, sources = answered(page, preset, time=time, size=SIZE, quality="standard")
    assert pixels[..., :3].std() > 5.0, "a blank picture"
    # What only cameras at other heights need is not compiled.
    needed = {one.program for one in plan.passes if applies_to(one, eye_of(plan, scene.camera))}
    assert sources == {
        name: {"vertex": one.vertex.sha256, "fragment": one.fragment.sha256}
        for name, one in plan.programs.items()
        if name in needed
    }
    difference = apart(pixels, draw(executor, plan, scene.camera, time=time, size=SIZE))
    equal = float((difference == 0).mean())
    REPORT.add(
        "Browser against server, both llvmpipe, 160 × 90",
        preset=preset,
        time=f"{time:g} s",
        equal=f"{100 * equal:.4f} %",
        worst=str(difference.max()),
    )
    allowed = WATERLINE if scene.boats else {"any": 1e-4, "over_1": 0.0}
    assert 1.0 - equal <= allowed["any"]
    assert float((difference > 1).mean()) <= allowed["over_1"]


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
    difference = apart(pixels, draw(executor, plan, scene.camera, time=2.7, size=SIZE))
    assert (difference == 0).mean() >= 0.9999
    assert quality not in TIERS.values() or difference.max() <= 1


@pytest.mark.parametrize(("preset", "time"), crossed(preset_names(), ELSEWHERE, len(ELSEWHERE), 15, 4))
def test_close_on_another_renderer(other: Page, executor: Executor, preset: str, time: float) -> None:
    scene = load_preset(preset).scene
    pixels = rendered(other, preset, time=time, size=SIZE, quality="standard")
    assert pixels[..., :3].std() > 5.0, "a blank picture"
    difference = apart(pixels, draw(executor, make_plan(scene, STANDARD), scene.camera, time=time, size=SIZE))
    mean, over = float(difference.mean()), float((difference > 2).mean())
    REPORT.add(
        "SwiftShader against server on llvmpipe, 160 × 90",
        preset=preset,
        time=f"{time:g} s",
        mean=f"{mean:.3f}",
        over_2=f"{100 * over:.2f} %",
        worst=str(difference.max()),
    )
    allowed = SOFT if is_soft(scene) else HARD
    if scene.drift is not None:
        allowed = WOUND
    if scene.light is not None and scene.light.caustics is not None:
        allowed = FOCUSED
    assert mean <= allowed["mean"]
    assert over <= allowed["share_over_2"]


def is_soft(scene: Scene) -> bool:
    """Whether its foam is filtered or textured, or none."""
    return scene.foam is None or scene.foam.look in ("filtered", "textured")


CASES = [pytest.param(case, id=f"{effect.name}: {case.name}") for effect in EFFECTS for case in cases_of(effect).hard]
FIRST = [pytest.param(cases_of(effect).hard[0], id=effect.name) for effect in EFFECTS if cases_of(effect).hard]
TINY = (48, 27)


def both(
    page: Page, executor: Executor, scene: Scene, camera: Camera, time: float = 2.7, size: tuple[int, int] = TINY
) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """The page's frame and the server's."""
    plan = make_plan(scene, STANDARD)
    got = rendered(page, plan, time=time, size=size, camera=camera)
    return got, draw(executor, plan, camera, time=time, size=size)


def same(pixels: NDArray[np.uint8], want: NDArray[np.uint8]) -> bool:
    difference = apart(pixels, want)
    return bool((difference == 0).mean() >= 0.999 and difference.max() <= 1)


@pytest.mark.parametrize("case", FIRST)
def test_hard_cases_are_the_same_on_the_same_renderer(page: Page, executor: Executor, case: HardCase) -> None:
    """One case of each effect: so is every preset, and every rule of a uniform by numbers."""
    assert all(same(*both(page, executor, case.scene, case.camera, time)) for time in case.times)


@pytest.mark.parametrize("size", [(1, 1), (1, 4096), (4096, 1), (47, 27)], ids=str)
def test_sizes(page: Page, executor: Executor, size: tuple[int, int]) -> None:
    scene = load_preset("paper-halftone").scene
    assert same(*both(page, executor, scene, scene.camera, size=size))


@pytest.mark.parametrize("case", rested(CASES, 52))
def test_hard_cases_are_sound_on_another_renderer(other: Page, executor: Executor, case: HardCase) -> None:
    allowed = STEEP if is_soft(case.scene) else HARD
    for time in case.times:
        got, want = both(other, executor, case.scene, case.camera, time)
        difference = apart(got, want)
        mean, over = float(difference.mean()), float((difference > 2).mean())
        REPORT.add(
            "Hard cases on SwiftShader against the server on llvmpipe, 48 × 27",
            case=case.name,
            time=f"{time:.10g} s",
            mean=f"{mean:.3f}",
            over_2=f"{100 * over:.2f} %",
        )
        # Blank only where the server's picture is: a black night, a white sun.
        assert got[..., :3].std() >= 0.3 * want[..., :3].std()
        # A NaN is black: no more of it than there.
        black = [(picture[..., :3] == 0).all(axis=-1).mean() for picture in (got, want)]
        assert black[0] <= black[1] + 0.01
        assert mean <= allowed["mean"]
        assert over <= allowed["share_over_2"]


COMPARE = Inline("""uniform usampler2D u_drawn;
uniform usampler2D u_made;
out vec4 o_color;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uvec2 drawn = texelFetch(u_drawn, at, 0).rg;
    bool same = drawn == texelFetch(u_made, at, 0).rg;
    o_color = vec4(same ? 0.0 : 1.0, float(drawn.x & 255u) / 255.0, float(drawn.y & 255u) / 255.0, 1.0);
}
""")


def comparing(mask: str) -> FramePlan:
    """A plan whose picture is red where the drawn atlas is not the one of the server's resource."""
    foam = Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="filtered", mask=mask)
    plan = make_plan(Scene(foam=foam, light=None), TIERS["standard"])
    spec = MaskTexture(masks=(mask,), table="atlas")
    made = texture(spec)
    read = {"u_drawn": TargetInput(target="mask_atlas"), "u_made": TextureInput(texture="made")}
    how = {"when": "frame", "program": "compare", "target": "screen", "mesh": Fullscreen()}
    size = {"width": made.width, "height": made.height, "levels": 1}
    resource = {"url": url_of(spec), "sha256": made.sha256, "format": made.format, **size}
    parts = {
        "passes": (*(one for one in plan.passes if one.when == "setup"), Pass(name="compare", inputs=read, **how)),
        "programs": {**plan.programs, "compare": Program(vertex=WHOLE, fragment=assemble([COMPARE], {}))},
        "textures": {**plan.textures, "made": Texture(**resource, filter="nearest", wrap="repeat")},
    }
    return plan.model_copy(update=parts)


def test_the_drawn_atlas_is_the_made_one(executor: Executor, other: Page) -> None:
    """On the other renderer: the server's own draws those of all masks, and Chromium on it presets that have one."""
    plan, camera = comparing("clump"), Camera()
    size = (plan.textures["made"].width, plan.textures["made"].height)
    pixels = rendered(other, plan, time=0.0, size=size, camera=camera)
    assert not pixels[..., 0].any()
    assert pixels[:, :512, 1].std() > 50.0
    assert np.array_equal(pixels, draw(executor, plan, camera, time=0.0, size=size))
