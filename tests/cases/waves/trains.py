"""Test scenes of parametric waves and of the open sea: hard cases, and scenes that cannot show them."""

import math

from seafoam.scene.foam import Foam, FoamLife, FrontSaturation, SlopeSaturation
from seafoam.scene.waves import ParametricWave, Sea, WaveGroups
from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, Ripples, Scene, Spray, Water

_INVISIBLE_PARAMETRIC = (Scene(waves=(ParametricWave(),), light=None),)

_HARD_PARAMETRIC = (
    reduced(
        "any time, waves of 5 cm",
        Scene(waves=(ParametricWave(amplitude=0.005, wavelength=0.05), ParametricWave()), foam=Foam(look="halftone")),
        "phases",
        Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        times=(-1e9, 0.0, 1e9, 1e9 + 1e-6),
    ),
    HardCase(
        "opposite waves that cancel",
        Scene(
            waves=(ParametricWave(), ParametricWave(direction=math.pi), ParametricWave(phase=math.pi)),
            foam=Foam(saturation=(FrontSaturation(group=(0.1, 0.4)),), look="halftone"),
        ),
        guard="nothing is divided by the sum of the waves, and the group threshold suppresses foam where the sum "
        "is rounding noise (foam/saturation/front.glsl@gate)",
        times=(0.0, 1.3863),
        without={
            "foam/saturation/front.glsl": {
                "return FRONT_GATED ? smoothstep(u_front_group.x, u_front_group.y, rho) : 1.0;": "return 1.0;"
            }
        },
    ),
    HardCase(
        "sixteen equal waves",
        Scene(waves=(ParametricWave(amplitude=0.06, wavelength=9.0),) * 16, foam=Foam(look="fading")),
        guard="the slope bound of ray marching is the sum over all waves (effects/waves/parametric.py, "
        "surface/march.glsl@march)",
        times=(0.0, 1e9),
        without={"surface/march.glsl": {"(now.x - less.x) * speed": "0.06 * (now.x - less.x) * speed"}},
    ),
    HardCase(
        "two kilometres long in 5 cm of water",
        Scene(
            waves=(
                ParametricWave(amplitude=0.02, wavelength=2000.0),
                ParametricWave(amplitude=50.0, wavelength=2000.0, speed=200.0),
            ),
            foam=Foam(look="textured"),
            water=Water(depth=0.05),
        ),
        guard="the dispersion relation is solved by Newton's method from Eckart's estimate, in float64 "
        "(ocean/basics/dispersion.py)",
        camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.3),
        without={
            "ocean/basics/dispersion.py": {
                "k = deep / math.sqrt(math.tanh(deep * depth))": "k = deep",
                "range(30)": "range(3)",
            }
        },
    ),
)

_IN_GROUPS = (
    reduced(
        "groups, thirty years later and ten thousand kilometres away",
        Scene(
            waves=(ParametricWave(amplitude=0.8, wavelength=9.0, direction=0.7), ParametricWave(direction=-0.4)),
            wave_groups=WaveGroups(size=30.0, contrast=1.0),
            foam=Foam(saturation=(FrontSaturation(group=(0.1, 0.6), decay=3.0),)),
        ),
        "the place in the period, past the way that groups have travelled,",
        Camera(position=(1e7, 3.0, -1e7), pitch=-0.3),
    ),
)

_GROUPED = (
    ParametricWave(amplitude=0.6, wavelength=11.0, direction=0.4, exponent=1.6),
    ParametricWave(amplitude=0.3, wavelength=7.3, direction=-0.3, exponent=1.4),
)
_SHARED = FrontSaturation(intensity=7.0, group=(0.2, 1.2), decay=3.0, variation=0.2)
_VARIANTS = (
    Scene(waves=_GROUPED, wave_groups=WaveGroups(), foam=Foam(saturation=(_SHARED,), life=FoamLife())),
    Scene(
        waves=_GROUPED, wave_groups=WaveGroups(), foam=Foam(saturation=(_SHARED, SlopeSaturation()), life=FoamLife())
    ),
    Scene(waves=_GROUPED, wave_groups=WaveGroups(), foam=Foam(), spray=Spray(threshold=0.5)),
)

_NEAR = Camera(position=(0.37, 9.0, -0.21), yaw=1.0, pitch=-0.3)

_INVISIBLE_SEA = (Scene(sea=Sea(wind=0.0)), Scene(sea=Sea(), light=None))

_HARD_SEA = (
    HardCase(
        "the open sea at any time",
        Scene(sea=Sea(wind=8.0)),
        guard="every frequency is a multiple of 2π per loop, and the time in the loop is reduced in float64 "
        "(waves/sea_passes.glsl@spectrum)",
        times=(-1e9, 1e9),
        camera=_NEAR,
        without={"framegraph/evaluation.py": {"(_modulo(time + rule.offset, rule.period),)": "(time + rule.offset,)"}},
    ),
    HardCase(
        "a hurricane that has blown over a hundred metres",
        Scene(sea=Sea(wind=60.0, fetch=100.0, choppiness=1.0)),
        guard="choppiness is reduced until the Jacobian is negative at one point in 60 000 (ocean/waves/cascades.py)",
        camera=_NEAR.model_copy(update={"position": (0.37, 8.711393, -0.21)}),
        without={"ocean/waves/cascades.py": {"requested if requested * slope <= TILT else TILT / slope": "requested"}},
    ),
    HardCase(
        "a breath of wind, and no wave on the largest tile",
        Scene(sea=Sea(wind=0.2, fetch=100.0, spread=100.0, against=0.0), water=Water(ripples=Ripples())),
        guard="the divisor is at least 1e-30 where slopes are clamped (waves/sea_passes.glsl@tile_pass)",
        camera=_NEAR,
        without={
            "waves/sea_passes.glsl": {
                "slope *= min(1.0, u_sea_limit.y / max(length(slope), 1e-30))": (
                    "slope = min(length(slope), u_sea_limit.y) * normalize(slope)"
                )
            }
        },
    ),
)

CASES = {
    "parametric waves": Cases(
        invisible=_INVISIBLE_PARAMETRIC, hard=(*_HARD_PARAMETRIC, *_IN_GROUPS), variants=_VARIANTS
    ),
    "sea": Cases(invisible=_INVISIBLE_SEA, hard=_HARD_SEA),
}
