"""Parametric waves (Van Drasek et al. 2010, in Yingst et al. 2011). docs/formulae.md, section 2."""

import math

from seafoam.effects.bounds import parametric_wave_height, waves_bound
from seafoam.effects.effect import UNBOUNDED, Contribution, Effect, Knob, SlotFile
from seafoam.effects.foam.living import carries
from seafoam.framegraph.rules import Constant, Phase, array, number, significant
from seafoam.ocean.dispersion import angular_frequency, wavevector
from seafoam.ocean.levels import paper_level, wave_level
from seafoam.ocean.stokes import orbit
from seafoam.quality import Quality
from seafoam.scene.foam import FrontSaturation, SlopeSaturation
from seafoam.scene.models import Scene

_HELD = 1e-4
"""|sin(θ/2 + π/4)| is held here in the derivative where K < 1/2, as the shader does."""


_LEAST_SHARED = 1e-30
"""Fronts of lower waves, m, have phases of their own: 1 over their height would overflow."""

_MOST_TWICE = 33
"""Greatest 2K whose power the shader multiplies out."""


def _profile_slope(exponent: float, s: float, c: float) -> float:
    """d(u^K)/dθ with u = s², s = sin(θ/2 + π/4), c its cosine."""
    held = max(s, _HELD) if exponent < 0.5 else s
    return exponent * math.pow(held, 2.0 * exponent - 1.0) * c


def max_profile_slope(exponent: float) -> float:
    """Greatest |d(u^K)/dθ|: at u = (K − ½)/K for K > ½, else at the trough, where it is held."""
    if exponent <= 0.5:
        return _profile_slope(exponent, _HELD, 1.0)
    u = (exponent - 0.5) / exponent
    return exponent * math.pow(u, exponent - 0.5) * math.sqrt(1.0 - u)


def max_profile_curvature(exponent: float) -> float:
    """Greatest d²(u^K)/dθ² = K u^(K−1) (K − ½ − K u), at u = (K − 1)(K − ½)/K² for K ≥ 1; below 1 there is none."""
    if exponent < 1.0:
        return UNBOUNDED
    u = (exponent - 1.0) * (exponent - 0.5) / exponent**2
    return (exponent - 0.5) * math.pow(u, exponent - 1.0)


def profile_square(exponent: float) -> float:
    """Mean of (d(u^K)/dθ)² over a period, by the midpoint rule, spectrally exact for a smooth wave."""
    count = 256
    angles = [(i + 0.5) * math.pi / (2 * count) for i in range(count)]
    return sum(_profile_slope(exponent, math.sin(a), math.cos(a)) ** 2 for a in angles) / count


def _kind(exponent: float) -> int:
    """How the shader raises u to K: 2K where that is a product, else 0."""
    twice = 2.0 * exponent
    return int(twice) if twice <= _MOST_TWICE and twice == int(twice) else 0


def shares_phase(scene: Scene) -> bool:
    """Whether fronts read the waves' own phases, left where the surface was last shaded.

    Where δ is π/2 they are the same. Foam by slope shades other places in between, and a shore other waves.
    """
    fronts = () if scene.foam is None else (one for one in scene.foam.saturation if isinstance(one, FrontSaturation))
    like = any(one.constants == "text" for one in fronts) and parametric_wave_height(scene) >= _LEAST_SHARED
    return like and scene.shore is None and shares_place(scene)


def shares_place(scene: Scene) -> bool:
    """Whether the place that was shaded last is still the sample's own when its foam is asked for."""
    return scene.foam is None or not any(isinstance(one, SlopeSaturation) for one in scene.foam.saturation)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any parametric wave with height."""
    waves = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if not waves:
        return None
    kinds = tuple(_kind(wave.exponent) for wave in waves)
    data: list[Constant] = []
    phases: list[Phase] = []
    means: list[Constant] = []
    steepest = curvature = 0.0
    for wave in waves:
        kx, kz = wavevector(wave, scene.water.depth)
        k = math.hypot(kx, kz)
        data.append(Constant(value=(kx, kz, wave.amplitude, wave.exponent)))
        phases.append(Phase(offset=wave.phase, rate=angular_frequency(wave), k=(-kx, -kz)))
        square = profile_square(wave.exponent)
        reach = orbit(wave, scene.water.depth) / k if carries(scene) else 0.0
        values = ((k * wave.amplitude) ** 2 * square, wave_level(wave), reach)
        means.append(Constant(value=tuple(significant(value) for value in values)))
        steepest += k * wave.amplitude * max_profile_slope(wave.exponent)
        curvature += k * k * wave.amplitude * max_profile_curvature(wave.exponent)
    level = paper_level(scene)
    shared = shares_place(scene)
    carry: tuple[SlotFile, ...] = ()
    if carries(scene):
        name = "parametric_shared" if shared else "parametric"
        carry = (SlotFile("carry", f"foam/carry/{name}.glsl", prefix="parametric"),)
    return Contribution(
        why=f"{len(waves)} parametric wave{'s' if len(waves) > 1 else ''} with height",
        slots=(SlotFile("waves", "waves/parametric.glsl", prefix="parametric"), *carry),
        consts={
            "PARAMETRIC_COUNT": len(waves),
            "PARAMETRIC_KIND": kinds,
            "PARAMETRIC_ALIKE": len(set(kinds)) == 1,
            "PARAMETRIC_SIGNAL": shares_phase(scene),
            "PARAMETRIC_CARRIES": shared and carries(scene),
        },
        uniforms={
            "u_parametric": array("vec4", data, len(waves)),
            "u_parametric_phase": array("float", phases, len(waves)),
            "u_parametric_mean": array("vec3", means, len(waves)),
            "u_parametric_level": number(significant(level)),
        },
        bound=waves_bound(scene, steepest, parametric_wave_height(scene)),
        max_height=parametric_wave_height(scene) - level,
        min_height=-level,
        max_slope=steepest,
        max_curvature=min(significant(curvature), UNBOUNDED),
    )


EFFECT = Effect(
    "parametric waves",
    contribute,
    knobs=(Knob("/waves", "maximum number of waves", (2, 4, 8, 16), "geometry"),),
)
