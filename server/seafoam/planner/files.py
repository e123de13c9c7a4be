"""Which files fill the slots of the shaders that find the surface: by a mesh, by ray marching, or found already."""

from collections.abc import Sequence

from seafoam.effects.shader import MARCH_AHEAD, SlotFile, refine
from seafoam.planner.slots import APPROACH, GENTLER, LAND, LAND_COLOR, LAND_FOAM

_MARCHED, _PLANE = "surface/march.glsl@march", "surface/march.glsl@plane"
_MARCH = SlotFile(
    "marched", "surface/march.glsl@begin", needs=("surface/march.glsl@step", refine("refine_water", "waves", "vec3"))
)
_MARCH_START = SlotFile(
    "start",
    "surface/start.glsl@start",
    prefix="water",
    needs=("surface/march.glsl@step", "surface/bounds.glsl@pyramid"),
)


def surface_files(given: Sequence[SlotFile], *, shore: bool, level: bool, mesh: bool) -> list[SlotFile]:
    """Return the files of the surface's shader. ``given``: those of the effects."""
    intersection = (
        "surface/met.glsl@met" if shore else _PLANE if level else "surface/march.glsl@newton" if mesh else _MARCHED
    )
    # With land, a pass before the surface's finds whether a ray hits water or land first.
    of_land = (APPROACH.name, LAND.name, LAND_COLOR.name, LAND_FOAM.name) if shore else ()
    files = [file for file in given if file.slot not in (*of_land, GENTLER.name)]
    files.append(_find(intersection))
    return [*files, _MARCH] if intersection == _MARCHED else files


def marched_files(given: Sequence[SlotFile], level: bool) -> list[SlotFile]:
    """Return the same for passes and for cameras that are not over all crests, which use no mesh.

    Without :data:`seafoam.planner.slots.GENTLER`, whose texture would be one too many where much else is read.
    """
    return [file for file in met_files(given, level) if file.slot != GENTLER.name]


def met_files(given: Sequence[SlotFile], level: bool) -> list[SlotFile]:
    """Return the same for a pass that only finds what rays meet. ``level``: whether the water is."""
    under = "water/underside.glsl@plane" if level else "water/underside.glsl@find"
    left_out = (APPROACH.name, GENTLER.name) if level else ()
    return [
        *(file for file in given if file.slot not in left_out),
        _find(_PLANE if level else _MARCHED),
        SlotFile("underside", under),
        SlotFile("bounds", "surface/bounds.glsl@declared", prefix="declared"),
        *(() if level else (_MARCH, _MARCH_START)),
    ]


def _find(intersection: str) -> SlotFile:
    """Return the file that intersects rays with the surface."""
    return SlotFile("find", intersection, needs=(MARCH_AHEAD,) if intersection == _MARCHED else ())
