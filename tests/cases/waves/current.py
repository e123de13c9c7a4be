"""Hard cases of waves.current, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import TIME
from support.scenes import Current, Foam, HeightSaturation, ParametricWave, Ripples, Scene, Water

_WAVES = (
    ParametricWave(amplitude=0.4, wavelength=5.0, direction=1.2),
    ParametricWave(amplitude=0.2, wavelength=2.3, direction=-0.8),
)

_FLOWS = Scene(
    waves=_WAVES,
    foam=Foam(saturation=(HeightSaturation(base=0.1, full=0.5),), look="fading", mask="clump"),
    water=Water(ripples=Ripples(slope=0.1)),
    current=Current(speed=3.7, direction=0.4),
)

_HARD = (
    HardCase(
        "a current for thirty years",
        _FLOWS,
        guard="the way of the water, reduced in float64 together with each place and phase (framegraph/rules.py)",
        times=(-1e9, 1e9),
        camera=_FLOWS.camera,
        without=TIME,
    ),
)

CASES = {"current": Cases(invisible=(Scene(waves=_WAVES, current=Current(speed=0.0)),), hard=_HARD)}
