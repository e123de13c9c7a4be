"""The floor under shallow water. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import surface_trough
from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.effects.light.light import lamp_angles, sky_irradiance, sun_irradiance
from seafoam.effects.light.noise import VALUE_NOISE
from seafoam.framegraph.rules import Uniform, Wrap, array, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Chop,
    Light,
    ParametricWave,
    Scene,
    Water,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.depth`` under a light; a shore has a floor of its own."""
    water, light = scene.water, scene.light
    if water.depth is None or light is None or scene.shore is not None:
        return None
    # The shortest way down and back is straight, under a trough; an eye under water may lie on the floor. Floor and
    # deep water differ by less than the floor at reflectance 1.
    ways = 1.0 if water.view_below else 2.0
    least = max(water.depth + surface_trough(scene), 0.0)
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
        bottom=-water.depth,
        bound=Bound(
            most,
            f"no light comes back from {least:g} m",
            ("/light/exposure", "/water/absorption_length", "/water/scattering"),
        ),
    )


def _slots(water: Water, looked_at: bool) -> tuple[SlotFile, ...]:
    """Where places tell apart (``looked_at``), the ray refracted at the surface finds the one that is seen."""
    level = "bed/level.glsl"
    laid = (level, "bed/plain.glsl") if water.floor_tile is None else (level, *VALUE_NOISE, "bed/tiles.glsl")
    under = (
        SlotFile("reach", "bed/reach.glsl", needs=(level,)),
        SlotFile("under bed", "bed/floor.glsl", needs=laid if looked_at else ("bed/even.glsl", *laid)),
    )
    if not looked_at:
        return (SlotFile("body", "body/floor.glsl", needs=(level,)), *under)
    return (
        SlotFile("body", "bed/body.glsl"),
        SlotFile("bed", "bed/floor.glsl", needs=laid),
        SlotFile("through", "bed/through.glsl"),
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
    place = [Wrap(k=k, period=256.0) for k in ((1.0 / side, 0.0), (0.0, 1.0 / side))]
    return {"u_floor_tile": number(side), "u_floor_tile_place": array("vec2", place, 1)}


EFFECT = Effect(
    "floor",
    contribute,
    invisible=(
        Scene(water=Water(depth=11000.0)),
        Scene(waves=(ParametricWave(),), water=Water(depth=500.0, chop=Chop())),
    ),
    hard_cases=(
        HardCase(
            name="five centimetres of black water",
            scene=Scene(
                water=Water(depth=0.05, absorption_length=(0.01, 0.01, 0.01), scattering=0.5, chop=Chop(slope=0.6)),
                waves=(ParametricWave(amplitude=50.0, wavelength=0.05),),
            ),
            guard="cv held at 1 under the root (body/floor.glsl)",
            without="cosine of the refracted ray up to 74: 8 % too much light from the floor at cv = 100",
            camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.6),
        ),
        HardCase(
            name="the clearest water over a white floor",
            scene=Scene(
                water=Water(
                    depth=0.05, absorption_length=(1000.0, 1000.0, 1000.0), scattering=0.0, floor_albedo=(1.0, 1.0, 1.0)
                )
            ),
            guard="absorption is never 0 (scene/models.py), so neither is the extinction (shade/lit.glsl)",
            without="with absorption 0: 0/0 in every sample of water, 65504 after the frame's cap",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="a floor eleven kilometres down",
            scene=Scene(water=Water(depth=11000.0, chop=Chop()), waves=(ParametricWave(),)),
            guard="left out: its bound is 0 (effects/water/seafloor.py); drawn, its transmittance underflows to 0 "
            "(body/floor.glsl)",
            without="drawn all the same: 0 levels of difference",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
    ),
)
