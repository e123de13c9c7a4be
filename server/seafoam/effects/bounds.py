"""Upper bounds of parts of a scene at any place and time, from which the effects' bounds are derived; and passes that
measure those of waves in a map in each frame, docs/formulae.md, section 3.
"""

import math

from seafoam.effects.effect import Bound, PassSpec, Resources, drawn_map
from seafoam.effects.light.light import brightest_sun, sky_irradiance
from seafoam.effects.registry import saturation_fields, saturation_limits
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
FLOOR_FIELDS = ("/light/exposure", "/water/absorption_length", "/water/scattering")
"""Fields that :func:`floor_limit` depends on and that can change without a new plan."""
BLOCK = 16
"""Side of the blocks whose maxima are found first, texels."""
ACROSS = 128
"""Blocks beside one another, at most: rasterizers on processors give squares of 64 pixels to one thread each."""


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


def unlit(scene: Scene) -> Bound | None:
    """Bound of waves without light on them, or things that float on them or are seen through them."""
    shown = scene.light or scene.foam or scene.spray or scene.boats or scene.shore or scene.water.depth is not None
    return Bound.zero_if(not shown, "the scene has no light, and nothing floats on the waves")


def no_foam(foam: Foam, scene: Scene) -> Bound | None:
    """Bound of foam, and of what is seen by it, where there is none."""
    most = greatest_saturation(foam, scene)
    plunges = scene.breaker is not None and scene.breaker.height > 0.0
    return Bound.zero_if(most == 0.0 and not plunges, "the saturation is 0 everywhere", saturation_fields(scene))


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


def measured_bounds(source: str, size: int, texel: float, stride: int = 1) -> Resources:
    """Targets and passes of a map's bounds. ``SOURCE_bounds`` holds height (m), slope and second derivative (1/m).

    ``source``: a target of ``size``² texels of ``texel`` m that holds height and the slopes along x and z; ``size`` is
    a power of 2, at least :data:`BLOCK`. ``stride``: only every so many texels along each side are read, 1 or 2; the
    shortest wave must be at least four times as long.
    """
    blocks, bounds = f"{source}_blocks", f"{source}_bounds"
    if size < BLOCK or size & (size - 1):
        raise ValueError(f"size {size}: a power of 2, at least {BLOCK}, is measured")
    across = min(ACROSS, size // 2)
    down = max((size // BLOCK) ** 2 // across, 1)
    block = f"const ivec2 BOUNDS_BLOCK = ivec2({size // across}, {size // down});\n"
    sizes = Inline(f"{block}const int BOUNDS_STRIDE = {stride};\n")
    files, texels = (sizes, "surface/bounds.glsl@pass"), {"u_bounded_texel": number(texel)}
    name = f"{source}, greatest of blocks"
    of_blocks = PassSpec(name, f"bounds_{size}_{stride}", files, {"u_bounded": source}, texels, target=blocks)
    join = ("surface/bounds.glsl@join",)
    of_all = PassSpec(f"{source}, greatest of all", "bounds_join", join, {"u_blocks": blocks}, target=bounds)
    whole = drawn_map(of_all, Target(size=FixedSize.square(1), format="RGBA16F"))
    return drawn_map(of_blocks, Target(size=FixedSize(width=across, height=down), format="RGBA16F")).joined(whole)
