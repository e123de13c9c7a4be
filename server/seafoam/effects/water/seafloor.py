"""The floor under shallow water. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, surface_trough
from seafoam.effects.effect import Bound, Contribution, Effect, SlotFile
from seafoam.effects.light.light import lamp_angles
from seafoam.effects.light.noise import VALUE_NOISE
from seafoam.framegraph.rules import Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.refraction import refracted_cosine
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.depth`` under a light; a shore has a floor of its own."""
    water, light = scene.water, scene.light
    if water.depth is None or light is None or scene.shore is not None:
        return None
    # Floor and deep water differ by less than the floor at reflectance 1.
    least = max(water.depth + surface_trough(scene), 0.0)
    looked_at = light.caustics is not None or water.floor_tile is not None
    return Contribution(
        why=f"a floor {water.depth:g} m under still water" + (", by the refracted ray" if looked_at else ""),
        slots=_slots(water, looked_at),
        uniforms={
            "u_floor_albedo": vector(water.floor_albedo, "/water/floor_albedo"),
            "u_floor_depth": number(water.depth),
            **bed_sun(light),
            **_tiles(water),
        },
        bottom=-water.depth,
        bound=Bound(
            floor_limit(scene, light, least),
            f"no light comes back from {least:g} m",
            FLOOR_FIELDS,
        ),
    )


def _slots(water: Water, looked_at: bool) -> tuple[SlotFile, ...]:
    """Where places tell apart (``looked_at``), the ray refracted at the surface finds the one that is seen."""
    level = "water/seafloor/level.glsl"
    laid = (
        (level, "water/seafloor/plain.glsl")
        if water.floor_tile is None
        else (level, *VALUE_NOISE, "water/seafloor/tiles.glsl")
    )
    under = (
        SlotFile("reach", "water/seafloor/reach.glsl", needs=(level,)),
        SlotFile(
            "under bed", "water/seafloor/floor.glsl", needs=laid if looked_at else ("water/seafloor/even.glsl", *laid)
        ),
    )
    if not looked_at:
        return (SlotFile("body", "water/body/floor.glsl", needs=("lib/refraction.glsl", level)), *under)
    return (
        SlotFile("body", "water/seafloor/body.glsl"),
        SlotFile("bed", "water/seafloor/floor.glsl", needs=laid),
        SlotFile("through", "water/seafloor/through.glsl", needs=("lib/refraction.glsl",)),
        *under,
    )


def bed_sun(light: Light) -> dict[str, Uniform]:
    """The way of the sun's light down to a floor."""
    upright = math.sin(lamp_angles(light)[1])
    return {"u_bed_sun": number(significant(refracted_cosine(upright)))}


def _tiles(water: Water) -> dict[str, Uniform]:
    if water.floor_tile is None:
        return {}
    side = water.floor_tile
    place = [Wrap(k=k, period=256.0) for k in ((1.0 / side, 0.0), (0.0, 1.0 / side))]
    return {"u_floor_tile": number(side), "u_floor_tile_place": array("vec2", place, 1)}


EFFECT = Effect("floor", contribute)
