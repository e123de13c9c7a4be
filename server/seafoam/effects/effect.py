"""The contribution of an effect to a frame plan: slot files, constants, textures, targets, passes, bounds.

Effects describe; the planner assembles.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import wraps
from itertools import chain
from typing import Any, Literal, Self, TypeVar

from pydantic import BaseModel

from seafoam.effects.shader import Const, Piece, SlotFile, SlotRef
from seafoam.framegraph.plan import Blend, Fullscreen, Mesh, View
from seafoam.framegraph.resources import Filter, Target, WrapMode
from seafoam.framegraph.rules import Uniform
from seafoam.quality import Quality, QualityParameters
from seafoam.scene import Foam, Part, Scene
from seafoam.textures.spec import TextureSpec

BENEATH = "beneath"
"""The target of surface and sky if passes of stage ``after`` follow, which can read it."""
ABOVE = "above"
"""The target of passes of stage ``after``: half floats, premultiplied colour that is blended over :data:`BENEATH`."""
HALF_FLOAT = 2.0**-11
"""Relative rounding error of a half float."""
UNBOUNDED = 1e9
"""Curvature of a surface with kinks, 1/m: so large that ray marching uses the slope bound instead."""
T = TypeVar("T")


@dataclass(frozen=True)
class PassSpec:
    """A pass that an effect adds; ``vertex`` and ``fragment`` list the files of its shaders.

    ``read``: sampler -> the target or texture that it reads, where :attr:`Resources.inputs` does not tell. ``target``:
    by default that of the program's name. ``mesh``: what is drawn, by default the whole target. ``stage``: drawn before
    the surface, or after surface and sky into :data:`ABOVE`, which is cleared before the first of these passes, or
    after the linear frame is finished, for its display; the slot ``block mean`` reads it.
    """

    name: str
    program: str
    fragment: tuple[Piece | SlotRef, ...]
    read: Mapping[str, str] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    target: str = ""
    vertex: tuple[Piece | SlotRef, ...] = ("vertex/vertex.glsl@fullscreen",)
    mesh: Mesh = field(default_factory=Fullscreen)
    stage: Literal["before", "after", "finished"] = "before"
    blend: Blend = "none"
    clear: bool = False
    view: View = "any"
    under: tuple[Piece | SlotRef, ...] = ()
    """Files of the fragment shader for a camera under the water; empty: those of ``fragment`` for it too."""
    part: int = 1
    """Of a pass into :data:`ABOVE`: how many pixels may be as wide and as high as one of what it draws."""
    shines: bool = True
    """Of such a pass: whether it may draw what is thin and bright, so that glare asks for each of its pixels."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "target", self.target or self.program)


@dataclass(frozen=True)
class TextureUse:
    """A texture of the store (``source``: its name there), and its sampler state."""

    source: TextureSpec
    filter: Filter = "nearest"
    wrap: WrapMode = "repeat"


@dataclass(frozen=True, kw_only=True)
class Resources:
    """Shader files, numbers, textures, targets and passes that belong together: a map and the passes that draw it."""

    slots: tuple[SlotFile, ...] = ()
    consts: dict[str, Const] = field(default_factory=dict)
    chosen_consts: dict[str, Const] = field(default_factory=dict)
    """Constants that differ where a pixel chosen by adaptive sampling is drawn with more samples than the others."""
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    inputs: dict[str, str] = field(default_factory=dict)
    """Sampler -> the target or texture that it reads, if that is not the one of its name without ``u_``."""
    textures: dict[str, TextureUse] = field(default_factory=dict)
    """Name in the plan -> texture."""
    targets: dict[str, Target] = field(default_factory=dict)
    passes: tuple[PassSpec, ...] = ()

    def joined(self, *others: "Resources") -> Self:
        """Return this with all resources of ``others``, after its own.

        Raises :class:`AssemblyError` if two have a name with different values.
        """
        changes: dict[str, Any] = {}
        for name in (part.name for part in fields(Resources)):
            parts = [getattr(one, name) for one in (self, *others)]
            changes[name] = _united(*parts) if isinstance(parts[0], dict) else tuple(chain.from_iterable(parts))
        return replace(self, **changes)


def drawn_map(spec: PassSpec, target: Target) -> Resources:
    """Return a target with the pass that draws it."""
    return Resources(targets={spec.target: target}, passes=(spec,))


@dataclass(frozen=True)
class Bound:
    """Upper bound of an effect's change to any pixel, from any camera, at any time.

    ``value``: exposed linear light, display white = 1, after clipping to white. ``why``: the reason, for people.
    ``fields``: JSON pointers of live scene fields that the bound depends on; if the effect is left out, a change of one
    of them needs a new plan.
    """

    value: float
    why: str
    fields: tuple[str, ...] = ()

    @classmethod
    def zero_if(cls, hidden: bool, why: str, fields: tuple[str, ...] = ()) -> Self | None:
        """Return the bound of an effect that changes no pixel where it is ``hidden``."""
        return cls(0.0, why, fields) if hidden else None


