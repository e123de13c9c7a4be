"""Hard cases of foam.living, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import IN_FLOAT32
from support.scenes import Camera, Foam, FoamLife, HeightSaturation, ParametricWave, Scene, Shore

_LIFE = FoamLife(wind_drift=0.3, windrows=1.0, windrow_spacing=4.0)

_FOAM = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, life=_LIFE)

_HARD = (
    HardCase(
        "foam that has drifted for thirty years",
        Scene(waves=(ParametricWave(amplitude=0.2, wavelength=6.0),), foam=_FOAM),
        guard="displacement by the drift reduced in float64 to a phase of the mask (effects/foam/look.py)",
        times=(-1e9, 1e9),
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        without=IN_FLOAT32,
    ),
    HardCase(
        "foam of any age, ten thousand kilometres away",
        Scene(waves=(ParametricWave(amplitude=0.2, wavelength=6.0),), foam=_FOAM),
        guard="camera position in the windrows' noise reduced in float64 (effects/foam/living.py)",
        camera=Camera(position=(9.99e6, 1.4, -9.99e6), yaw=1.0, pitch=-0.3),
        without=IN_FLOAT32,
    ),
    HardCase(
        "foam next to none and next to whole, of all ages",
        Scene(
            waves=(ParametricWave(amplitude=1.0, wavelength=6.0, exponent=2.0),),
            foam=_FOAM.model_copy(update={"saturation": (HeightSaturation(base=0.0, full=1.0),)}),
        ),
        guard="ridges of the windrows at least -1, so that they take no more foam than there is "
        "(foam/living.glsl@windrows); saturation at least 1e-6 in its logarithm (foam/living.glsl@living)",
        camera=Camera(position=(0.37, 12.0, -0.21), yaw=1.0, pitch=-0.6),
        without={"foam/living.glsl": {"uint(WINDROW_SEED))), -1.0)": "uint(WINDROW_SEED))), -1e30)"}},
    ),
    HardCase(
        "foam on a coast without surf",
        Scene(light=None, shore=Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0), foam=_FOAM),
        guard="gradient of the waves' phase divided by a length of at least 1e-6 (foam/carry.glsl@shore)",
        camera=Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2),
        without={"shore/waves.glsl": {"max(length(out_to_sea), 1e-6)": "length(out_to_sea)"}},
    ),
)

CASES = {"foam that lives": Cases(always_visible="a mask that is moved is another everywhere", hard=_HARD)}
