"""Upper bounds of parts of a scene, at any place and time, from which the effects' bounds are derived."""

import math

from seafoam.effects.light.light import lamp_angles, sky_irradiance, sun_irradiance
from seafoam.ocean.cascades import RAISED, cascades
from seafoam.ocean.levels import paper_level
from seafoam.ocean.rings import ring_height
from seafoam.ocean.wakes import LEAST_SPEED, wake_height
from seafoam.scene.foam import (
    DriftSaturation,
    Foam,
    FoldSaturation,
    FrontSaturation,
    HeightSaturation,
    Saturation,
    SlopeSaturation,
    SurfSaturation,
    WakeSaturation,
)
from seafoam.scene.light import Light
from seafoam.scene.models import Scene

SATURATION_CAP = 4.0
"""Cap of the saturation: no look distinguishes greater values (docs/formulae.md, section 4)."""


FLOOR_FIELDS = ("/light/exposure", "/water/absorption_length", "/water/scattering")
"""Fields that :func:`floor_limit` depends on and that can change without a new plan."""


def waves_top(scene: Scene) -> float:
    """Greatest height of the parametric waves over their troughs, m: every crest in one place."""
    return sum(wave.amplitude for wave in scene.waves)


def surface_top(scene: Scene) -> float:
    """Greatest height of everything that raises the surface, m: all crests in one place."""
    top = waves_top(scene) - paper_level(scene) + _swing(scene)
    return top if scene.shore is None else top + scene.shore.surf.height


def surface_trough(scene: Scene) -> float:
    """Lowest that the surface can be, m, at most 0: all troughs in one place."""
    return -(paper_level(scene) + _swing(scene))


def _swing(scene: Scene) -> float:
    """Greatest height of what rises as far over still water as it falls under it: rings, wakes and open sea; m."""
    swing = ring_height(scene) + wake_height(scene.boats)
    if scene.sea is not None and scene.sea.wind > 0.0:
        swing += sum(of.limit for of in cascades(scene.sea, scene.water.depth)[:RAISED])
    return swing


def front_limit(front: FrontSaturation, scene: Scene) -> float:
    """Greatest front saturation: the cap, which every front reaches at its pole, unless the gate never opens."""
    return SATURATION_CAP if scene.waves and front.group[0] < 1.0 else 0.0


def height_limit(height: HeightSaturation, scene: Scene) -> float:
    """Greatest height saturation: that of the greatest height."""
    reached = (surface_top(scene) + paper_level(scene) - height.base) / (height.full - height.base)
    return min(max(reached, 0.0), SATURATION_CAP)


def surf_limit(surf: SurfSaturation, scene: Scene) -> float:
    """Greatest surf saturation: on a thin film 2.4 of the front's, and twice the veil, or nothing without surf."""
    if scene.shore is None or scene.shore.surf.height == 0.0:
        return 0.0
    return min(2.4 * surf.amount + 2.0 * surf.veil, SATURATION_CAP)


def drift_limit(drift: DriftSaturation, scene: Scene) -> float:
    """Greatest drift saturation: the ages that are alive together weigh 2."""
    return min(2.0 * drift.amount, SATURATION_CAP) if scene.drift is not None else 0.0


def wake_limit(wake: WakeSaturation, scene: Scene) -> float:
    """Greatest wake saturation: none where no boat moves."""
    if not any(boat.speed >= LEAST_SPEED for boat in scene.boats):
        return 0.0
    return min(len(scene.boats) * (1.2 * wake.amount + 1.7 * wake.bow), SATURATION_CAP)


def slope_limit(slope: SlopeSaturation, scene: Scene) -> float:
    """Greatest slope saturation: that of a wall; none where nothing raises the surface."""
    return min(slope.gain * (1.0 - slope.base), SATURATION_CAP) if surface_top(scene) > 0.0 else 0.0


