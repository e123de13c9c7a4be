"""Passes for a camera over the water and for one under it.

Between the highest crest and the deepest trough the camera can be on either side. There the passes for both are drawn,
and the vertex shaders of the wrong side place their triangles outside the picture.
"""

from collections.abc import Sequence
from dataclasses import replace

from seafoam.effects.shader import Piece, Source
from seafoam.framegraph.passes import Eyes, Pass
from seafoam.planner.glsl import COMMON

OVER: Eyes = ("over", "between")
FROM_OVER = "FROM_OVER"
"""Constant of vertex shaders: whether they draw from over the water, or from under it."""


def one_sided(vertex: Sequence[Piece], waves: Sequence[Piece]) -> list[Piece]:
    """Return a vertex shader that draws nothing from the other side of the water than :data:`FROM_OVER` names.

    ``vertex``: the pieces of a vertex shader, its ``main`` in the last; ``waves``: the surface's.
    """
    *before, last = vertex
    source = Source(last) if isinstance(last, str) else last
    assert isinstance(source, Source)
    main = replace(source, rename=(*source.rename, ("main", "place_corner")))
    first = (*COMMON, *waves)
    return [*first, *(piece for piece in before if piece not in first), main, "vertex/vertex.glsl@side"]


def from_under(drawn: Pass, level: bool) -> list[Pass]:
    """Return a pass for a camera under the water: where it can be on either side, the pass for over it has cleared.

    ``level``: whether the water is, so that there is no between.
    """
    either = drawn.model_copy(update={"eye": ("between",), "state": drawn.state.model_copy(update={"clear": False})})
    under = drawn.model_copy(update={"eye": ("under",)})
    return [under] if level else [either, under]
