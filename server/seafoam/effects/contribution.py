"""What an effect gives to a frame plan: slot files, compile-time numbers, textures, targets, passes, uniform rules.

Effects describe; the planner assembles. The uniform rules here are the only arithmetic that both executors carry.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Annotated, Final, Literal

from pydantic import BaseModel, ConfigDict, Field

from seafoam.quality import Quality
from seafoam.scene.models import Camera, Scene


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
    """t + ``offset`` modulo ``period``, in float64: [0, period)."""

    rule: Literal["loop"] = "loop"
    period: float
    offset: float = 0.0


class Held(PlanPart):
    """offset + rate·t + k·origin, held in [low, high], in float64: an age, or the way from a place to the eye.

    Exact to the rounding of the sum: t − birth and eye − place keep every digit that float64 has of them.
    """

    rule: Literal["held"] = "held"
    offset: float
    rate: float = 0.0
    k: tuple[float, float] = (0.0, 0.0)
    low: float
    high: float


class CameraRule(PlanPart):
    """The camera, seen from the eye's own (x, z): position enters as height alone.

    view_projection: mat4, column-major; ``top`` (m) is the highest point of the surface and sets the near plane.
    eye_height: float. ray_x, ray_y, ray_z: vec3 with ray = ray_z + X·ray_x + Y·ray_y for X, Y in clip space [−1, 1].
    """

    rule: Literal["camera"] = "camera"
    what: Literal["view_projection", "eye_height", "ray_x", "ray_y", "ray_z"]
    top: float = 0.0


class Viewport(PlanPart):
    """Width and height of the pass's target or of the picture, pixels, ``times`` over."""

    rule: Literal["viewport"] = "viewport"
    of: Literal["target", "picture"] = "target"
    times: int = Field(default=1, ge=1)


class PassIndex(PlanPart):
    """Position of the pass in the plan, from 0."""

    rule: Literal["pass_index"] = "pass_index"


Rule = Annotated[Constant | Phase | Wrap | Loop | Held | CameraRule | Viewport | PassIndex, Field(discriminator="rule")]

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
    """As large as the picture, times ``scale`` and over ``part`` along each side, over ``narrow`` more along the width,
    rounded up."""

    rule: Literal["viewport"] = "viewport"
    scale: int = Field(default=1, ge=1)
    part: int = Field(default=1, ge=1)
    narrow: int = Field(default=1, ge=1)


class FixedSize(PlanPart):
    """A size in pixels."""

    rule: Literal["fixed"] = "fixed"
    width: int
    height: int


TargetFormat = Literal["RGBA16F", "RGBA32F", "RGBA8", "RG32UI"]
"""RG32UI: whole numbers, which no pass clears or blends, nor tests for depth; read texel by texel."""
Filter = Literal["nearest", "linear", "linear_mipmap_linear"]
MIPMAPPED: Final = "linear_mipmap_linear"
"""A target with this filter has levels of means of 2 × 2 texels below it, made anew after each pass into it."""
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

BENEATH = "beneath"
"""The target of surface and sky where passes of stage ``after`` follow; those may read it."""
ABOVE = "above"
"""The target of passes of stage ``after``: premultiplied light, laid over :data:`BENEATH`; half floats, which blend."""


HALF_FLOAT = 2.0**-11
"""Relative rounding of a half float."""

UNBOUNDED = 1e9
"""Curvature of a surface that has kinks, 1/m: steps by its slope alone are longer than any that this allows."""

Const = int | float | bool | tuple[int, ...]
"""A compile-time constant; a tuple is an array."""


@dataclass(frozen=True)
class SlotFile:
    """A GLSL file that fills a slot. ``prefix`` names its functions where several files share a slot.

    ``needs``: helper files that go in before it, once however many ask for them.
    """

    slot: str
    path: str
    prefix: str = ""
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class PassSpec:
    """A pass that an effect adds; ``vertex`` and ``fragment`` list its files.

    It covers its whole target unless told otherwise. ``@waves`` among the files stands for that slot as the surface's
    shader has it, and brings what it reads; so do ``@find``, ``@sky`` and the others. ``stage``: before the surface is
    drawn, or after surface and sky into :data:`ABOVE`, which is cleared for the first of them.
    """

    name: str
    program: str
    fragment: tuple[str, ...]
    target: str
    vertex: tuple[str, ...] = ("vertex/fullscreen.glsl",)
    mesh: Fullscreen | Grid | Points = field(default_factory=Fullscreen)
    inputs: dict[str, TextureInput | TargetInput] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    stage: Literal["before", "after"] = "before"
    blend: Blend = "none"
    clear: bool = False
    view: View = "any"
    under: tuple[str, ...] = ()
    """Files of the fragment shader for eyes that crests may cover; none: the same as for others."""