def source_limit(source: Saturation, scene: Scene) -> float:
    """Greatest saturation of one source."""
    match source:
        case FrontSaturation():
            return front_limit(source, scene)
        case HeightSaturation():
            return height_limit(source, scene)
        case SlopeSaturation():
            return slope_limit(source, scene)
        case FoldSaturation():
            return 1.0 if scene.sea is not None and scene.sea.wind > 0.0 else 0.0
        case SurfSaturation():
            return surf_limit(source, scene)
        case DriftSaturation():
            return drift_limit(source, scene)
        case WakeSaturation():
            return wake_limit(source, scene)


def greatest_saturation(foam: Foam, scene: Scene) -> float:
    """Greatest saturation of the sources as they join."""
    limits = [source_limit(source, scene) for source in foam.saturation]
    if foam.combine == "max":
        return max(limits)
    return min(math.prod(limits), SATURATION_CAP)


def slope_sensitivity(scene: Scene) -> float:
    """Most by which a slope of the surface changes a pixel, display white = 1, a unit of slope.

    Glitter L below white changes by at most L·2t/σ² a unit, t = tan of the facet's tilt, and is below white only for
    t < σ√(ln(peak)) ≤ 3.7 σ: 7.4/σ with σ at least the water's own roughness. Sky, Fresnel and body are gentler; 30
    covers them at any exposure that does not bring the sky to white.
    """
    if scene.light is None:
        return 0.0
    return (7.4 / scene.water.roughness + 30.0) * max(1.0, math.exp2(scene.light.exposure))


def crest_limit(scene: Scene) -> float:
    """Brightest light through a crest, display white = 1."""
    light, water = scene.light, scene.water
    if light is None or surface_top(scene) == 0.0:
        return 0.0
    passed = (
        water.translucency / math.pi * sun * math.exp(-6.0 / length) * math.cos(lamp_angles(light)[1])
        for sun, length in zip(sun_irradiance(light), water.absorption_length, strict=True)
    )
    return max(passed) * math.exp2(light.exposure)


def saturation_fields(foam: Foam) -> tuple[str, ...]:
    """JSON pointers of the live fields that :func:`greatest_saturation` hangs on."""
    return tuple(
        f"/foam/saturation/{i}/{name}"
        for i, source in enumerate(foam.saturation)
        for name in (
            ("base", "full")
            if isinstance(source, HeightSaturation)
            else ("amount",)
            if isinstance(source, DriftSaturation)
            else ("base", "gain")
        )
        if not isinstance(source, FrontSaturation)
    )


def body_limit(scene: Scene) -> float:
    """Brightest light from within the water, what it scatters and a white floor alike, display white = 1."""
    return 0.0 if scene.light is None else 0.95 / math.pi * _brightest_irradiance(scene.light)


def floor_limit(scene: Scene, light: Light, depth: float, *, sky: bool = True) -> float:
    """Brightest light that comes back from a floor of reflectance 1, ``depth`` m down, display white = 1.

    ``sky``: of sun and sky; else of the sun alone. The shortest way down and back is straight; an eye under water may
    lie on the floor.
    """
    water = scene.water
    ways = 1.0 if water.view_below else 2.0
    most = 0.0
    for sun, air, length in zip(sun_irradiance(light), sky_irradiance(light), water.absorption_length, strict=True):
        passed = math.exp(-ways * depth * (1.0 / length + water.scattering))
        most = max(most, passed * 0.95 * (sun + air if sky else sun) / math.pi * 2.0**light.exposure)
    return most


def foam_limit(foam: Foam, scene: Scene) -> float:
    """Brightest foam, display white = 1; at least white."""
    return 1.0 if scene.light is None else max(foam.albedo / math.pi * _brightest_irradiance(scene.light), 1.0)


def _brightest_irradiance(light: Light) -> float:
    """Of the sun overhead and the whole sky, its brightest channel, exposed."""
    both = (sun + sky for sun, sky in zip(sun_irradiance(light), sky_irradiance(light), strict=True))
    return max(both) * math.exp2(light.exposure)
