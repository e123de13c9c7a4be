"""Pieces of shaders: files of ``shaders/`` and inline GLSL, and the slots of the surface's shader that they fill."""

from dataclasses import dataclass

MARCH_AHEAD = "surface/march.glsl@ahead"
"""Steps of ray marching, for files in the slots of its parts."""

Const = int | float | bool | tuple[int, ...]
"""A compile-time constant; a tuple is an array."""


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


def constant_function(returns: str, name: str, parameters: str, value: str = "") -> Inline:
    """Return a GLSL function that returns ``value``, or 0, for all arguments: the default of a slot."""
    value = value or ("0.0" if returns == "float" else f"{returns}(0.0)")
    return Inline(f"{returns} {name}({parameters}) {{\n    return {value};\n}}\n")
