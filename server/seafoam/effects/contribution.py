"""What an effect gives to a frame plan: slot files, compile-time numbers, textures, targets, passes, uniform rules.

Effects describe; the planner assembles. The uniform rules here are the only arithmetic that both executors carry.
"""

from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field


class PlanPart(BaseModel):
    """Base of everything that a frame plan is made of."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Constant(PlanPart):
    """Numbers as they stand. ``field``: the JSON pointer of the scene field they are, if they are one."""

    rule: Literal["constant"] = "constant"
    value: tuple[float, ...]
    field: str | None = None


class Phase(PlanPart):
    """offset + rate·t + k·origin, reduced to [−π, π] in float64; rad. origin: the eye's (x, z), m."""

    rule: Literal["phase"] = "phase"
    offset: float
    rate: float
    k: tuple[float, float]


class Wrap(PlanPart):
    """k·origin + offset, modulo ``period``, in float64: [0, period)."""

    rule: Literal["wrap"] = "wrap"
    k: tuple[float, float]
    offset: float = 0.0
    period: float = 1.0


class Loop(PlanPart):
    """t modulo ``period``, in float64: [0, period)."""

    rule: Literal["loop"] = "loop"
    period: float


class CameraRule(PlanPart):
    """The camera, seen from the eye's own (x, z): position enters as height alone.

    view_projection: mat4, column-major; ``top`` (m) is the highest point of the surface and sets the near plane.
    eye_height: float. ray_x, ray_y, ray_z: vec3 with ray = ray_z + X·ray_x + Y·ray_y for X, Y in clip space [−1, 1].
    """

    rule: Literal["camera"] = "camera"
    what: Literal["view_projection", "eye_height", "ray_x", "ray_y", "ray_z"]
    top: float = 0.0


class Viewport(PlanPart):
    """Width and height of the pass's target, pixels."""

    rule: Literal["viewport"] = "viewport"


class PassIndex(PlanPart):
    """Position of the pass in the plan, from 0."""

    rule: Literal["pass_index"] = "pass_index"


Rule = Annotated[Constant | Phase | Wrap | Loop | CameraRule | Viewport | PassIndex, Field(discriminator="rule")]

UniformType = Literal["float", "vec2", "vec3", "vec4", "mat4"]

COMPONENTS: dict[UniformType, int] = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "mat4": 16}


class Uniform(PlanPart):
    """One uniform or uniform array. The values of ``rules``, one after the other, fill type × count exactly."""

    type: UniformType
    count: int = Field(default=1, ge=1)
    rules: tuple[Rule, ...]


class TextureInput(PlanPart):
    """A sampler reads a texture of the plan."""

    texture: str


class TargetInput(PlanPart):
    """A sampler reads what an earlier pass drew into a target of the plan."""

    target: str


class ViewportSize(PlanPart):
    """As large as the picture, times ``scale`` along each side."""

    rule: Literal["viewport"] = "viewport"
    scale: int = Field(default=1, ge=1)


class FixedSize(PlanPart):
    """A size in pixels."""

    rule: Literal["fixed"] = "fixed"
    width: int
    height: int


TargetFormat = Literal["RGBA16F", "RGBA32F", "RGBA8"]
Filter = Literal["nearest", "linear", "linear_mipmap_linear"]
WrapMode = Literal["repeat", "clamp_to_edge"]


class Target(PlanPart):
    """A picture that passes draw into and later passes read."""

    size: Annotated[ViewportSize | FixedSize, Field(discriminator="rule")]
    format: TargetFormat
    depth: bool = False
    filter: Filter = "nearest"
    wrap: WrapMode = "clamp_to_edge"


class Fullscreen(PlanPart):
    """One triangle that covers the target; attribute-free, from gl_VertexID."""

    rule: Literal["fullscreen"] = "fullscreen"


class Grid(PlanPart):
    """rows × columns cells, two triangles each; attribute ``a_grid`` (vec2) runs over [0, 1]², columns first."""

    rule: Literal["grid"] = "grid"
    rows: int = Field(ge=1)
    columns: int = Field(ge=1)


Mesh = Annotated[Fullscreen | Grid, Field(discriminator="rule")]


@dataclass(frozen=True)
class SlotFile:
    """A GLSL file that fills a slot. ``prefix`` names its functions where several files share a slot."""

    slot: str
    path: str
    prefix: str = ""


@dataclass(frozen=True)
class PassSpec:
    """A pass that an effect adds before the surface is drawn: its own program from ``vertex`` and ``fragment`` files."""

    name: str
    vertex: tuple[str, ...]
    fragment: tuple[str, ...]
    target: str
    mesh: Fullscreen | Grid
    consts: dict[str, int | float | bool] = field(default_factory=dict)
    inputs: dict[str, TextureInput | TargetInput] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)


@dataclass(frozen=True)
class Contribution:
    """All that one effect adds to a plan, and why it runs."""

    why: str
    slots: tuple[SlotFile, ...] = ()
    consts: dict[str, int | float | bool] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    inputs: dict[str, TextureInput | TargetInput] = field(default_factory=dict)
    textures: dict[str, str] = field(default_factory=dict)
    """Sampler-independent name of a texture -> its name in the texture store."""
    targets: dict[str, Target] = field(default_factory=dict)
    passes: tuple[PassSpec, ...] = ()


@dataclass(frozen=True)
class Skipped:
    """An effect that the scene names but that cannot contribute, with the reason."""

    why: str
