"""Pieces of shaders: files of ``shaders/`` and inline GLSL, the slots that they fill, and the noise library."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from seafoam.framegraph.rules import Phase, Uniform, array

COMMON = ("lib/numbers.glsl", "lib/rays.glsl@camera")
"""First files of most fragment shaders."""
PLACE = "lib/rays.glsl@place"
"""Maps a fragment to its sample of the picture."""
MARCH_AHEAD = "surface/march.glsl@ahead"
"""Steps of ray marching, for files in the slots of its parts."""
Const = int | float | bool | tuple[int, ...]
"""A compile-time constant; a tuple is an array."""
HASH = "lib/noise.glsl@hash"
VALUE_NOISE = (HASH, "lib/noise.glsl@value")
SLOPES = (HASH, "lib/noise.glsl@slopes")
PERLIN_2 = (HASH, "lib/noise.glsl@perlin_2")
PERLIN_3 = (HASH, "lib/noise.glsl@perlin_3")
NOISE_CELLS = 256
"""Period of the gradient noise, cells."""


@dataclass(frozen=True)
class Source:
    """A file of ``shaders/`` in which names are replaced, so that another file can define these names and call it.

    ``rename``: pairs (old, new).
    """

    path: str
    rename: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Inline:
    """GLSL source that is not in a file."""

    text: str


Piece = str | Source | Inline
"""A piece of a shader's source; a string is the path of a file of ``shaders/``, included unchanged."""


@dataclass(frozen=True)
class SlotRef:
    """The files that fill a slot of the surface's shader."""

    slot: str


@dataclass(frozen=True)
class SlotFile:
    """A GLSL file that fills a slot.

    ``prefix``: of the names of its functions, if several files can fill the slot. ``needs``: files that it calls, which
    are included before it, and only once if several files need them. ``instead``: it replaces the files of earlier
    effects in this slot, which need not know of it.
    """

    slot: str
    path: Piece
    prefix: str = ""
    needs: tuple[Piece, ...] = ()
    instead: bool = False


def path_of(piece: Piece | SlotRef) -> str | None:
    """Return the path of a piece's file; None if it is not a file."""
    return piece.path if isinstance(piece, Source) else piece if isinstance(piece, str) else None


def refine(name: str, field: str, kind: str) -> Source:
    """Newton's method along a ray to a height field, as a function ``name`` (``lib/rays.glsl@newton``).

    ``field``: the GLSL function of the field's height and gradient, which comes before it, and the type it returns.
    """
    return Source("lib/rays.glsl@newton", (("refine", name), ("field_at", field), ("vec4", kind)))


def constant_function(returns: str, name: str, parameters: str, value: str = "", before: str = "") -> Inline:
    """Return a GLSL function that returns ``value``, or 0, for all arguments: the default of a slot.

    ``before``: statements of lines of their own, which set what else it gives.
    """
    value = value or ("0.0" if returns == "float" else f"{returns}(0.0)")
    lines = [*before.splitlines(), *([] if returns == "void" else [f"return {value};"])]
    body = "".join(f"    {line}\n" for line in lines)
    return Inline(f"{returns} {name}({parameters}) {{\n{body}}}\n")


def joined(*pieces: Inline) -> Inline:
    return Inline("\n".join(piece.text for piece in pieces))


def drifting_phases(axes: Iterable[tuple[float, float]], velocity: tuple[float, float], turn: float) -> Uniform:
    """Phases of the camera's place on a pattern that drifts with ``velocity``, (x, z) m/s; rad.

    ``axes``: those of the pattern, per metre; ``turn``: the phase of a unit along them, rad.
    """
    v_x, v_z = velocity
    phases = [Phase(offset=0.0, rate=-turn * (x * v_x + z * v_z), k=(turn * x, turn * z)) for x, z in axes]
    return array("float", phases, len(phases))


def drifting_noise(size: float, speed: float, heading: float, change: float) -> Uniform:
    """Phases (x, z, t), float[3], of three-dimensional gradient noise, 2π per :data:`NOISE_CELLS` cells.

    ``size``: side of a cell, m; ``speed``, m/s, and ``heading``, rad, of its drift; ``change``: cell length along t, s.
    """
    k = 2.0 * math.pi / (NOISE_CELLS * size)
    velocity = (speed * math.cos(heading), speed * math.sin(heading))
    changes = Phase(offset=0.0, rate=2.0 * math.pi / (NOISE_CELLS * change), k=(0.0, 0.0))
    return array("float", (*drifting_phases(((1.0, 0.0), (0.0, 1.0)), velocity, k).rules, changes), 3)
