"""Hard cases of water.seafloor, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, ParametricWave, Ripples, Scene, Water

_INVISIBLE = (
    Scene(water=Water(depth=11000.0)),
    Scene(waves=(ParametricWave(),), water=Water(depth=500.0, ripples=Ripples())),
)

_HARD = (
    HardCase(
        "five centimetres of black water",
        Scene(
            water=Water(depth=0.05, absorption_length=(0.01, 0.01, 0.01), scattering=0.5, ripples=Ripples(slope=0.6)),
            waves=(ParametricWave(amplitude=50.0, wavelength=0.05),),
        ),
        guard="cv is at most 1 under the root (water/body.glsl@floor)",
        camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.6),
        coarse_apart="slopes of 6000 magnify the error of SwiftShader's sine, 2e-4",
        without={
            "water/body.glsl": {
                "float slant = refracted_cosine(min(cv, 1.0), INDEX)": "float slant = refracted_cosine(cv, INDEX)"
            }
        },
        missed_by=guards("light", "light_at_grazing_incidence_comes_from_the_floor_as_along_the_water"),
    ),
    HardCase(
        "the clearest water over a white floor",
        Scene(
            water=Water(
                depth=0.05, absorption_length=(1000.0, 1000.0, 1000.0), scattering=0.0, floor_albedo=(1.0, 1.0, 1.0)
            )
        ),
        guard="the absorption length is finite (scene/water.py), so the extinction is not 0 (light/shade.glsl@lit)",
        unseen="the schema alone keeps absorption over 0; nothing in the program does",
    ),
)

CASES = {"floor": Cases(invisible=_INVISIBLE, hard=_HARD)}
