"""The body of the water, its floor, light through its crests, and the view from below its surface.

docs/formulae.md, sections 6 and 11.
"""

import math

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, max_surface_height, min_surface_height
from seafoam.effects.effect import Bound, Contribution, part_effect
from seafoam.effects.light.atmosphere import lamp_angles
from seafoam.effects.light.light import brightest_sun
from seafoam.effects.shader import VALUE_NOISE, SlotFile
from seafoam.framegraph.rules import Uniform, array, in_tile, number, significant, vector
from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves.cascades import cascades, slope_heading
from seafoam.quality import Quality
from seafoam.scene import Light, Scene, Water

WATER = "water/underside.glsl@water"
"""Absorption and scattering between a camera below the surface and what it sees."""


def _slope_heading(scene: Scene) -> tuple[float, float]:
    """Return how much more of the sea's slope variance lies along its wind, at twice the wind's heading."""
    if scene.sea is None or scene.sea.wind_speed <= 0.0:
        return 0.0, 0.0
    along, aside = slope_heading(cascades(scene.sea, scene.water.depth))
    # Of so few digits that every machine gets the same bytes, and no −0.
    return round(along, 4) + 0.0, round(aside, 4) + 0.0


def _draw(scene: Scene, light: Light, quality: Quality) -> Contribution:
    water = scene.water
    uniforms: dict[str, Uniform] = {
        "u_absorption_length": vector(water.absorption_length, "/water/absorption_length"),
        "u_scattering": number(water.scattering, "/water/scattering"),
        "u_roughness": number(water.roughness, "/water/roughness"),
        "u_slope_heading": vector(_slope_heading(scene)),
    }
    return Contribution(why="the water absorbs and scatters light", uniforms=uniforms)


def _underside(scene: Scene, water: Water, allowed: bool, quality: Quality) -> Contribution | None:
    if scene.light is None and scene.foam is None:
        return None
    shows, file = "shows its foam", SlotFile("below", "water/underside.glsl@flat")
    if scene.light is not None:
        shows = "transmits the sky and reflects the floor"
        file = SlotFile("below", "water/underside.glsl@main", needs=(WATER,))
    return Contribution(why=f"from below, the surface {shows}", slots=(file,))


def _floor(scene: Scene, water: Water, depth: float, quality: Quality) -> Contribution | None:
    """A shore has its own floor."""
    light = scene.light
    if light is None or scene.shore is not None:
        return None
    # Floor and deep water differ by less than the radiance of a white floor.
    min_depth = max(depth + min_surface_height(scene), 0.0)
    refracted = light.caustics is not None or water.floor_tile is not None
    tiles: dict[str, Uniform] = {}
    if side := water.floor_tile:
        tiles = {"u_floor_tile": number(side), "u_floor_tile_place": array("vec2", in_tile(side, period=256.0), 1)}
    return Contribution(
        why=f"a floor {depth:g} m under still water" + (", seen along the refracted ray" if refracted else ""),
        slots=_floor_slots(water, refracted),
        uniforms={
            "u_floor_albedo": vector(water.floor_albedo, "/water/floor_albedo"),
            "u_floor_depth": number(depth),
            **bed_sun(light),
            **tiles,
        },
        min_ground=-depth,
        bound=Bound(
            floor_limit(scene, light, min_depth), f"no light returns from a depth of {min_depth:g} m", FLOOR_FIELDS
        ),
    )


def _floor_slots(water: Water, refracted: bool) -> tuple[SlotFile, ...]:
    """``refracted``: the floor varies from point to point, so that the refracted ray must find the visible one."""
    level = "water/seafloor.glsl@level"
    look = ("water/seafloor.glsl@plain",) if water.floor_tile is None else (*VALUE_NOISE, "water/seafloor.glsl@tiles")
    floor = (level, *look)
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
    """Cosine between the refracted sunlight and the vertical, by Snell's law."""
    height = math.sin(lamp_angles(light)[1])
    return {"u_bed_sun": number(significant(math.sqrt(1.0 - (1.0 - height * height) / WATER_INDEX**2)))}


def _crest_light(scene: Scene, light: Light, quality: Quality) -> Contribution:
    highest, lowest = max_surface_height(scene), min_surface_height(scene)
    water, level = scene.water, math.cos(lamp_angles(light)[1])
    through = (
        water.translucency / math.pi * sun * math.exp(-6.0 / length) * level
        for sun, length in zip(brightest_sun(light), water.absorption_length, strict=True)
    )
    return Contribution(
        why=f"crests of up to {highest:g} m transmit sunlight",
        slots=(SlotFile("crest", "light/shade.glsl@translucent", needs=("light/shade.glsl@irradiance",)),),
        uniforms={
            "u_translucency": number(water.translucency, "/water/translucency"),
            "u_crest_trough": number(significant(lowest)),
            "u_crest_height": number(1.0 / (highest - lowest) if highest - lowest > 1e-37 else 0.0),
        },
        bound=Bound(
            float(max(through)) * math.exp2(light.exposure) if highest > 0.0 else 0.0,
            "no crests, no sunlight, or water that absorbs all of it",
            ("/light/exposure", "/water/absorption_length", "/water/translucency"),
        ),
    )


EFFECT = part_effect("water body", _draw, "/light", fields=("/water",))
UNDERSIDE = part_effect("view from below", _underside, "/water/view_below")
FLOOR = part_effect("floor", _floor, "/water/depth", fields=("/water/floor_albedo", "/water/floor_tile"))
CREST_LIGHT = part_effect("crest light", _crest_light, "/light", fields=("/water/translucency",))
