"""Cases of the example: a scene that calls for it and cannot show it, one that would break it, and its variants."""

from windrows import Windrows

from seafoam.scene import Camera, Foam, ParametricWave, Scene, SceneExtensions
from support.cases import Cases, HardCase

LINES = SceneExtensions(windrows=Windrows())
NONE = SceneExtensions(windrows=Windrows(strength=0.0))

INVISIBLE = (Scene(foam=Foam(), extensions=NONE),)

HARD = (
    HardCase(
        name="windrows ten thousand kilometres away",
        scene=Scene(waves=(ParametricWave(),), foam=Foam(look="halftone"), extensions=LINES),
        guard="the eye's place across the wind reduced in float64 (framegraph/evaluation.py)",
        camera=Camera(position=(1e7, 3.0, -1e7), pitch=-0.5),
    ),
)

VARIANTS = (
    Scene(foam=Foam(look="halftone"), extensions=LINES),
    Scene(foam=Foam(look="filtered"), extensions=LINES),
)

CASES = {"windrows": Cases(hard=HARD, invisible=INVISIBLE, variants=VARIANTS)}
"""By the effect's name."""