@dataclass(frozen=True, kw_only=True)
class Contribution(Resources):
    """Everything that an effect adds to a plan. ``why``: the reason for which it is in the plan, for people."""

    why: str
    bound: Bound | None = None
    """Upper bound of the effect's change to any pixel; ``None``: unknown, so the effect is drawn."""
    max_height: float = 0.0
    """Upper bound of the effect's contribution to the surface's height over still water, m."""
    min_height: float = 0.0
    """Lower bound of the effect's contribution to the surface's height, m; at most 0."""
    max_slope: float = 0.0
    """Upper bound of the effect's contribution to the surface's slope."""
    max_curvature: float = 0.0
    """Upper bound of the effect's contribution to the surface's second derivative in any direction, 1/m: the curvature
    of its troughs. :data:`UNBOUNDED` if unknown."""
    map_error: float = 0.0
    """Upper bound of the height by which the drawn surface exceeds the parabola given by its slope at a place and
    ``max_curvature``, m; caused by the interpolation and the number format of a map."""
    min_ground: float | None = None
    """Lowest height of the effect's ground, m."""
    refine: int = 0
    """Least number of Newton steps after the march: for what moves along rays where the surface is found late."""
    coarser: float = 1.0
    """Factor on the tolerance of the march, for what such a step then finds to less than the tolerance."""
    depends: tuple[str, ...] = ()
    """Fields of the scene that the choice of its files depends on, though uniforms follow them."""
    march_factor: int = 1
    """Factor on the number of ray-marching steps: for steep crests, or crests that fill little of the slab between
    lowest and highest water."""

    @classmethod
    def invisible(cls, why: str) -> Self:
        """Return the contribution of an effect that the scene names and that changes no pixel."""
        return cls(why=why, bound=Bound(0.0, why))


Cause = Literal["geometry", "filtering", "precision"]


@dataclass(frozen=True)
class QualityParameter:
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
class SaturationSource:
    """A kind of foam saturation, declared by the effect that draws it.

    ``model``: the part of a scene that describes it. ``limit``: ``limit(part, scene)``, the greatest saturation that
    such a part has anywhere in a scene. ``live``: fields of the part that the limit depends on and that could otherwise
    change without a new plan.
    """

    model: type[BaseModel]
    limit: Callable[[Any, Scene], float]
    live: tuple[str, ...] = ()


@dataclass(frozen=True)
class Extension:
    """Fields and float64 reference of an effect outside the package.

    ``name``: key under ``extensions`` of a scene and of a quality. ``scene``: the part of a scene; without it the
    effect is off. ``quality``: settings; without them their defaults hold. ``truth``: ``truth(part, scene, points)``
    in float64, the part's foam saturation at :class:`seafoam.reference.renderer.sources.SurfacePoints`; (r,).
    """

    name: str
    scene: type[Part]
    quality: type[QualityParameters] | None = None
    truth: Callable[..., Any] | None = None


@dataclass(frozen=True)
class Effect:
    """An effect: its name, the function that returns its contribution to the plan of a scene, and its declarations.

    ``contribute`` returns ``None`` if the scene does not contain the effect. ``fields``: JSON pointers of the parts and
    fields of a scene that belong to the effect, without list indices. ``afloat``: uniforms
    that are places or phases of water, which a current moves. ``parameters``: its fields of a quality. ``saturation``:
    the source of foam that it draws. ``extension``: for effects outside the package, instead of ``fields``; effects of
    the package have their models in :mod:`seafoam.scene` and :mod:`seafoam.quality` and their float64 form in
    :mod:`seafoam.reference`. ``without``: the scene without what the effect draws, for an effect whose files others
    use: where it is left out of a plan, all others see that scene.
    """

    name: str
    contribute: Callable[[Scene, Quality], Contribution | None]
    fields: tuple[str, ...] = ()
    parameters: tuple[QualityParameter, ...] = ()
    saturation: SaturationSource | None = None
    extension: Extension | None = None
    afloat: tuple[str, ...] = ()
    without: Callable[[Scene], Scene] | None = None


def part_effect(
    name: str, draw: Callable[..., Contribution | None], part: str, *parameters: QualityParameter, **declared: Any
) -> Effect:
    """Return the effect of a part of the scene: active where the scene has it.

    ``part``: JSON pointer of the part or field, which is absent if it, or a part on the way to it, is null, empty or 0.
    ``draw``: its contribution; it is given the scene, each part on the way, this one, and the quality. ``declared``:
    more of the effect's fields; ``fields`` are further pointers.
    """

    @wraps(draw)
    def contribute(scene: Scene, quality: Quality) -> Contribution | None:
        parts: list[Any] = [scene]
        for step in part.split("/")[1:]:
            parts.append(getattr(parts[-1], step))
            if not parts[-1]:
                return None
        return draw(*parts, quality)

    return Effect(name, contribute, (part, *declared.pop("fields", ())), parameters, **declared)


def foam_effect(
    name: str,
    draw: Callable[[Scene, Foam, Any, Quality], Contribution],
    source: SaturationSource,
    *parameters: QualityParameter,
    **declared: Any,
) -> Effect:
    """Return the effect that draws a source of foam saturation: active if the scene's foam has one of its model.

    ``draw``: its contribution to a scene, of whose foam and source it is told. ``declared``: fields of the effect.
    """

    @wraps(draw)
    def contribute(scene: Scene, quality: Quality) -> Contribution | None:
        if scene.foam is None:
            return None
        given = next((part for part in scene.foam.saturation if isinstance(part, source.model)), None)
        return None if given is None else draw(scene, scene.foam, given, quality)

    return Effect(name, contribute, parameters=parameters, saturation=source, **declared)


class AssemblyError(RuntimeError):
    """Effects contradict each other or their GLSL: a defect of Seafoam, never of a scene."""


def _united(*mappings: Mapping[str, T]) -> dict[str, T]:
    result: dict[str, T] = {}
    for mapping in mappings:
        repeated = {key for key in result.keys() & mapping.keys() if result[key] != mapping[key]}
        if repeated:
            raise AssemblyError(f"{', '.join(sorted(repeated))}: defined twice")
        result.update(mapping)
    return result


class PlanError(ValueError):
    """A valid scene that cannot be planned.

    ``pointer``: JSON pointer of the field at fault; empty: the scene as a whole.
    """

    def __init__(self, pointer: str, message: str) -> None:
        super().__init__(f"{pointer}: {message}" if pointer else message)
        self.pointer = pointer
        self.message = message
