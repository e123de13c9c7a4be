"""Uniform rules: the only arithmetic that both executors implement."""

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from seafoam.described import Described

FAR = 1e8
"""Limit of vectors to the camera, m: what is farther away is in no picture."""


class PlanPart(Described, extra="forbid", frozen=True, allow_inf_nan=False):
    """Base class of all parts of a frame plan."""


class Constant(PlanPart):
    """Constant numbers. ``field``: JSON pointer of the scene field that they are, if they are one.

    ``absent``: the numbers where a scene has no such field. The field is then in an element of a list, and the list can
    change without a new plan: nothing else in the plan depends on its elements or on their number.
    """

    rule: Literal["constant"] = "constant"
    value: tuple[float, ...]
    field: str | None = None
    absent: tuple[float, ...] | None = Field(default=None, exclude_if=lambda absent: absent is None)


class Phase(PlanPart):
    """offset + rate·t + k·origin, reduced to [−π, π] in float64; rad. origin: the camera's (x, z), m."""

    rule: Literal["phase"] = "phase"
    offset: float
    rate: float
    k: tuple[float, float]


class Wrap(PlanPart):
    """k·origin + rate·t + offset, modulo ``period``, in float64: [0, period). ``rate``: absent where it is 0."""

    rule: Literal["wrap"] = "wrap"
    k: tuple[float, float]
    offset: float = 0.0
    period: float = 1.0
    rate: float | None = Field(default=None, exclude_if=lambda rate: rate is None)


class Loop(PlanPart):
    """t + ``offset`` modulo ``period``, in float64: [0, period).

    ``step``: t is the last multiple of it, so that the number stays for as many seconds, and what is drawn by it, too.
    """

    rule: Literal["loop"] = "loop"
    period: float
    offset: float = 0.0
    step: float | None = Field(default=None, gt=0.0, exclude_if=lambda step: step is None)


class Term(PlanPart):
    """factor × the number of the scene at the JSON pointer ``field``."""

    field: str
    factor: float


class Clamp(PlanPart):
    """offset + rate·t + k·origin, clamped to [low, high], in float64: an age, or the vector from a point to the camera.

    Exact to the rounding of the sum: t − birth and camera − point keep all digits that float64 has. ``terms``: the
    offset is their sum, in this order, if the scene has all of their fields.
    """

    rule: Literal["clamp"] = "clamp"
    offset: float
    rate: float = 0.0
    k: tuple[float, float] = (0.0, 0.0)
    low: float
    high: float
    terms: tuple[Term, ...] | None = Field(default=None, exclude_if=lambda terms: terms is None)


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


Rule = Annotated[Constant | Phase | Wrap | Loop | Clamp | CameraRule | Viewport, Field(discriminator="rule")]
UniformType = Literal["float", "vec2", "vec3", "vec4", "mat4"]
COMPONENTS: dict[UniformType, int] = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "mat4": 16}


class Uniform(PlanPart):
    """A uniform or uniform array. The values of ``rules``, concatenated, fill type × count exactly."""

    type: UniformType
    count: int = Field(default=1, ge=1)
    rules: tuple[Rule, ...]

    @property
    def constant(self) -> bool:
        return all(isinstance(rule, Constant) for rule in self.rules)


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


def constants(kind: UniformType, values: Iterable[float | tuple[float, ...]]) -> Uniform:
    """Return an array uniform of constants, a value for each element."""
    rules = [Constant(value=value if isinstance(value, tuple) else (value,)) for value in values]
    return array(kind, rules, len(rules))


def to_camera(x: float, z: float) -> tuple[Clamp, Clamp]:
    """Return the vector from the point (x, z) to the camera, m; at most :data:`FAR` along each axis."""
    return Clamp(offset=-x, k=(1.0, 0.0), low=-FAR, high=FAR), Clamp(offset=-z, k=(0.0, 1.0), low=-FAR, high=FAR)


def in_tile(side: float, period: float = 1.0, offset: tuple[float, float] = (0.0, 0.0)) -> tuple[Wrap, Wrap]:
    """The camera's (x, z) plus ``offset`` (m) in sides of a tile of ``side`` m, modulo ``period``."""
    x, z = (significant(part / side) for part in offset)
    return Wrap(k=(1.0 / side, 0.0), offset=x, period=period), Wrap(k=(0.0, 1.0 / side), offset=z, period=period)


def afloat(uniform: Uniform, velocity: tuple[float, float]) -> Uniform:
    """Return a uniform whose places move with ``velocity``, (x, z) m/s: each as seen from camera − velocity·t.

    Phases get the Doppler shift of a current: ω + k·U for a wave of wavevector k.
    """
    return uniform.model_copy(update={"rules": tuple(_afloat(rule, velocity) for rule in uniform.rules)})


def _afloat(rule: Rule, velocity: tuple[float, float]) -> Rule:
    if not isinstance(rule, Phase | Wrap | Clamp):
        return rule
    past = rule.k[0] * velocity[0] + rule.k[1] * velocity[1]
    return rule.model_copy(update={"rate": (rule.rate or 0.0) - past})


def rounded(values: Iterable[float]) -> tuple[float, ...]:
    """Apply :func:`significant` to each value."""
    return tuple(map(significant, values))


def significant(value: float) -> float:
    """Round ``value`` to 8 significant digits, as float32 has: hides last bits that differ between processors."""
    return float(f"{value:.8g}")
