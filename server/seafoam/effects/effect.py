"""What an effect gives to a frame plan: slot files, compile-time numbers, textures, targets, passes, bounds, hard
cases.

Effects describe; the planner assembles.
"""

import importlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

from seafoam.framegraph.passes import Blend, Fullscreen, Grid, Points, View
from seafoam.framegraph.resources import Filter, Target, TargetInput, TextureInput, WrapMode
from seafoam.framegraph.rules import Uniform
from seafoam.quality import Quality
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene

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
class Source:
    """A file of ``shaders/`` in which names are replaced, ``rename``: (old, new).

    So another file can stand in its place and call it.
    """

    path: str
    rename: tuple[tuple[str, str], ...] = ()


def refine(name: str, field: str, kind: str) -> Source:
    """Newton's method along a ray to a height field, as a function ``name`` (``lib/newton.glsl``).

    ``field``: the GLSL function of the field's height and gradient, which comes before it, and the type it returns.
    """
    return Source("lib/newton.glsl", (("refine", name), ("field_at", field), ("vec4", kind)))


@dataclass(frozen=True)
class Inline:
    """GLSL that stands in no file."""

    text: str


def constant_function(returns: str, name: str, parameters: str, value: str = "") -> Inline:
    """A GLSL function that gives ``value``, or 0, whatever it is called with: what stands in a slot nothing fills."""
    value = value or ("0.0" if returns == "float" else f"{returns}(0.0)")
    return Inline(f"{returns} {name}({parameters}) {{\n    return {value};\n}}\n")


@dataclass(frozen=True)
class SlotRef:
    """Whatever fills a slot of the surface's shader."""

    slot: str


Piece = str | Source | Inline
"""A part of a shader's text; a bare string is the path of a file of ``shaders/``, taken as it is."""


def path_of(piece: Piece | SlotRef) -> str | None:
    """Path of the file that a piece is; None: it is none."""
    return piece.path if isinstance(piece, Source) else piece if isinstance(piece, str) else None


@dataclass(frozen=True)
class SlotFile:
    """A GLSL file that fills a slot. ``prefix`` names its functions where several files share a slot.

    ``needs``: helpers that go in before it, once however many ask for them.
    """

    slot: str
    path: Piece
    prefix: str = ""
    needs: tuple[Piece, ...] = ()


@dataclass(frozen=True)
class PassSpec:
    """A pass that an effect adds; ``vertex`` and ``fragment`` list its files.

    It covers its whole target unless told otherwise. A :class:`SlotRef` among the files brings what its slot reads.
    ``stage``: before the surface is
    drawn, or after surface and sky into :data:`ABOVE`, which is cleared for the first of them.
    """

    name: str
    program: str
    fragment: tuple[Piece | SlotRef, ...]
    target: str
    vertex: tuple[Piece | SlotRef, ...] = ("vertex/fullscreen.glsl",)
    mesh: Fullscreen | Grid | Points = field(default_factory=Fullscreen)
    inputs: dict[str, TextureInput | TargetInput] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    stage: Literal["before", "after"] = "before"
    blend: Blend = "none"
    clear: bool = False
    view: View = "any"
    under: tuple[Piece | SlotRef, ...] = ()
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
    """Upper bound of the effect's share of the surface height above still water, m."""
    trough: float = 0.0
    """Lower bound of the effect's share of the surface height, m; at most 0."""
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
class Cases:
    """What holds an effect to its word: scenes that it cannot be seen in, and scenes that provoke a failure.

    ``invisible``: scenes that call for the effect and cannot show it; an effect that shows wherever it is called for
    says why in ``always_visible`` instead.
    """

    hard: tuple[HardCase, ...] = ()
    invisible: tuple[Scene, ...] = ()
    always_visible: str = ""


@dataclass(frozen=True)
class Effect:
    """An effect: its name, and what it gives to the plan of a scene.

    ``contribute`` returns ``None`` where the scene does not call for the effect. Its :class:`Cases` stand in ``CASES``
    of the module beside its own, ``NAME_cases``, by the effect's name: no server loads them.
    """

    name: str
    contribute: Callable[[Scene, Quality], Contribution | None]
    knobs: tuple[Knob, ...] = ()

    @property
    def cases(self) -> Cases:
        """The effect's cases. Raises ``ImportError`` where there is no module of them."""
        beside = importlib.import_module(f"{self.contribute.__module__}_cases")
        cases: Cases = beside.CASES[self.name]
        return cases


class PlanError(ValueError):
    """A valid scene that cannot be planned.

    ``pointer``: JSON pointer of the field at fault; empty: the scene as a whole.
    """

    def __init__(self, pointer: str, message: str) -> None:
        super().__init__(f"{pointer}: {message}" if pointer else message)
        self.pointer = pointer
        self.message = message
