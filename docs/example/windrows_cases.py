"""Cases of the example: a scene that calls for it and cannot show it, and one that would break it."""

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam
from seafoam.scene.models import Scene
from seafoam.scene.water import Chop, Water
from seafoam.scene.waves import ParametricWave

INVISIBLE = (Scene(water=Water(chop=Chop(slope=0.0)), foam=Foam()),)

HARD = (
    HardCase(
        name="windrows ten thousand kilometres away",
        scene=Scene(waves=(ParametricWave(),), water=Water(chop=Chop()), foam=Foam(look="halftone")),
        guard="the eye's place across the wind reduced in float64 (framegraph/evaluation.py)",
        without="in float32: lines in steps of a metre, saturation off by up to 0.5",
        camera=Camera(position=(1e7, 3.0, -1e7), pitch=-0.5),
    ),
)

CASES = {"windrows": Cases(hard=HARD, invisible=INVISIBLE)}
