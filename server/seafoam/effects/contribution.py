"""The contribution of an effect to a frame plan: slot files, constants, textures, targets, passes and uniform rules.

Effects describe; the planner assembles. The uniform rules are the only arithmetic that both executors implement.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Annotated, Final, Literal

from pydantic import BaseModel, ConfigDict, Field

from seafoam.quality import Quality
from seafoam.scene.models import Camera, Scene


class PlanPart(BaseModel):
    """Base class of all parts of a frame plan."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Constant(PlanPart):
    """Constant numbers. ``field``: JSON pointer of the scene field that they are, if they are one."""

    rule: Literal["constant"] = "constant"
    value: tuple[float, ...]
    field: str | None = None


class Phase(PlanPart):
    """offset + rate·t + k·origin, reduced to [−π, π] in float64; rad. origin: the camera's (x, z), m."""

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
    """offset + rate·t + k·origin, clamped to [low, high], in float64: an age, or the vector from a point to the camera.

    Exact to the rounding of the sum: t − birth and camera − point keep all digits that float64 has.
    """

    rule: Literal["held"] = "held"
    offset: float
    rate: float = 0.0
    k: tuple[float, float] = (0.0, 0.0)
    low: float
    high: float


class CameraRule(PlanPart):
    """The camera, relative to its own (x, z): of the position, only the height enters.

    view_projection: mat4, column-major; ``top`` (m) is the highest point of the surface and sets the near plane.
    eye_height: float. ray_x, ray_y, ray_z: vec3 with ray = ray_z + X·ray_x + Y·ray_y for X, Y in clip space [−1, 1].
    """

    rule: Literal["camera"] = "camera"
    what: Literal["view_projection", "eye_height", "ray_x", "ray_y", "ray_z"]
    top: float = 0.0


class Viewport(PlanPart):
    """Width and height of the pass's target or of the picture, pixels, multiplied by ``times``."""

    rule: Literal["viewport"] = "viewport"
    of: Literal["target", "picture"] = "target"
    times: int = Field(default=1, ge=1)


class PassIndex(PlanPart):
    """Index of the pass in the plan, from 0."""

    rule: Literal["pass_index"] = "pass_index"


Rule = Annotated[Constant | Phase | Wrap | Loop | Held | CameraRule | Viewport | PassIndex, Field(discriminator="rule")]

UniformType = Literal["float", "vec2", "vec3", "vec4", "mat4"]

COMPONENTS: dict[UniformType, int] = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "mat4": 16}


class Uniform(PlanPart):
    """A uniform or uniform array. The values of ``rules``, concatenated, fill type × count exactly."""

    type: UniformType
    count: int = Field(default=1, ge=1)
    rules: tuple[Rule, ...]


class TextureInput(PlanPart):
    """A sampler that reads a texture of the plan."""

    texture: str


class TargetInput(PlanPart):
    """A sampler that reads a target of the plan, drawn by an earlier pass."""

    target: str


class ViewportSize(PlanPart):
    """The picture's size times ``scale``, divided by ``part`` along each side and by ``narrow`` also along the width,
    rounded up."""

    rule: Literal["viewport"] = "viewport"
    scale: int = Field(default=1, ge=1)
    part: int = Field(default=1, ge=1)
    narrow: int = Field(default=1, ge=1)


class FixedSize(PlanPart):
    """A fixed size in pixels."""

    rule: Literal["fixed"] = "fixed"
    width: int
    height: int


TargetFormat = Literal["RGBA16F", "RGBA32F", "RGBA8", "RG32UI"]
"""RG32UI: integers, which no pass clears, blends or depth-tests; sampled texel by texel."""
Filter = Literal["nearest", "linear", "linear_mipmap_linear"]
MIPMAPPED: Final = "linear_mipmap_linear"
"""A target with this filter has mip levels, means of 2 × 2 texels, generated after each pass into it."""
WrapMode = Literal["repeat", "clamp_to_edge"]


class Target(PlanPart):
    """A render target: passes draw into it, and later passes read it."""

    size: Annotated[ViewportSize | FixedSize, Field(discriminator="rule")]
    format: TargetFormat
    depth: bool = False
    filter: Filter = "nearest"
    wrap: WrapMode = "clamp_to_edge"


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


Mesh = Annotated[Fullscreen | Grid | Points, Field(discriminator="rule")]

Blend = Literal["none", "add", "over"]
"""Blending of a pass: replaces the target's content, adds to it, or blends over it with premultiplied alpha."""


class Ball(PlanPart):
    """A bounding sphere of everything that a pass draws, at any time: ``centre`` (x, y, z) and ``radius``, m."""

    centre: tuple[float, float, float]
    radius: float


View = Literal["any", "rising", "falling"] | tuple[Ball, ...]
"""Where a pass can be visible: anywhere; where a ray of the picture rises, or falls, or for both where crests can be
above the camera; or in one of these bounding spheres."""

BENEATH = "beneath"
"""The target of surface and sky if passes of stage ``after`` follow; those can read it."""
ABOVE = "above"
"""The target of passes of stage ``after``: premultiplied light, blended over :data:`BENEATH`; half floats."""


