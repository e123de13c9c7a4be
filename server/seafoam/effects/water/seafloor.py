"""The floor under shallow water. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, min_surface_height
from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.effects.light.atmosphere import lamp_angles
from seafoam.effects.noise import VALUE_NOISE
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import Uniform, array, in_tile, number, significant, vector
from seafoam.ocean.basics.refraction import refracted_cosine
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the water has a depth and the scene a light; a shore has its own floor."""
    water, light = scene.water, scene.light
    if water.depth is None or light is None or scene.shore is not None:
        return None
    # Floor and deep water differ by less than the radiance of a white floor.
    min_depth = max(water.depth + min_surface_height(scene), 0.0)
    refracted = light.caustics is not None or water.floor_tile is not None
    return Contribution(
        why=f"a floor {water.depth:g} m under still water" + (", seen along the refracted ray" if refracted else ""),
        slots=_slots(water, refracted),
        uniforms={
            "u_floor_albedo": vector(water.floor_albedo, "/water/floor_albedo"),
            "u_floor_depth": number(water.depth),
            **bed_sun(light),
            **_tiles(water),
        },
        min_ground=-water.depth,
        bound=Bound(
            floor_limit(scene, light, min_depth), f"no light returns from a depth of {min_depth:g} m", FLOOR_FIELDS
        ),
    )


def _slots(water: Water, refracted: bool) -> tuple[SlotFile, ...]:
    """``refracted``: the floor varies from point to point, so that the refracted ray must find the visible one."""
    level = "water/seafloor.glsl@level"
    floor = (
        (level, "water/seafloor.glsl@plain")
        if water.floor_tile is None
        else (level, *VALUE_NOISE, "water/seafloor.glsl@tiles")
    )
    under = (
        SlotFile("reach", "water/seafloor.glsl@reach", needs=(level,)),
        SlotFile(
            "under bed", "water/seafloor.glsl@floor", needs=floor if refracted else ("water/seafloor.glsl@even", *floor)
        ),
    )
    if not refracted:
        return (SlotFile("body", "water/body.glsl@floor", needs=("lib/refraction.glsl", level)), *under)
    return (
        SlotFile("body", "water/seafloor.glsl@body"),
        SlotFile("bed", "water/seafloor.glsl@floor", needs=floor),
        SlotFile("through", "water/seafloor.glsl@through", needs=("lib/refraction.glsl",)),
        *under,
    )


def bed_sun(light: Light) -> dict[str, Uniform]:
    """Cosine between the refracted sunlight and the vertical."""
    height = math.sin(lamp_angles(light)[1])
    return {"u_bed_sun": number(significant(refracted_cosine(height)))}


def _tiles(water: Water) -> dict[str, Uniform]:
    if water.floor_tile is None:
        return {}
    side = water.floor_tile
    return {"u_floor_tile": number(side), "u_floor_tile_place": array("vec2", in_tile(side, period=256.0), 1)}


EFFECT = Effect("floor", contribute, fields=("/water/depth", "/water/floor_albedo", "/water/floor_tile"))
