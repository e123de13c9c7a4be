"""Parametric waves (Van Drasek et al. 2010, in Yingst et al. 2011), and their groups. docs/formulae.md, section 2."""

import math
from functools import lru_cache

from seafoam.effects.bounds import parametric_wave_height, unlit
from seafoam.effects.effect import UNBOUNDED, Contribution, Effect, QualityParameter, Resources
from seafoam.effects.shader import HASH, Const, Piece, SlotFile, Source, constant_function
from seafoam.framegraph.rules import Phase, Wrap, array, constants, number, rounded, significant, vector
from seafoam.ocean.basics.dispersion import angular_frequency, paper_level, wave_level, wavevector
from seafoam.ocean.waves.groups import PERIOD, group_cells, group_key, group_velocity, in_groups
from seafoam.ocean.waves.stokes import follows_orbits, orbit
from seafoam.quality import Quality
from seafoam.scene import FrontSaturation, Scene, SlopeSaturation
from seafoam.sums import summed

PLACE = "u_wave_groups_place"
"""Uniform of the camera's place in the noise."""
FACTOR = (HASH, "waves/groups.glsl@factor")
"""Files of the factor, for what evaluates waves itself."""
SLOPE, CURVATURE, VARIANCE = 1.5, 6.0, 0.091973
"""Of the noise: greatest slope and second derivative along any line, in cells; variance, (1/6)(26/35)²."""
_WAVES = "waves/parametric.glsl"
_EVEN_WAVES = Source(_WAVES, (("parametric_waves", "even_waves"), ("parametric_shading", "even_shading")))
"""The waves if all have one height, under other names."""
_EVEN = {
    "waves/groups.glsl@fronts": ("fronts_then", "even_fronts"),
    "waves/groups.glsl@carry": ("parametric_carry", "even_carry"),
    "waves/groups.glsl@signal": ("front_signal", "even_signal"),
    "waves/groups.glsl@way": ("front_way", "even_way"),
}
"""Functions that a file scales, and their names before."""
_NO_GROUPS = constant_function("float", "front_group", "vec2 q, float ago", "1.0")
_MIN_SINE = 1e-4
"""Minimum of |sin(θ/2 + π/4)| in the derivative for K < 1/2, as in the shader."""
_MIN_SHARED_HEIGHT = 1e-30
"""Height of the waves, m, below which fronts compute their own phases: 1/height would overflow."""
_MAX_DOUBLED_EXPONENT = 33
"""Greatest 2K for which the shader computes the power as a product."""


def group_part(scene: Scene) -> Resources:
    """What places the groups, for programs with :data:`FACTOR`; empty without groups."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return Resources()
    along, (v_x, v_z) = group_cells(scene, groups), group_velocity(scene)
    across = (-along[1], along[0])
    place = (Wrap(k=(k_x, k_z), period=float(PERIOD), rate=-(k_x * v_x + k_z * v_z)) for k_x, k_z in (along, across))
    consts: dict[str, Const] = {"GROUP_KEY": group_key(groups.seed), "GROUP_PERIOD": PERIOD, "GROUP_VARIANCE": VARIANCE}
    shape = vector((*along, groups.contrast))
    return Resources(consts=consts, uniforms={PLACE: array("vec2", place, 1), "u_wave_groups": shape})


def wave_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the parametric waves: of one height each, or in groups."""
    if not in_groups(scene):
        return (_WAVES,)
    return (*FACTOR, _EVEN_WAVES, "waves/groups.glsl@waves")


def earlier_wave_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the parametric waves of an earlier time."""
    waves = (*FACTOR, _EVEN_WAVES) if in_groups(scene) else (_WAVES,)
    return (*waves, *scaled_files(scene, "spray/births.glsl@fronts", "waves/groups.glsl@fronts"))


def scaled_files(scene: Scene, path: str, scaled: str) -> tuple[Piece, ...]:
    """Files of what is proportional to the waves' heights: ``path``, which has it if all have one height.

    In groups, its function has another name, and ``scaled`` scales it by the factor: the fronts of an earlier time; the
    way to where the waves' water rests; the sum of a front's own waves, and the way to where the water rests by these.
    """
    return (*FACTOR, Source(path, (_EVEN[scaled],)), scaled) if in_groups(scene) else (path,)


def front_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the factor of waves that passed before."""
    return (*FACTOR, "waves/groups.glsl@front") if in_groups(scene) else (_NO_GROUPS,)


def group_bounds(scene: Scene) -> tuple[float, float]:
    """Return upper bounds of the factor's slope and second derivative along any line, 1/m and 1/m²."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return 0.0, 0.0
    step = 1.000001 * math.hypot(*group_cells(scene, groups))
    return groups.contrast * SLOPE * step, groups.contrast * CURVATURE * step * step


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


@lru_cache(maxsize=64)
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
    height, (group_slope, group_curvature) = parametric_wave_height(scene), group_bounds(scene)
    # Of the product of the waves, which are at most their height from still water, and their factor.
    max_curvature += 2.0 * max_slope * group_slope + height * group_curvature
    max_slope += height * group_slope
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
        bound=unlit(scene),
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
)
