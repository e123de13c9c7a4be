"""Uniform rules: the only arithmetic that both executors carry."""

from collections.abc import Iterable
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
