"""Which files fill the slots of the shaders that find the surface: by a mesh, by ray marching, or found already."""

from collections.abc import Sequence

from seafoam.effects.effect import MARCH_AHEAD, SlotFile, refine
from seafoam.planner.slots import APPROACH, GENTLER, LAND, LAND_COLOR, LAND_FOAM

_MARCH = SlotFile("marched", "surface/begin.glsl", needs=("surface/step.glsl", refine("refine_water", "waves", "vec3")))
_MARCH_START = SlotFile(
    "start", "surface/start.glsl", prefix="water", needs=("surface/step.glsl", "surface/pyramid.glsl")
)


def surface_files(given: Sequence[SlotFile], *, shore: bool, level: bool, mesh: bool) -> list[SlotFile]:
    """Return the files of the surface's shader. ``given``: those of the effects."""
    intersection = "met" if shore else "plane" if level else "newton" if mesh else "march"
    # With land, a pass before the surface's finds whether a ray hits water or land first.
    of_land = (APPROACH.name, LAND.name, LAND_COLOR.name, LAND_FOAM.name) if shore else ()
    files = [file for file in given if file.slot not in (*of_land, GENTLER.name)]
    files.append(_find(intersection))
    return [*files, _MARCH] if intersection == "march" else files


def marched_files(given: Sequence[SlotFile], level: bool) -> list[SlotFile]:
    """Return the same for passes and for cameras that are not over all crests, which use no mesh.

    Without :data:`seafoam.planner.slots.GENTLER`, whose texture would be one too many where much else is read.
    """
    return [file for file in met_files(given, level) if file.slot != GENTLER.name]


def met_files(given: Sequence[SlotFile], level: bool) -> list[SlotFile]:
    """Return the same for a pass that only finds what rays meet. ``level``: whether the water is."""
    method, under = ("plane", "plane") if level else ("march", "find")
    left_out = (APPROACH.name, GENTLER.name) if level else ()
    return [
        *(file for file in given if file.slot not in left_out),
        _find(method),
        SlotFile("underside", f"water/underside/{under}.glsl"),
        SlotFile("bounds", "surface/declared_bounds.glsl", prefix="declared"),
        *(() if level else (_MARCH, _MARCH_START)),
    ]


def _find(intersection: str) -> SlotFile:
    """Return the file that intersects rays with the surface."""
    return SlotFile("find", f"surface/{intersection}.glsl", needs=(MARCH_AHEAD,) if intersection == "march" else ())
