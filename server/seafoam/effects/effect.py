"""What an effect gives to a frame plan: slot files, compile-time numbers, textures, targets, passes, bounds, hard
cases.

Effects describe; the planner assembles.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

from seafoam.framegraph.passes import Blend, Fullscreen, Grid, Points, View
from seafoam.framegraph.resources import Filter, Target, TargetInput, TextureInput, WrapMode
from seafoam.framegraph.rules import Uniform
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Scene

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
class Source:
    """A file of ``shaders/`` in which names are replaced, ``rename``: (old, new).

    So another file can stand in its place and call it.
    """

    path: str
    rename: tuple[tuple[str, str], ...] = ()


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