HALF_FLOAT = 2.0**-11
"""Relative rounding of a half float."""

UNBOUNDED = 1e9
"""Curvature of a surface with kinks, 1/m: steps by its slope are always longer than any that this allows."""

Const = int | float | bool | tuple[int, ...]
"""A compile-time constant; a tuple is an array."""


@dataclass(frozen=True)
class SlotFile:
    """A GLSL file that fills a slot. ``prefix`` names its functions where several files share a slot.

    ``needs``: helper files that precede it, included once.
    """

    slot: str
    path: str
    prefix: str = ""
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class PassSpec:
    """A pass that an effect adds; ``vertex`` and ``fragment`` list its files.

    It covers its whole target by default. ``@waves`` among the files stands for that slot as in the surface's shader,
    with its inputs; so do ``@find``, ``@sky`` and the others. ``stage``: before the surface is drawn, or after surface
    and sky into :data:`ABOVE`, which is cleared for the first of them.
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
    """Files of the fragment shader for cameras that can be below crests; empty: the same files."""


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
    """Upper bound of the effect's change to a pixel; ``None``: visible."""
    top: float = 0.0
    """Upper bound of the effect's share of the surface height, m."""
    steepest: float = 0.0
    """Upper bound of the effect's share of the surface slope."""
    curvature: float = 0.0
    """Upper bound of the effect's share of the surface's second derivative along any direction, 1/m: how sharply its
    troughs turn up. :data:`UNBOUNDED` if unknown."""
    grain: float = 0.0
    """Upper bound of the drawn surface's excess over what its slope at a place and ``curvature`` say, m, caused by the
    interpolation and the number format of a map."""
    bottom: float | None = None
    """Lowest height of the effect's ground, m."""
    march: int = 1
    """Factor on the number of ray-marching steps: steep crests, or crests that fill their slab thinly, need more."""


@dataclass(frozen=True)
class TextureUse:
    """A texture of the store, and its sampler state."""

    source: str
    filter: Filter = "nearest"
    wrap: WrapMode = "repeat"


@dataclass(frozen=True)
class Bound:
    """Upper bound of an effect's change to any pixel, from any camera, at any time.

    ``value``: exposed linear light, display white = 1, pictures clipped there. ``why``: the reason. ``fields``: JSON
    pointers of scene fields that the bound depends on and that could otherwise change without a new plan; if the
    effect is left out, they cannot.
    """

    value: float
    why: str
    fields: tuple[str, ...] = ()


Cause = Literal["geometry", "filtering", "precision"]


@dataclass(frozen=True)
class Knob:
    """A quality setting that trades time against error, declared by the effect that owns it.

    ``pointer``: JSON pointer into the Quality. ``steps``: values to measure, from cheap to exact. ``cause``: the kind
    of error that it affects: position of the surface (geometry), average over a pixel (filtering), number of digits
    (precision).
    """

    pointer: str
    title: str
    steps: tuple[bool | int | float | str, ...]
    cause: Cause


@dataclass(frozen=True)
class HardCase:
    """A scene, a time and a camera that provoke a failure, the guard against it, and the failure without it."""

    name: str
    scene: Scene
    guard: str
    without: str
    """Result of the frame or function without the guard, measured once: a number and its unit."""
    times: tuple[float, ...] = (0.0,)
    camera: Camera | None = None


@dataclass(frozen=True)
class Effect:
    """An effect: its name, and its contribution to the plan of a scene.

    ``contribute`` returns ``None`` if the scene does not use the effect. ``invisible``: scenes that use it and cannot
    show it; an effect that is always visible gives the reason in ``always_visible`` instead.
    """

    name: str
    contribute: Callable[[Scene, Quality], Contribution | None]
    invisible: tuple[Scene, ...] = ()
    always_visible: str = ""
    knobs: tuple[Knob, ...] = ()
    hard_cases: tuple[HardCase, ...] = ()


class PlanError(ValueError):
    """A valid scene that cannot be planned.

    ``pointer``: JSON pointer of the field at fault; empty: the scene as a whole.
    """

    def __init__(self, pointer: str, message: str) -> None:
        super().__init__(f"{pointer}: {message}" if pointer else message)
        self.pointer = pointer
        self.message = message


def number(value: float, field_pointer: str | None = None) -> Uniform:
    """Return a float uniform with one constant."""
    return Uniform(type="float", rules=(Constant(value=(value,), field=field_pointer),))


def vector(value: tuple[float, ...], field_pointer: str | None = None) -> Uniform:
    """Return a vec2, vec3 or vec4 uniform of constants."""
    kinds: dict[int, UniformType] = {2: "vec2", 3: "vec3", 4: "vec4"}
    return Uniform(type=kinds[len(value)], rules=(Constant(value=value, field=field_pointer),))


def array(kind: UniformType, rules: Iterable[Rule], count: int) -> Uniform:
    """Return an array uniform of ``count`` elements."""
    return Uniform(type=kind, count=count, rules=tuple(rules))


def significant(value: float) -> float:
    """Round ``value`` to 8 significant digits, as float32 has: hides last bits that differ between processors."""
    return float(f"{value:.8g}")
