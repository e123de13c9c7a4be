"""The atlas that a browser draws of a mask is the one that Python makes, to the last bit, on either renderer."""

import numpy as np
import pytest

from seafoam.effects.shader import Inline
from seafoam.framegraph.passes import Fullscreen, Pass
from seafoam.framegraph.resources import TargetInput, Texture, TextureInput
from seafoam.framegraph.shader import Program
from seafoam.planner import FramePlan, make_plan
from seafoam.planner.glsl import assemble
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.textures.masks import MaskTexture
from seafoam.textures.store import texture, url_of
from support.browser.lanes import Lane, opened, rendered
from support.pictures import draw
from support.probe import WHOLE
from support.scenes import Camera, Foam, HeightSaturation, Scene

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
    made = texture(MaskTexture(masks=(mask,), table="atlas"))
    vertex = WHOLE
    compare = Pass(
        name="compare",
        when="frame",
        program="compare",
        target="screen",
        mesh=Fullscreen(),
        inputs={"u_drawn": TargetInput(target="mask_atlas"), "u_made": TextureInput(texture="made")},
    )
    given = Texture(
        url=url_of(MaskTexture(masks=(mask,), table="atlas")),
        sha256=made.sha256,
        format="RG32UI",
        width=made.width,
        height=made.height,
        levels=1,
        filter="nearest",
        wrap="repeat",
    )
    return plan.model_copy(
        update={
            "passes": (*(one for one in plan.passes if one.when == "setup"), compare),
            "programs": {**plan.programs, "compare": Program(vertex=vertex, fragment=assemble([COMPARE], {}))},
            "textures": {**plan.textures, "made": given},
        }
    )


@pytest.mark.parametrize("mask", ["vac-24", "clump"])
@pytest.mark.parametrize("lane", ["llvmpipe", "swiftshader"])
def test_the_drawn_atlas_is_the_made_one(
    lane: str, mask: str, executor: Executor, server: str, request: pytest.FixtureRequest
) -> None:
    browser: Lane = request.getfixturevalue(lane)
    plan, camera = comparing(mask), Camera()
    made = texture(MaskTexture(masks=(mask,), table="atlas"))
    page = opened(browser, server)
    pixels = rendered(page, plan, time=0.0, size=(made.width, made.height), camera=camera)
    page.close()
    assert not pixels[..., 0].any()
    assert pixels[:, :512, 1].std() > 50.0
    here = draw(executor, plan, camera, time=0.0, size=(made.width, made.height))
    assert np.array_equal(pixels, here)
