"""The scene: schema, units, ranges and presets. What follows from a scene is in :mod:`seafoam.ocean`."""

from seafoam.scene.base import *
from seafoam.scene.boats import *
from seafoam.scene.camera import *
from seafoam.scene.foam import *
from seafoam.scene.light import *
from seafoam.scene.models import *
from seafoam.scene.presets import *
from seafoam.scene.shore import *
from seafoam.scene.spray import *
from seafoam.scene.water import *
from seafoam.scene.waves import *
