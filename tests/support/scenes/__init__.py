"""The parts of scenes, from one place: most tests build scenes of several."""

from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.current import Current, Stone
from seafoam.scene.drift import Drift, Vortex
from seafoam.scene.foam import (
    DriftSaturation,
    Foam,
    FoamScattering,
    FoamSource,
    FrontSaturation,
    HeightSaturation,
    Look,
    Saturation,
    SlopeSaturation,
    SurfSaturation,
    WakeSaturation,
    WhitecapSaturation,
)
from seafoam.scene.light import Caustics, Light, Sparkles, ToneCurve
from seafoam.scene.living import FoamLife
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.rings import RINGS_MOST, Ring
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.sky import Cirrus, Clouds, Day, Gusts, Moon, Sky, sun_angles
from seafoam.scene.spray import Burst, Spray
from seafoam.scene.touch import TOUCHES_MOST, Touch
from seafoam.scene.water import Ripples, Water
from seafoam.scene.waves import ParametricWave, Sea, WaveGroups
