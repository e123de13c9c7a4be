"""Parametric waves (Van Drasek et al. 2010, in Yingst et al. 2011). docs/formulae.md, section 2."""

import math

from seafoam.effects.bounds import parametric_wave_height, waves_bound
from seafoam.effects.effect import UNBOUNDED, Contribution, Effect, QualityParameter
from seafoam.effects.foam.living import follows_orbits
from seafoam.effects.shader import SlotFile
from seafoam.effects.waves.groups import PLACE, group_bounds, group_part, scaled_files, wave_files
from seafoam.framegraph.rules import Phase, array, constants, number, rounded, significant
from seafoam.ocean.basics.dispersion import angular_frequency, wavevector
from seafoam.ocean.basics.levels import paper_level, wave_level
from seafoam.ocean.waves.groups import in_groups
from seafoam.ocean.waves.stokes import orbit
from seafoam.quality import Quality
from seafoam.scene.foam import FrontSaturation, SlopeSaturation
from seafoam.scene.models import Scene
from seafoam.sums import summed

_MIN_SINE = 1e-4
"""Minimum of |sin(θ/2 + π/4)| in the derivative for K < 1/2, as in the shader."""


_MIN_SHARED_HEIGHT = 1e-30
"""Height of the waves, m, below which fronts compute their own phases: 1/height would overflow."""

_MAX_DOUBLED_EXPONENT = 33
"""Greatest 2K for which the shader computes the power as a product."""


def _profile_slope(exponent: float, s: float, c: float) -> float:
    """d(u^K)/dθ with u = s², s = sin(θ/2 + π/4), c its cosine."""
    sine = max(s, _MIN_SINE) if exponent < 0.5 else s
    return exponent * math.pow(sine, 2.0 * exponent - 1.0) * c


def max_profile_slope(exponent: float) -> float:
    """Return the greatest |d(u^K)/dθ|: at u = (K − ½)/K for K > ½, otherwise in the trough, where s is limited."""
    if exponent <= 0.5:
        return _profile_slope(exponent, _MIN_SINE, 1.0)
    u = (exponent - 0.5) / exponent
    return exponent * math.pow(u, exponent - 0.5) * math.sqrt(1.0 - u)


def max_profile_curvature(exponent: float) -> float:
    """Return the maximum of d²(u^K)/dθ² = K u^(K−1) (K − ½ − K u), at u = (K − 1)(K − ½)/K²; unbounded for K < 1."""
    if exponent < 1.0:
        return UNBOUNDED
    u = (exponent - 1.0) * (exponent - 0.5) / exponent**2
    return (exponent - 0.5) * math.pow(u, exponent - 1.0)


def profile_square(exponent: float) -> float:
    """Return the mean of (d(u^K)/dθ)² over a period, by the midpoint rule (spectrally accurate)."""
    count = 256
    angles = [(i + 0.5) * math.pi / (2 * count) for i in range(count)]
    return summed(_profile_slope(exponent, math.sin(a), math.cos(a)) ** 2 for a in angles) / count


def _kind(exponent: float) -> int:
    """2K if the shader computes u^K as a product, otherwise 0."""
    doubled = 2.0 * exponent
    return int(doubled) if doubled <= _MAX_DOUBLED_EXPONENT and doubled == int(doubled) else 0


def shares_phase(scene: Scene) -> bool:
    """Whether fronts reuse the phases that the waves computed when the surface was last shaded.

    With δ = π/2 these are the fronts' phases. Slope saturation shades other points in between, and a shore changes
    the waves.
    """
    front = None if scene.foam is None else scene.foam.source(FrontSaturation)
    same = front is not None and front.constants == "text" and parametric_wave_height(scene) >= _MIN_SHARED_HEIGHT
    return same and scene.shore is None and shares_place(scene)


def shares_place(scene: Scene) -> bool:
    """Whether the point that was shaded last is still the sample's own when its foam is computed."""
    return scene.foam is None or scene.foam.source(SlopeSaturation) is None


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if any parametric wave has height."""
    waves = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if not waves:
        return None
    kinds = tuple(_kind(wave.exponent) for wave in waves)
    data: list[tuple[float, ...]] = []
    phases: list[Phase] = []
    means: list[tuple[float, ...]] = []
    max_slope = max_curvature = 0.0
    for wave in waves:
        kx, kz = wavevector(wave, scene.water.depth)
        k = math.hypot(kx, kz)
        data.append((kx, kz, wave.amplitude, wave.exponent))
        phases.append(Phase(offset=wave.phase, rate=angular_frequency(wave), k=(-kx, -kz)))
        orbit_factor = orbit(wave, scene.water.depth) / k if follows_orbits(scene) else 0.0
        values = ((k * wave.amplitude) ** 2 * profile_square(wave.exponent), wave_level(wave), orbit_factor)
        means.append(rounded(values))
        max_slope += k * wave.amplitude * max_profile_slope(wave.exponent)
        max_curvature += k * k * wave.amplitude * max_profile_curvature(wave.exponent)
    level = paper_level(scene)
    shared = shares_place(scene)
    orbits: tuple[SlotFile, ...] = ()
    if follows_orbits(scene):
        own = scaled_files(scene, "foam/carry.glsl@parametric", "waves/groups.glsl@carry")
        *orbit_needs, path = ("foam/carry.glsl@parametric_shared",) if shared else own
        orbits = (SlotFile("carry", path, prefix="parametric", needs=tuple(orbit_needs)),)
    *needs, path = wave_files(scene)
    height, groups = parametric_wave_height(scene), group_bounds(scene)
    # Of the product of the waves, which are at most their height from still water, and their factor.
    max_curvature += 2.0 * max_slope * groups.slope + height * groups.curvature
    max_slope += height * groups.slope
    contribution = Contribution(
        why=f"{len(waves)} parametric wave{'s' if len(waves) > 1 else ''} with height"
        f"{', in groups' if in_groups(scene) else ''}",
        slots=(SlotFile("waves", path, prefix="parametric", needs=tuple(needs)), *orbits),
        consts={
            "PARAMETRIC_COUNT": len(waves),
            "PARAMETRIC_KIND": kinds,
            "PARAMETRIC_ALIKE": len(set(kinds)) == 1,
            "PARAMETRIC_SIGNAL": shares_phase(scene),
            "PARAMETRIC_CARRIES": shared and follows_orbits(scene),
        },
        uniforms={
            "u_parametric": constants("vec4", data),
            "u_parametric_phase": array("float", phases, len(waves)),
            "u_parametric_mean": constants("vec3", means),
            "u_parametric_level": number(significant(level)),
        },
        bound=waves_bound(scene, max_slope, height),
        max_height=height - level,
        min_height=-level,
        max_slope=max_slope,
        max_curvature=min(significant(max_curvature), UNBOUNDED),
    )
    return contribution.joined(group_part(scene))


EFFECT = Effect(
    "parametric waves",
    contribute,
    fields=("/waves", "/wave_groups"),
    afloat=("u_parametric_phase", PLACE),
    parameters=(QualityParameter("/waves", "maximum number of waves", (2, 4, 8, 16), "geometry"),),
    without=lambda scene: scene.model_copy(update={"waves": ()}),
)
