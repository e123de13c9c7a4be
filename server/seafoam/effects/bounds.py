"""Upper bounds of parts of a scene at any place and time, from which the effects' bounds are derived; and passes that
measure those of waves in a map in each frame, docs/formulae.md, section 3.
"""

import math

from seafoam.effects.effect import Bound, PassSpec, Resources, drawn_map
from seafoam.effects.light.atmosphere import lamp_angles
from seafoam.effects.light.light import brightest_sun, sky_irradiance
from seafoam.effects.registry import saturation_limits
from seafoam.effects.shader import Inline
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import number
from seafoam.ocean.basics.dispersion import paper_level
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.ocean.waves.rings import ring_height
from seafoam.ocean.waves.wakes import joint_height, stone_wakes, wakes
from seafoam.scene import Foam, Light, Scene
from seafoam.sums import summed

SATURATION_CAP = 4.0
"""Upper limit of the saturation: all looks are the same above it (docs/formulae.md, section 4)."""
FOAM_ASYMMETRY = 0.75
"""Asymmetry parameter g of the Henyey-Greenstein phase function of light that foam scatters once."""
FORWARD_PEAK = (1.0 + FOAM_ASYMMETRY) / (4.0 * math.pi * (1.0 - FOAM_ASYMMETRY) ** 2)
"""Greatest value of that phase function, straight ahead, 1/sr."""
FLOOR_FIELDS = ("/light/exposure", "/water/absorption_length", "/water/scattering")
"""Fields that :func:`floor_limit` depends on and that can change without a new plan."""
BLOCK = 16
"""Side of the blocks whose maxima are found first, texels."""


def parametric_wave_height(scene: Scene) -> float:
    """Return the height of the parametric waves from trough to crest, m, where all crests coincide."""
    return summed(wave.amplitude for wave in scene.waves)


def max_surface_height(scene: Scene) -> float:
    """Return the greatest height of the surface over still water, m, where all crests coincide."""
    height = parametric_wave_height(scene) - paper_level(scene) + _amplitude(scene)
    return height if scene.shore is None else height + scene.shore.surf.height


def min_surface_height(scene: Scene) -> float:
    """Return the lowest height of the surface over still water, m, at most 0, where all troughs coincide."""
    return -(paper_level(scene) + _amplitude(scene))


def max_displacement(scene: Scene) -> float:
    """Greatest distance of the surface from still water, above or below, m."""
    return max(max_surface_height(scene), -min_surface_height(scene))


def _amplitude(scene: Scene) -> float:
    """Return the greatest amplitude of waves that are symmetric about still water: rings, wakes and open sea; m."""
    amplitude = ring_height(scene) + joint_height(wakes(scene.boats)) + joint_height(stone_wakes(scene.current))
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        amplitude += summed(tile.limit for tile in cascades(scene.sea, scene.water.depth)[:RAISED])
    return amplitude


def greatest_saturation(foam: Foam, scene: Scene) -> float:
    limits = saturation_limits(scene)
    if foam.combine == "max":
        return max(limits)
    return min(math.prod(limits), SATURATION_CAP)


def slope_sensitivity(scene: Scene) -> float:
    """Return the greatest change of a pixel per unit of surface slope, display white = 1.

    Glitter L below white changes by at most L·2t/σ² per unit, where t is the tangent of the facet's tilt, and is below
    white only for t < σ√(ln(peak)) ≤ 3.7 σ: 7.4/σ, with σ at least the water's roughness. Sky, Fresnel reflectance and
    body of the water change less: together by at most 30 at any exposure at which the sky is not white.
    """
    if scene.light is None:
        return 0.0
    return (7.4 / scene.water.roughness + 30.0) * max(1.0, math.exp2(scene.light.exposure))


def waves_bound(scene: Scene, max_slope: float, height: float) -> Bound | None:
    """Bound of waves of this slope and height from trough to crest, m; ``None`` where other things show them.

    Foam, ripples, spray, boats and a floor move with the waves or are seen through them. Without these, waves show by
    their slope, by light through their crests, and by the haze before them: a crest changes it by its share of the
    camera's height, at most a tenth per metre.
    """
    ripples = scene.water.ripples is not None and scene.light is not None
    floor = scene.water.depth is not None or scene.shore is not None
    if scene.foam is not None or scene.spray is not None or scene.boats or ripples or floor:
        return None
    if scene.light is None:
        return Bound(0.0, "the scene has no light, and nothing floats on the waves")
    return Bound(
        slope_sensitivity(scene) * max_slope + 0.1 * height + crest_limit(scene),
        f"the greatest slope is {max_slope:.1g}",
        ("/light/exposure", "/water/roughness", "/water/translucency", "/water/absorption_length"),
    )


