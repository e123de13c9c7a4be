"""Parametric waves (Van Drasek et al. 2010, in Yingst et al. 2011). docs/formulae.md, section 2."""

import math

from seafoam.effects.bounds import crest_limit, slope_sensitivity, waves_top
from seafoam.effects.effect import UNBOUNDED, Bound, Contribution, Effect, HardCase, Knob, SlotFile
from seafoam.effects.foam.living import carries
from seafoam.framegraph.rules import Constant, Phase, array, number, significant
from seafoam.ocean.dispersion import angular_frequency, wavevector
from seafoam.ocean.levels import paper_level, wave_level
from seafoam.ocean.stokes import orbit
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Chop,
    Foam,
    FrontSaturation,
    ParametricWave,
    Scene,
    SlopeSaturation,
    Water,
)

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


def steepest_profile(exponent: float) -> float:
    """Greatest |d(u^K)/dθ|: at u = (K − ½)/K for K > ½, else at the trough, where it is held."""
    if exponent <= 0.5:
        return _profile_slope(exponent, _HELD, 1.0)
    u = (exponent - 0.5) / exponent
    return exponent * math.pow(u, exponent - 0.5) * math.sqrt(1.0 - u)


def sharpest_profile(exponent: float) -> float:
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
    like = any(one.constants == "text" for one in fronts) and waves_top(scene) >= _LEAST_SHARED
    return like and shares_place(scene)


def shares_place(scene: Scene) -> bool:
    """Whether the place that was shaded last is still the sample's own when its foam is asked for."""
    slopes = scene.foam is not None and any(isinstance(one, SlopeSaturation) for one in scene.foam.saturation)
    return not slopes and scene.shore is None


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
        steepest += k * wave.amplitude * steepest_profile(wave.exponent)
        curvature += k * k * wave.amplitude * sharpest_profile(wave.exponent)
    level = paper_level(scene)
    shared = shares_place(scene)
    carry: tuple[SlotFile, ...] = ()
    if carries(scene):
        name = "parametric_shared" if shared else "parametric"
        carry = (SlotFile("carry", f"carry/{name}.glsl", prefix="parametric"),)
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
        bound=_bound(scene, steepest),
        top=waves_top(scene) - level,
        trough=-level,
        steepest=steepest,
        curvature=min(significant(curvature), UNBOUNDED),
    )


