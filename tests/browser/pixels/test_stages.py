"""Passes beside surface and sky, alike on the server and in Chromium: points, and the atlas of a mask."""

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from seafoam.effects import EFFECTS
from seafoam.effects.effect import ABOVE, Contribution, Effect, PassSpec
from seafoam.effects.shader import Inline
from seafoam.framegraph.plan import Blend, Fullscreen, Pass, Points, Program
from seafoam.framegraph.resources import TargetInput, Texture, TextureInput
from seafoam.planner import FramePlan, make_plan, planner
from seafoam.planner.glsl import assemble
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from seafoam.textures.masks import MaskTexture
from seafoam.textures.store import texture, url_of
from support.browser.lanes import rendered
from support.pictures import draw
from support.probe import WHOLE
from support.scenes import Camera, Foam, HeightSaturation, Light, Scene
from support.sweep import REST

SIZE = (32, 16)
FILES = Path(__file__).parents[2] / "support" / "stages"
SCENE = Scene(light=Light(), camera=Camera(pitch=1.5708))
"""Nothing but sky."""


def plan_of(blend: Blend, samples: int = 1) -> FramePlan:
    """The scene's plan with four points over it, three of them in one place."""

    def contribute(scene: Scene, quality: Quality) -> Contribution:
        spec = PassSpec(
            name="points",
            program="points",
            vertex=(str(FILES / "points.glsl"),),
            fragment=(str(FILES / "quarter.glsl"),),
            target=ABOVE,
            mesh=Points(count=4),
            stage="after",
            blend=blend,
        )
        return Contribution(why="a test", passes=(spec,))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(planner, "EFFECTS", (*EFFECTS, Effect("points", contribute)))
        quality = TIERS["standard"].model_copy(update={"samples": samples})
        return planner.make_plan.__wrapped__(SCENE, quality)


@pytest.mark.parametrize(("blend", "light", "free"), [("add", 0.75, 0.0), ("over", 0.4375, 0.125), ("none", 0.25, 0.5)])
@pytest.mark.parametrize("samples", [1, 4])
def test_points_lie_over_the_picture(
    page: Page, executor: Executor, blend: Blend, light: float, free: float, samples: int
) -> None:
    plan = plan_of(blend, samples)

    def seen(one: FramePlan) -> np.ndarray:
        # With one sample the sky is drawn narrow, and the points over what is made of it.
        output = "linear" if samples == 1 else "samples"
        return draw(executor, one, SCENE.camera, time=0.0, size=SIZE, output=output).astype(np.float64)

    bare = make_plan(SCENE, TIERS["standard"].model_copy(update={"samples": samples}))
    sky, drawn = seen(bare), seen(plan)
    middle = (drawn.shape[0] // 2, drawn.shape[1] // 2)
    left = (drawn.shape[0] // 2, drawn.shape[1] // 4)
    assert np.allclose(drawn[middle][:3], sky[middle][:3] * free + light, atol=2e-3)
    assert np.allclose(drawn[left][:3], sky[left][:3] * 0.5 + 0.25, atol=2e-3)
    changed = (np.abs(drawn - sky).max(axis=2) > 1e-6).sum()
    assert changed == 32, "two squares of 4 × 4"

    pixels = rendered(page, plan, time=0.0, size=SIZE, camera=SCENE.camera)
    here = draw(executor, plan, SCENE.camera, time=0.0, size=SIZE)
    assert np.abs(pixels.astype(int) - here.astype(int)).max() <= 1


def test_a_scene_without_such_passes_is_drawn_at_once() -> None:
    plan = make_plan(SCENE, TIERS["standard"])
    assert "compose" not in plan.programs
    assert set(plan.targets) == {"samples", "enlarged"}


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


@pytest.mark.parametrize("mask", [pytest.param("vac-24", marks=REST), "clump"])
def test_the_drawn_atlas_is_the_made_one(mask: str, executor: Executor, other: Page) -> None:
    """On the other renderer: the server's own draws those of all masks, and Chromium on it presets that have one."""
    plan, camera = comparing(mask), Camera()
    size = (plan.textures["made"].width, plan.textures["made"].height)
    pixels = rendered(other, plan, time=0.0, size=size, camera=camera)
    assert not pixels[..., 0].any()
    assert pixels[:, :512, 1].std() > 50.0
    assert np.array_equal(pixels, draw(executor, plan, camera, time=0.0, size=size))