def crest_limit(scene: Scene) -> float:
    """Return the greatest radiance of sunlight through a crest, display white = 1."""
    light, water = scene.light, scene.water
    if light is None or max_surface_height(scene) == 0.0:
        return 0.0
    transmitted = (
        water.translucency / math.pi * sun * math.exp(-6.0 / length) * math.cos(lamp_angles(light)[1])
        for sun, length in zip(brightest_sun(light), water.absorption_length, strict=True)
    )
    return float(max(transmitted)) * math.exp2(light.exposure)


def body_limit(scene: Scene) -> float:
    """Return the greatest radiance from within the water, scattered or from a white floor, display white = 1."""
    return 0.0 if scene.light is None else 0.95 / math.pi * _brightest_irradiance(scene.light)


def floor_limit(scene: Scene, light: Light, depth: float, *, sky: bool = True) -> float:
    """Brightest light that comes back from a floor of reflectance 1, ``depth`` m down, display white = 1.

    ``sky``: of sun and sky; else of the sun alone. The shortest way down and back is straight; an eye under water may
    lie on the floor.
    """
    water = scene.water
    ways = 1.0 if water.view_below else 2.0
    most = 0.0
    for sun, air, length in zip(brightest_sun(light), sky_irradiance(light), water.absorption_length, strict=True):
        passed = math.exp(-ways * depth * (1.0 / length + water.scattering))
        most = max(most, passed * 0.95 * (sun + air if sky else sun) / math.pi * 2.0**light.exposure)
    return most


def foam_limit(foam: Foam, scene: Scene) -> float:
    """Return the greatest radiance of foam, display white = 1; at least 1."""
    if scene.light is None:
        return 1.0
    layer = foam.scattering
    # The lumps' mean cosine is at most this, and the lobe is greatest straight ahead.
    lobe = 0.0 if layer is None else layer.forward * FORWARD_PEAK
    lumps = 1.0 if layer is None else 0.5 + 0.5 * math.sqrt(1.0 + 2.0 / math.pi * layer.roughness**2)
    return max(foam.albedo * (lumps / math.pi + lobe) * _brightest_irradiance(scene.light), 1.0)


def _brightest_irradiance(light: Light) -> float:
    """Exposed irradiance of overhead sun and whole sky, the brightest channel."""
    return float(max(brightest_sun(light) + sky_irradiance(light))) * math.exp2(light.exposure)


def measured_bounds(source: str, size: int, texel: float, stride: int = 1) -> Resources:
    """Targets and passes of a map's bounds. ``SOURCE_bounds`` holds height (m), slope and second derivative (1/m).

    ``source``: a target of ``size``² texels of ``texel`` m that holds height and the slopes along x and z; ``size`` is
    a multiple of :data:`BLOCK`. ``stride``: only every so many texels along each side are read; the shortest wave must
    be at least four times as long.
    """
    blocks, bounds = f"{source}_blocks", f"{source}_bounds"
    sizes = Inline(f"const int BOUNDS_BLOCK = {BLOCK};\nconst int BOUNDS_STRIDE = {stride};\n")
    files, texels = (sizes, "surface/bounds.glsl@pass"), {"u_bounded_texel": number(texel)}
    name = f"{source}, greatest of blocks"
    of_blocks = PassSpec(name, f"bounds_{stride}", files, {"u_bounded": source}, texels, target=blocks)
    join = ("surface/bounds.glsl@join",)
    of_all = PassSpec(f"{source}, greatest of all", "bounds_join", join, {"u_blocks": blocks}, target=bounds)
    return drawn_map(of_blocks, Target(size=FixedSize.square(-(-size // BLOCK)), format="RGBA16F")).joined(
        drawn_map(of_all, Target(size=FixedSize.square(1), format="RGBA16F"))
    )
