"""Parametric waves (Van Drasek et al. 2010, in Yingst et al. 2011). docs/formulae.md, section 2."""

import math

from seafoam.effects.contribution import (
    Bound,
    Constant,
    Contribution,
    Effect,
    Knob,
    Phase,
    SlotFile,
    array,
    significant,
)
from seafoam.effects.extremes import crest_limit, slope_sensitivity, surface_top
from seafoam.quality import Quality
from seafoam.scene.dispersion import angular_frequency, wavevector
from seafoam.scene.models import ParametricWave, Scene, Water

_HELD = 1e-4
"""|sin(θ/2 + π/4)| is held here in the derivative where K < 1/2, as the shader does."""


def _profile_slope(exponent: float, s: float, c: float) -> float:
    """d(u^K)/dθ with u = s², s = sin(θ/2 + π/4), c its cosine."""
    held = max(s, _HELD) if exponent < 0.5 else s
    return exponent * math.pow(held, 2.0 * exponent - 1.0) * c


def _steepest(exponent: float) -> float:
    """Greatest |d(u^K)/dθ|: at u = (K − ½)/K for K > ½, else at the trough, where it is held."""
    if exponent <= 0.5:
        return _profile_slope(exponent, _HELD, 1.0)
    u = (exponent - 0.5) / exponent
    return exponent * math.pow(u, exponent - 0.5) * math.sqrt(1.0 - u)


def _means(exponent: float) -> tuple[float, float]:
    """Means of (d(u^K)/dθ)² and of u^K over a period, by the midpoint rule, spectrally exact for a smooth wave."""
    count = 256
    angles = [(i + 0.5) * math.pi / (2 * count) for i in range(count)]
    square = sum(_profile_slope(exponent, math.sin(a), math.cos(a)) ** 2 for a in angles) / count
    return square, sum(math.sin(a) ** (2.0 * exponent) for a in angles) / count


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any parametric wave with height."""
    waves = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if not waves:
        return None
    data: list[Constant] = []
    phases: list[Phase] = []
    means: list[Constant] = []
    steepest = 0.0
    for wave in waves:
        kx, kz = wavevector(wave, scene.water.depth)
        k = math.hypot(kx, kz)
        data.append(Constant(value=(kx, kz, wave.amplitude, wave.exponent)))
        phases.append(Phase(offset=wave.phase, rate=angular_frequency(wave), k=(-kx, -kz)))
        square, level = _means(wave.exponent)
        means.append(
            Constant(value=(significant((k * wave.amplitude) ** 2 * square), significant(wave.amplitude * level)))
        )
        steepest += k * wave.amplitude * _steepest(wave.exponent)
    return Contribution(
        why=f"{len(waves)} parametric wave{'s' if len(waves) > 1 else ''} with height",
        slots=(SlotFile("waves", "waves/parametric.glsl", prefix="parametric"),),
        consts={"PARAMETRIC_COUNT": len(waves)},
        uniforms={
            "u_parametric": array("vec4", data, len(waves)),
            "u_parametric_phase": array("float", phases, len(waves)),
            "u_parametric_mean": array("vec2", means, len(waves)),
        },
        bound=_bound(scene, steepest),
        top=surface_top(scene),
        steepest=steepest,
    )


def _bound(scene: Scene, steepest: float) -> Bound | None:
    """Waves that nothing lies on (foam, ripples) show by their slopes and, over a floor, by their height alone."""
    ripples = scene.water.chop is not None and scene.light is not None
    if scene.foam is not None or ripples or scene.water.depth is not None:
        return None
    # A crest also moves the haze before it, by its share of the eye's height: a tenth for any camera above 10 m/m.
    if scene.light is None:
        return Bound(0.0, "nothing lies on them, and there is no light")
    return Bound(
        slope_sensitivity(scene) * steepest + 0.1 * surface_top(scene) + crest_limit(scene),
        f"slopes are never above {steepest:.1g}",
        ("/light/exposure", "/water/roughness", "/water/translucency", "/water/absorption_length"),
    )


EFFECT = Effect(
    "parametric waves",
    contribute,
    invisible=(
        Scene(waves=(ParametricWave(amplitude=1e-6, wavelength=10.0),), water=Water(translucency=0.0)),
        Scene(waves=(ParametricWave(),), light=None),
    ),
    knobs=(Knob("/waves", "waves kept", (2, 4, 8, 16), "geometry"),),
)
