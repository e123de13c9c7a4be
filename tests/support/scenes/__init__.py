"""The parts of scenes, from one place: most tests build scenes of several."""

from seafoam.scene import *
