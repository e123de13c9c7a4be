"""Passes of a frame plan: what is drawn, how, and where it can be visible."""

from typing import Annotated, Literal

from pydantic import Field

from seafoam.framegraph.resources import TargetInput, TextureInput
from seafoam.framegraph.rules import PlanPart, Uniform


class Fullscreen(PlanPart):
    """A triangle that covers the target; without attributes, from gl_VertexID."""

    rule: Literal["fullscreen"] = "fullscreen"


class Grid(PlanPart):
    """rows × columns cells, two triangles each; attribute ``a_grid`` (vec2) covers [0, 1]², columns first."""

    rule: Literal["grid"] = "grid"
    rows: int = Field(ge=1)
    columns: int = Field(ge=1)


class Points(PlanPart):
    """``count`` points without attributes; gl_VertexID is the index, gl_PointSize the side in pixels."""

    rule: Literal["points"] = "points"
    count: int = Field(ge=1, le=1 << 20)


class Quads(PlanPart):
    """``count`` quadrilaterals of two triangles each, without attributes; gl_VertexID is 6 times the index and more."""

    rule: Literal["quads"] = "quads"
    count: int = Field(ge=1, le=1 << 20)


Mesh = Annotated[Fullscreen | Grid | Points | Quads, Field(discriminator="rule")]
Blend = Literal["none", "add", "over"]
"""Blending of a pass: replaces the target's content, adds to it, or blends over it with premultiplied alpha."""


class BoundingSphere(PlanPart):
    """A bounding sphere of everything that a pass draws, at any time: ``centre`` (x, y, z) and ``radius``, m."""

    centre: tuple[float, float, float]
    radius: float


View = Literal["any", "rising", "falling"] | tuple[BoundingSphere, ...]
"""Where a pass can be visible: anywhere; where a ray of the picture rises, or falls, or for both where crests can be
above the camera; or in one of these bounding spheres."""
Eye = Literal["over", "between", "under"]
"""Height of the camera: over all crests, between the highest crest and the deepest trough, under all troughs."""
Eyes = Literal["any"] | tuple[Eye, ...]


class State(PlanPart):
    """Fixed-function state of a pass; everything else is disabled."""

    depth: bool = Field(default=False, description="Draw only before what is drawn already, and write the depth")
    equal: bool = False
    """With depth: draw only where the depth is the pass's own, not before it"""
    clear: bool = Field(default=False, description="Clear the target to (0, 0, 0, 0) and depth to 1 first")
    blend: Blend = "none"
    """Blending. none: replace the target's content; add: add to it; over: blend over it, with premultiplied alpha.
    Never used with 32-bit float targets, whose blending WebGL2 does not guarantee"""


class Pass(PlanPart):
    """One draw call."""

    name: str
    when: Literal["setup", "frame"]
    """When the pass is drawn. setup: neither time, camera nor picture size affects the pass or what it reads; it is
    drawn when its target is first needed, and again only if a live field among its uniforms, or those of what it reads,
    changes. frame: in every frame that needs its target. All passes into one target have the same value"""
    eye: Eyes = "any"
    """Camera heights for which the pass is drawn. over: at the plan's top or higher; under: below its trough; between:
    neither. Passes for two of them draw nothing from the other side of the water"""
    view: View = "any"
    """Where the pass can be visible, for culling. rising, falling: only if some ray of the picture rises or falls, or
    the camera is below the plan's top; spheres: only if one of these bounding spheres is in the picture"""
    program: str
    target: str = Field(description="Name of a target of the plan, or 'screen': the RGBA8 picture itself")
    mesh: Mesh
    inputs: dict[str, TextureInput | TargetInput] = Field(default_factory=dict)
    """Sampler name -> source of its data"""
    uniforms: dict[str, Uniform] = Field(default_factory=dict)
    """Uniforms of this pass only; they override the plan's"""
    state: State = State()
