"""Passes of a frame plan: what is drawn, how, and where it can show something."""

from typing import Annotated, Literal

from pydantic import Field

from seafoam.framegraph.resources import TargetInput, TextureInput
from seafoam.framegraph.rules import PlanPart, Uniform


class Fullscreen(PlanPart):
    """One triangle that covers the target; attribute-free, from gl_VertexID."""

    rule: Literal["fullscreen"] = "fullscreen"


class Grid(PlanPart):
    """rows × columns cells, two triangles each; attribute ``a_grid`` (vec2) runs over [0, 1]², columns first."""

    rule: Literal["grid"] = "grid"
    rows: int = Field(ge=1)
    columns: int = Field(ge=1)


class Points(PlanPart):
    """``count`` points without attributes; gl_VertexID tells which, and gl_PointSize gives the side in pixels."""

    rule: Literal["points"] = "points"
    count: int = Field(ge=1, le=1 << 20)


Mesh = Annotated[Fullscreen | Grid | Points, Field(discriminator="rule")]


Blend = Literal["none", "add", "over"]
"""How a pass meets what its target holds: replaces it, adds to it, or lies over it with premultiplied alpha."""


class Ball(PlanPart):
    """All that a pass can show, at any time: nothing of it is further than ``radius`` from ``centre`` (x, y, z); m."""

    centre: tuple[float, float, float]
    radius: float


View = Literal["any", "rising", "falling"] | tuple[Ball, ...]
"""Where a pass can show something: anywhere; where a ray of the picture rises, or falls, or for both where crests may
cover the eye; or in one of these balls."""


Eye = Literal["any", "over", "under"]


class State(PlanPart):
    """Fixed-function state of a pass; everything else is off."""

    depth: bool = False
    clear: bool = Field(default=False, description="Clear the target to (0, 0, 0, 0) and depth to 1 first")
    blend: Blend = Field(
        default="none",
        description="none: replace what the target holds; add: add to it; over: lie over it, alpha premultiplied. "
        "Never into 32-bit floats, which WebGL2 need not blend",
    )


class Pass(PlanPart):
    """One draw call."""

    name: str
    when: Literal["setup", "frame"] = Field(
        description="setup: no rule of time, camera or picture size reaches the pass or what it reads: drawn when its "
        "target is first needed, and again only where a live field among its numbers, or among those of what it reads, "
        "moves; frame: in every frame that needs its target. All passes into one target are of one kind"
    )
    eye: Eye = Field(
        default="any",
        description="over: drawn for eyes at the plan's top or higher; under: for all lower ones, and right for any",
    )
    view: View = Field(
        default="any",
        description="Where it can show something. rising, falling: only where a ray of the picture does, or the eye is "
        "lower than the plan's top; balls: only where one of them is in the picture",
    )
    program: str
    target: str = Field(description="A target of the plan, or 'screen': the RGBA8 picture itself")
    mesh: Mesh
    inputs: dict[str, TextureInput | TargetInput] = Field(
        default_factory=dict, description="Sampler name -> what it reads"
    )
    uniforms: dict[str, Uniform] = Field(
        default_factory=dict, description="Uniforms of this pass alone; they win over the plan's"
    )
    state: State = State()