def _bound(scene: Scene, steepest: float) -> Bound | None:
    """Waves that nothing lies on (foam, ripples) show by their slopes and, over a floor, by their height alone."""
    ripples = scene.water.chop is not None and scene.light is not None
    lying = scene.foam is not None or ripples or scene.spray is not None or scene.boats
    if lying or scene.water.depth is not None or scene.shore is not None:
        return None
    # A crest also moves the haze before it, by its share of the eye's height: a tenth for any camera above 10 m/m.
    if scene.light is None:
        return Bound(0.0, "nothing lies on them, and there is no light")
    return Bound(
        slope_sensitivity(scene) * steepest + 0.1 * waves_top(scene) + crest_limit(scene),
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
    hard_cases=(
        HardCase(
            name="a cusp in every trough, K 0.1",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.4, wavelength=3.0, exponent=0.1),), foam=Foam(look="halftone")
            ),
            guard="|p| held at 1e-4 in the derivative (waves/parametric.glsl)",
            without="slope 60 225 instead of 158 next to a trough, infinite on it where pow(0, -0.8) is; the "
            "frame moved by 0.001 levels",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="0^K, K 100, and kinks, K 0.5 and 0.7",
            scene=Scene(
                waves=tuple(
                    ParametricWave(amplitude=0.3, wavelength=4.0 + k / 50.0, exponent=k, direction=0.06 * k)
                    for k in (0.5, 0.7, 100.0)
                ),
                foam=Foam(look="textured"),
            ),
            guard="powers of |p| = sqrt(u) held at 1e-30, height and slope from one power (waves/parametric.glsl)",
            without="nothing on llvmpipe, whose pow(0, x) is 0; GLSL leaves it undefined",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="any time, waves of 5 cm",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.005, wavelength=0.05), ParametricWave()), foam=Foam(look="halftone")
            ),
            guard="phases reduced in float64 (framegraph/evaluation.py)",
            without="in float32: 63 % of samples flipped, 158 levels off in the mean",
            times=(-1e9, 0.0, 1e9, 1e9 + 1e-6),
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="ten thousand kilometres from the origin",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.005, wavelength=0.05), ParametricWave()), foam=Foam(look="halftone")
            ),
            guard="the eye is the origin: places reduced in float64 (framegraph/evaluation.py)",
            without="in float32: 25 % of samples flipped, 87 levels off in the mean",
            camera=Camera(position=(1e7, 3.0, -1e7), pitch=-math.pi / 2),
        ),
        HardCase(
            name="opposite waves that cancel",
            scene=Scene(
                waves=(ParametricWave(), ParametricWave(direction=math.pi), ParametricWave(phase=math.pi)),
                foam=Foam(saturation=(FrontSaturation(group=(0.1, 0.4)),), look="halftone"),
            ),
            guard="sums of float32 phases alone: nothing divides by the sum; the gate closes where it is "
            "noise (saturation/front_gate.glsl)",
            without="foam from the rounding of sums that are 0: 1.2 % of samples flipped",
            times=(0.0, 1.3863),
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="sixteen equal waves",
            scene=Scene(waves=(ParametricWave(amplitude=0.06, wavelength=9.0),) * 16, foam=Foam(look="fading")),
            guard="the march's slope bound is the sum of all waves' (effects/waves/parametric.py, surface/march.glsl)",
            without="bound of one wave alone: the march passes crests, 21 % of samples off by more than 2 levels",
            times=(0.0, 1e9),
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="a wall of water, 50 m high and 5 cm long",
            scene=Scene(waves=(ParametricWave(amplitude=50.0, wavelength=0.05, exponent=4.0),), foam=Foam()),
            guard="N.D held at -1e-3 |N||D| in the footprint (common/camera.glsl)",
            without="footprint NaN and infinite where N.D = 0; in the frame one sample in 500 off by up to 215 levels",
            camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.6),
        ),
        HardCase(
            name="as good as flat",
            scene=Scene(
                waves=(ParametricWave(amplitude=1e-30), ParametricWave(amplitude=0.0)),
                foam=Foam(look="halftone"),
                water=Water(chop=Chop()),
            ),
            guard="steps divided by at least 1e-6 |D| (surface/march.glsl)",
            without="nothing on llvmpipe: the march ends by its tolerance; a ray along flat water would divide 0 by 0",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="two kilometres long in 5 cm of water",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=0.02, wavelength=2000.0),
                    ParametricWave(amplitude=50.0, wavelength=2000.0, speed=200.0),
                ),
                foam=Foam(look="textured"),
                water=Water(depth=0.05),
            ),
            guard="dispersion by Newton from Eckart's estimate, in float64 (ocean/dispersion.py)",
            without="from the deep-water wavenumber: the same root after 12 steps instead of 3",
            camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.3),
        ),
        HardCase(
            name="a grazing ray over steep crests",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=1.0, wavelength=5.0, exponent=8.0),
                    ParametricWave(amplitude=0.6, wavelength=3.1, direction=0.7, exponent=6.0),
                ),
                foam=Foam(look="halftone"),
            ),
            guard="a Newton step only where the gap closes by more than 1e-3, and no longer than the "
            "march's last gap allows (surface/march.glsl, newton.glsl)",
            without="one sample in 5000 off by 46 levels",
            times=(0.0, 2.7),
            camera=Camera(position=(0.0, 1.29, 0.0), yaw=1.571, pitch=0.0),
        ),
        HardCase(
            name="rays that double back on the mesh",
            scene=Scene(waves=(ParametricWave(amplitude=3.0, wavelength=8.0, exponent=8.0),), foam=Foam()),
            guard="Newton steps of a twentieth of the way at most, and only downhill (surface/newton.glsl)",
            without="1.8 % of samples off by more than 2 levels, the worst by 221",
            camera=Camera(position=(0.0, 4.0, 0.0), yaw=1.571, pitch=-0.2),
        ),
        HardCase(
            name="eye inside a crest",
            scene=Scene(waves=(ParametricWave(amplitude=1.0, wavelength=6.0, phase=math.pi / 2),), foam=Foam()),
            guard="the way never turns negative (surface/march.glsl)",
            without="26 % of samples off by more than 2 levels: places behind the eye",
            camera=Camera(position=(0.0, 0.025, 0.0), pitch=-0.2),
        ),
        HardCase(
            name="eye far below the water",
            scene=Scene(waves=(ParametricWave(),), foam=Foam(), water=Water(chop=Chop())),
            guard="the exit never lies behind the eye (surface/march.glsl)",
            without="infinite in 0.14 % of samples, negative in 0.29 %",
            camera=Camera(position=(0.0, -1000.0, 0.0), pitch=0.4),
        ),
    ),
)
