"""The floor under shallow water. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import min_surface_height
from seafoam.effects.effect import Bound, Contribution, Effect, SlotFile
from seafoam.effects.light.light import lamp_angles, sky_irradiance, sun_irradiance
from seafoam.effects.noise import VALUE_NOISE
from seafoam.framegraph.rules import Uniform, array, in_tile, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.depth`` under a light; a shore has a floor of its own."""
    water, light = scene.water, scene.light
    if water.depth is None or light is None or scene.shore is not None:
        return None
    # The shortest way down and back is straight, under a trough; an eye under water may lie on the floor. Floor and
    # deep water differ by less than the floor at reflectance 1.
    ways = 1.0 if water.view_below else 2.0
    least = max(water.depth + min_surface_height(scene), 0.0)
    most = 0.0
    for sun, sky, length in zip(sun_irradiance(light), sky_irradiance(light), water.absorption_length, strict=True):
        passed = math.exp(-ways * least * (1.0 / length + water.scattering))
        most = max(most, passed * 0.95 * (sun + sky) / math.pi * 2.0**light.exposure)
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
        min_ground=-water.depth,
        bound=Bound(
            most,
            f"no light comes back from {least:g} m",
            ("/light/exposure", "/water/absorption_length", "/water/scattering"),
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
        return (SlotFile("body", "water/body/floor.glsl", needs=(level,)), *under)
    return (
        SlotFile("body", "water/seafloor/body.glsl"),
        SlotFile("bed", "water/seafloor/floor.glsl", needs=laid),
        SlotFile("through", "water/seafloor/through.glsl"),
        *under,
    )


def bed_sun(light: Light) -> dict[str, Uniform]:
    """The way of the sun's light down to a floor."""
    upright = math.sin(lamp_angles(light)[1])
    return {"u_bed_sun": number(significant(math.sqrt(1.0 - (1.0 - upright * upright) / 1.34**2)))}


def _tiles(water: Water) -> dict[str, Uniform]:
    if water.floor_tile is None:
        return {}
    side = water.floor_tile
    return {"u_floor_tile": number(side), "u_floor_tile_place": array("vec2", in_tile(side, period=256.0), 1)}


EFFECT = Effect("floor", contribute)
