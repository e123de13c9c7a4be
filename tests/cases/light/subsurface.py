"""Hard cases of light.subsurface, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.scenes import Light, ParametricWave, Scene, Water

_INVISIBLE = (
    Scene(),
    Scene(waves=(ParametricWave(),), water=Water(translucency=0.0)),
    Scene(waves=(ParametricWave(),), light=Light(sun_elevation=-0.3)),
    Scene(waves=(ParametricWave(),), water=Water(absorption_length=(0.5, 0.5, 0.5))),
)

_HARD = (
    HardCase(
        "no crest at all",
        Scene(waves=(ParametricWave(amplitude=0.0),), water=Water(translucency=2.0), light=Light(sun_elevation=0.1)),
        guard="1/height counts as 0 if the water is level (effects/water/water.py)",
        without={
            "effects/water/water.py": {
                "number(1.0 / (highest - lowest) if highest - lowest > 1e-37 else 0.0)": (
                    "number(1.0 / (highest - lowest))"
                )
            }
        },
        error="ZeroDivisionError",
    ),
)

CASES = {"crest light": Cases(invisible=_INVISIBLE, hard=_HARD)}
