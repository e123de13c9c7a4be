"""Hard cases of foam.drift, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import IN_FLOAT32, guards, reference
from support.scenes import Camera, Drift, DriftSaturation, Foam, HeightSaturation, Light, ParametricWave, Scene, Vortex

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-1.0)

_VIEW = Camera(position=(0.0, 9.0, 8.0), pitch=-0.5)

_FOAM = Foam(saturation=(DriftSaturation(),), mask="clump", mask_tile=4.0)

_EDDY = Drift(place=(0.0, -10.0), size=40.0, vortices=(Vortex(place=(0.0, -10.0)),))


def _with(**fields: object) -> Drift:
    return _EDDY.model_copy(update=fields)


_INVISIBLE = (Scene(foam=_FOAM), Scene(drift=_EDDY, foam=Foam(saturation=(DriftSaturation(amount=0.0),))))

_HARD = (
    HardCase(
        "the centre of a vortex in the middle of a pixel",
        Scene(light=_LIGHT, drift=_EDDY, foam=_FOAM),
        guard="a series for (1 - e^-y)/y at small y, where the difference cancels (foam/drift.glsl@flow)",
        times=(0.0, 17.0),
        camera=Camera(position=(0.0, 4.0, -10.0), pitch=-math.pi / 2),
        # SwiftShader's sine, good to 2e-4, moves threads of foam round a vortex, a pixel wide.
        coarse_share=0.12,
        without={"foam/drift.glsl": {"y < 0.05 ?": "y < 0.0 ?"}},
        missed_by=reference("foam/drift", "flow_equals_float64_right_into_the_centre"),
    ),
    HardCase(
        "a hundred texels a step",
        Scene(light=_LIGHT, drift=_with(current=(17.0, -5.0)), foam=_FOAM),
        guard="texels are traced back along the flow, so that each has a value for any step "
        "(foam/drift_passes.glsl@backward)",
        times=(3.0,),
        camera=_VIEW,
        without={
            "effects/foam/drift.py": {
                'self.forward = quality.drift == "forward"': 'self.forward = quality.drift != "exact"',
                'look != "filtered" or quality.drift == "forward"': 'look != "filtered" or quality.drift != "exact"',
            }
        },
        missed_by=reference("foam/drift", "backward_is_one_everywhere_where_forward_gaps_and_piles"),
    ),
    HardCase(
        "a vortex that turns twice a second",
        Scene(
            light=_LIGHT,
            drift=_with(vortices=(Vortex(place=(0.0, -6.0), radius=0.28, speed=2.0),)),
            foam=Foam(saturation=(DriftSaturation(life=12.0),), mask="clump", mask_tile=4.0),
        ),
        guard="steps in which the fastest vortex turns by at most 1 rad (effects/foam/drift.py)",
        times=(5.0,),
        camera=Camera(position=(0.0, 3.0, -6.0), pitch=-math.pi / 2),
        without={
            "effects/foam/drift.py": {
                "min(quality.drift_step, STEP_TURN * min(quality.drift_step, 1.0) / max(fastest, 1e-6))": (
                    "quality.drift_step"
                )
            }
        },
    ),
    HardCase(
        "a vortex that has ground its foam finer than texels",
        Scene(
            light=_LIGHT,
            drift=_with(current=(0.0, 0.0), vortices=(Vortex(place=(0.0, -6.0), radius=1.2, speed=2.0),)),
            foam=Foam(saturation=(DriftSaturation(life=60.0, patch=1.0),), mask="clump", mask_tile=4.0),
        ),
        guard="patches blend to their mean where a texel is larger than a patch (foam/drift_passes.glsl@backward)",
        times=(50.0,),
        camera=Camera(position=(0.0, 6.0, -6.0), pitch=-math.pi / 2),
        without={"foam/drift_passes.glsl": {"mix(sum, u_drift_coverage, smoothstep(0.5, 2.0, reach))": "sum"}},
        missed_by=guards("foam", "foam_that_is_ground_fine_does_not_flicker"),
    ),
    HardCase(
        "drifting foam a thousand million seconds from now",
        Scene(light=_LIGHT, drift=_EDDY, foam=_FOAM),
        guard="ages and the number of the generation reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9 + 3.1),
        camera=_VIEW,
        without=IN_FLOAT32,
    ),
    HardCase(
        "drifting foam ten thousand kilometres away",
        Scene(
            light=_LIGHT,
            drift=_with(
                place=(9.99e6, -9.99e6), vortices=(Vortex(place=(9.99e6 + 1.3, -9.99e6 + 3.7)),), current=(0.3, 0.1)
            ),
            foam=_FOAM,
        ),
        guard="the vector from the square's centre to the camera reduced in float64 (framegraph/evaluation.py)",
        times=(12.0,),
        camera=Camera(position=(9.99e6, 9.0, -9.99e6 + 18.0), pitch=-0.5),
        without={
            "effects/foam/drift.py": {
                'array("vec2", to_camera(*scene.drift.place), 1),': (
                    'array("vec2", to_camera(0.0, 0.0), 1),\n'
                    '            "u_drift_middle": vector((-scene.drift.place[0], -scene.drift.place[1])),'
                )
            },
            "foam/saturation/drift.glsl": {
                "uniform vec2 u_drift_place;": "uniform vec2 u_drift_middle;\nuniform vec2 u_drift_place;",
                "p + u_drift_place;": "(p + u_drift_place) + u_drift_middle;",
            },
            "foam/drift.glsl": {"p + u_drift_place;": "(p + u_drift_place) + u_drift_middle;"},
        },
    ),
    HardCase(
        "more drifting foam than the water holds, times foam by height",
        Scene(
            light=_LIGHT,
            waves=(ParametricWave(amplitude=0.2, wavelength=5.0),),
            drift=_EDDY,
            foam=Foam(
                saturation=(DriftSaturation(amount=4.0, coverage=0.95), HeightSaturation(base=-0.2, full=0.4)),
                combine="product",
                mask="clump",
                mask_tile=4.0,
            ),
        ),
        guard="the filtered look clamps each saturation to 1 before the product (foam/saturation/drift.glsl@map)",
        times=(12.0,),
        camera=_VIEW,
        without={
            "effects/foam/drift.py": {
                '"DRIFT_CAP": 1.0 if foam.look == "filtered" else SATURATION_CAP': '"DRIFT_CAP": SATURATION_CAP'
            }
        },
    ),
    HardCase(
        "no current and no vortex",
        Scene(light=_LIGHT, drift=_with(current=(0.0, 0.0), vortices=()), foam=_FOAM),
        guard="without vortices the shader's array holds one of speed 0 (effects/foam/drift.py)",
        times=(12.0,),
        camera=_VIEW,
        without={
            "effects/foam/drift.py": {"drift.vortices or (Vortex(place=drift.place, speed=0.0),)": "drift.vortices"}
        },
        error="greater than or equal to 1",
    ),
)

CASES = {"drifting foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