@dataclass(frozen=True)
class Contribution:
    """All that one effect adds to a plan, and why it runs."""

    why: str
    slots: tuple[SlotFile, ...] = ()
    consts: dict[str, Const] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    inputs: dict[str, TextureInput | TargetInput] = field(default_factory=dict)
    textures: dict[str, "TextureUse"] = field(default_factory=dict)
    """Name in the plan -> what it holds and how it is sampled."""
    targets: dict[str, Target] = field(default_factory=dict)
    passes: tuple[PassSpec, ...] = ()
    bound: "Bound | None" = None
    """The most that the effect can change; ``None``: it shows."""
    top: float = 0.0
    """How far over still water the effect can raise the surface at most, m."""
    trough: float = 0.0
    """How low it can take it, m; at most 0."""
    steepest: float = 0.0
    """What the effect can add to the surface's slope at most."""
    curvature: float = 0.0
    """What the effect can add at most to the surface's second derivative along any direction, 1/m: how sharply its
    troughs turn up. :data:`UNBOUNDED` where nothing is known."""
    grain: float = 0.0
    """How far the drawn surface may stand over what its slope at a place and ``curvature`` say, m: what reading a map
    between its texels and its digits add."""
    bottom: float | None = None
    """Where the effect's ground lies at the deepest, m."""
    march: int = 1
    """How many times the march's steps it takes: its crests are steep, or fill their slab thinly."""


@dataclass(frozen=True)
class TextureUse:
    """A texture of the store, and how it is sampled."""

    source: str
    filter: Filter = "nearest"
    wrap: WrapMode = "repeat"


@dataclass(frozen=True)
class Bound:
    """The most by which an effect can change any pixel, from any camera, at any time.

    ``value``: exposed linear light, display white = 1, pictures clipped there. ``why``: what makes it so small.
    ``fields``: JSON pointers of the scene fields it hangs on that could otherwise change without a new plan; where the
    effect is left out, they cannot.
    """

    value: float
    why: str
    fields: tuple[str, ...] = ()


Cause = Literal["geometry", "filtering", "precision"]


@dataclass(frozen=True)
class Knob:
    """A single thing of the quality that trades time against error, declared by the effect that owns it.

    ``pointer``: JSON pointer into the Quality. ``steps``: values to measure, from cheap to exact. ``cause``: the kind
    of error it works on: where the surface is (geometry), what a pixel averages (filtering), digits (precision).
    """

    pointer: str
    title: str
    steps: tuple[bool | int | float | str, ...]
    cause: Cause


@dataclass(frozen=True)
class HardCase:
    """A scene, a time and a camera that provoke a failure, the guard against it, and what happened without it."""

    name: str
    scene: Scene
    guard: str
    without: str
    """What the frame or the function gave with the guard taken out, measured once: a number and its unit."""
    times: tuple[float, ...] = (0.0,)
    camera: Camera | None = None


@dataclass(frozen=True)
class Effect:
    """An effect: its name, and what it gives to the plan of a scene.

    ``contribute`` returns ``None`` where the scene does not call for the effect. ``invisible``: scenes that call for it
    and cannot show it; an effect that shows wherever it is called for says why in ``always_visible`` instead.
    """

    name: str
    contribute: Callable[[Scene, Quality], Contribution | None]
    invisible: tuple[Scene, ...] = ()
    always_visible: str = ""
    knobs: tuple[Knob, ...] = ()
    hard_cases: tuple[HardCase, ...] = ()


class PlanError(ValueError):
    """A scene that is well formed but cannot be planned.

    ``pointer``: JSON pointer of the field at fault; empty: the scene as a whole.
    """

    def __init__(self, pointer: str, message: str) -> None:
        super().__init__(f"{pointer}: {message}" if pointer else message)
        self.pointer = pointer
        self.message = message


def number(value: float, field_pointer: str | None = None) -> Uniform:
    """A float uniform of one constant."""
    return Uniform(type="float", rules=(Constant(value=(value,), field=field_pointer),))


def vector(value: tuple[float, ...], field_pointer: str | None = None) -> Uniform:
    """A vec2, vec3 or vec4 uniform of constants."""
    kinds: dict[int, UniformType] = {2: "vec2", 3: "vec3", 4: "vec4"}
    return Uniform(type=kinds[len(value)], rules=(Constant(value=value, field=field_pointer),))


def array(kind: UniformType, rules: Iterable[Rule], count: int) -> Uniform:
    """An array uniform of ``count`` elements."""
    return Uniform(type=kind, count=count, rules=tuple(rules))


def significant(value: float) -> float:
    """``value`` to 8 significant digits, all that float32 keeps: hides the last bits that processors disagree on."""
    return float(f"{value:.8g}")
