"""Hard cases of reflection.planar, and scenes that call for it and cannot show it."""

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Chop, Water
from seafoam.scene.waves import ParametricWave

_BOAT = Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.6, speed=0.0)

_MIRROR = Light(reflection="planar")

_INVISIBLE = (Scene(light=_MIRROR), Scene(light=_MIRROR, waves=(ParametricWave(),)))

_HARD = (
    HardCase(
        name="a mirror under the eye and straight down",
        scene=Scene(light=_MIRROR, boats=(_BOAT,), water=Water(chop=Chop())),
        guard="mirrored places before the eye alone (reflection/planar.glsl)",
        without="nothing on llvmpipe: boats that are looked for are before the eye",
        camera=Camera(position=(0.0, 4.0, -2.0), pitch=-1.5708),
    ),
    HardCase(
        name="a mirror at grazing, eye among crests",
        scene=Scene(
            light=_MIRROR,
            boats=(_BOAT,),
            waves=(ParametricWave(amplitude=0.8, wavelength=7.0, direction=1.2),),
        ),
        guard="water mirrors where the eye's ray met it, not where still water would be (surface/main.glsl)",
        without="4 % of samples off by more than 2 levels, the worst by 113",
        camera=Camera(position=(0.0, 0.4, 12.0), pitch=0.0),
    ),
    HardCase(
        name="eye under the mirror",
        scene=Scene(
            light=_MIRROR,
            boats=(_BOAT,),
            waves=(ParametricWave(amplitude=0.8, wavelength=40.0, phase=-1.5708),),
        ),
        guard="a mirrored ray begins out of the water, never before its eye (reflection/map_pass.glsl)",
        without="nothing here: no boat lies between the mirrored eye and the water over it",
        camera=Camera(position=(0.0, -0.1, 12.0), pitch=-0.05),
    ),
)

CASES = {"planar reflection": Cases(invisible=_INVISIBLE, hard=_HARD)}
