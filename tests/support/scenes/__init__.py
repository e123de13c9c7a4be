"""The parts of scenes, from one place: most tests build scenes of several."""

from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.foam import (
    Drift,
    DriftSaturation,
    Foam,
    FoamLife,
    FoamScattering,
    FoamSource,
    FrontSaturation,
    HeightSaturation,
    Look,
    Saturation,
    SlopeSaturation,
    SurfSaturation,
    Vortex,
    WakeSaturation,
    WhitecapSaturation,
)
from seafoam.scene.light import Caustics, Cirrus, Clouds, Day, Gusts, Light, Moon, Sky, Sparkles, ToneCurve, sun_angles
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.spray import Burst, Spray
from seafoam.scene.water import Current, Ripples, Stone, Water
from seafoam.scene.waves import RINGS_MOST, TOUCHES_MOST, ParametricWave, Ring, Sea, Touch, WaveGroups
