"""Hard cases of foam.aeration, and scenes that name it but in which it is invisible."""

from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation
from seafoam.scene.models import Scene
from seafoam.scene.water import Water
from seafoam.scene.waves import ParametricWave
from support.cases import Cases, HardCase

_FOAM = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),))

_INVISIBLE = (
    Scene(waves=(ParametricWave(amplitude=0.5),), foam=Foam(), water=Water(aeration=1e-6)),
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product"),
        water=Water(aeration=1.0),
    ),
)

_HARD = (
    HardCase(
        "milk in water as dark and as clear as it gets",
        Scene(
            foam=_FOAM,
            water=Water(
                aeration=10.0, plume_depth=20.0, scattering=0.0, absorption_length=(0.01, 1000.0, 0.01), depth=0.05
            ),
        ),
        guard="reflected light at least 0 (water/body.glsl@bubbles)",
        without="no change on llvmpipe: clear water never reflects more from the layer than in all",
    ),
)

CASES = {"milky water": Cases(invisible=_INVISIBLE, hard=_HARD)}
