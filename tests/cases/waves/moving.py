"""Test scenes of rings, touches, ripples, currents and their stones: hard cases, and scenes that cannot show them."""

import math

from seafoam.scene import Current, ParametricWave, Ring, Ripples, Sea, Stone, Touch, Water
from support.cases import Cases, HardCase, reduced
from support.scenes import (
    Camera,
    Foam,
    Gusts,
    HeightSaturation,
    Light,
    Scene,
    Shore,
    SlopeSaturation,
    Surf,
    WakeSaturation,
)

_VIEW = Camera(position=(0.0, 3.2, 0.0), pitch=-0.35)

_STONE = Ring(place=(0.3, -7.0), amplitude=0.12, decay=0.4, wavelength=1.6)


_AWAY = _STONE.model_copy(update={"place": (9.9e6 + 0.3, -9.9e6 - 7.0)})

_INVISIBLE_RINGS = (
    Scene(rings=(Ring(amplitude=1e-4), Ring(amplitude=0.0))),
    Scene(rings=(Ring(amplitude=1e-4),), foam=Foam(saturation=(HeightSaturation(),), look="halftone")),
    Scene(rings=(_STONE,), light=None),
)

_HARD_RINGS = (
    HardCase(
        "a hundred rings at one point",
        Scene(rings=(_STONE.model_copy(update={"amplitude": 0.004}),) * 100, water=Water(ripples=Ripples())),
        guard="height and slope are bounded by the sum over rings that can meet (ocean/waves/rings.py)",
        times=(2.0,),
        camera=_VIEW,
        without={"ocean/waves/rings.py": {"total += w * train": "total = w * train"}},
    ),
    HardCase(
        "a ring at its own centre at its birth",
        Scene(
            rings=(_STONE, _STONE.model_copy(update={"birth": 2.0})),
            foam=Foam(saturation=(SlopeSaturation(),), look="textured"),
        ),
        guard="r is rounded off at the centre, and there is no wave beyond the front, which is at the centre at "
        "birth (waves/rings.glsl@ring)",
        times=(0.0, 2.0, 2.4),
        camera=Camera(position=(0.3, 2.0, -7.0), pitch=-math.pi / 2),
        without={
            "waves/rings.glsl": {"float soft = RING_SOFT * wavelength": "float soft = 0.0", " || rho >= front": ""}
        },
    ),
    HardCase(
        "a front without width",
        Scene(
            rings=(_STONE.model_copy(update={"crests": 0.5}),),
            foam=Foam(saturation=(HeightSaturation(base=0.05, full=0.25),), look="textured"),
        ),
        guard="amplitude rises and falls over a wavelength at front and tail (waves/rings.glsl@ring)",
        times=(1.5,),
        camera=_VIEW,
        without={"waves/rings.glsl": {"float band = 1.0 / (RING_FRONT * wavelength)": "float band = 1e6"}},
    ),
    reduced(
        "rings ten thousand kilometres away, after thirty years",
        Scene(rings=(_AWAY.model_copy(update={"birth": 1e9}), _AWAY.model_copy(update={"every": 14.0}))),
        "ages and the vector from the centre to the camera",
        _VIEW.model_copy(update={"position": (9.9e6, 3.2, -9.9e6)}),
        times=(-1e9, 1e9 + 2.3),
    ),
)

_NEAR = Camera(position=(0.0, 2.0, 0.0), pitch=-0.45)
_TRAIN = tuple(Touch(place=(0.35 * i - 2.0, -4.0 - 0.1 * i), time=0.15 * i - 2.0) for i in range(12))


def _moved_touch(touches: tuple[Touch, ...], by: tuple[float, float]) -> tuple[Touch, ...]:
    return tuple(
        touch.model_copy(update={"place": (touch.place[0] + by[0], touch.place[1] + by[1])}) for touch in touches
    )


_INVISIBLE_TOUCH = (
    Scene(touches=(Touch(strength=0.0), Touch(strength=1e-4))),
    Scene(waves=(ParametricWave(),), foam=Foam(), touches=_TRAIN, light=None),
)

_HARD_TOUCH = (
    reduced(
        "touches ten thousand kilometres away",
        Scene(touches=_moved_touch(_TRAIN, (1e7 - 8.0, -1e7 + 8.0)), water=Water(ripples=Ripples())),
        "the vector from the centre to the camera",
        Camera(position=(1e7 - 8.0, 2.0, -1e7 + 8.0), pitch=-0.45),
        times=(0.0,),
    ),
    HardCase(
        "touches long over, and touches of no strength",
        Scene(touches=(*_TRAIN, Touch(strength=0.0)), foam=Foam(saturation=(HeightSaturation(),))),
        guard="negative amplitudes count as 0, and strengths of 0 are passed over (waves/rings.glsl@ring)",
        times=(12.0, 1e9),
        camera=_NEAR,
        without={"waves/rings.glsl": {"amplitude <= 0.0 || rho": "rho", "touch.w <= 0.0 || !ring": "!ring"}},
    ),
    reduced(
        "touches of a river thirty years after its current set in",
        Scene(
            current=Current(speed=2.0, direction=0.6),
            touches=tuple(touch.model_copy(update={"time": 9e8 + touch.time}) for touch in _TRAIN),
        ),
        "the way of a ring with the river since its touch",
        _NEAR,
        times=(9e8,),
    ),
)

_VARIANTS = (
    Scene(sea=Sea(), touches=_TRAIN),
    Scene(waves=(ParametricWave(),), water=Water(ripples=Ripples(), depth=2.0), touches=_TRAIN),
)

_INVISIBLE_RIPPLES = (
    Scene(water=Water(ripples=Ripples(slope=0.0))),
    Scene(waves=(ParametricWave(),), foam=Foam(), water=Water(ripples=Ripples()), light=None),
)

_HARD_RIPPLES = (
    reduced(
        "ripples and gusts anywhere, at any time",
        Scene(water=Water(ripples=Ripples(gusts=Gusts(strength=1.0, size=4.0, speed=20.0, change=0.5)))),
        "phases, and the camera's position in each tile and in the noise,",
        Camera(position=(-1e7, 1.2, 1e7), yaw=1.0, pitch=-0.3),
        times=(-1e9, 1e9, 1e9 + 1e-6),
    ),
)

_WAVES = (
    ParametricWave(amplitude=0.4, wavelength=5.0, direction=1.2),
    ParametricWave(amplitude=0.2, wavelength=2.3, direction=-0.8),
)

_FLOWS_CURRENT = Scene(
    waves=_WAVES,
    foam=Foam(saturation=(HeightSaturation(base=0.1, full=0.5),), look="fading", mask="clump"),
    water=Water(ripples=Ripples(slope=0.1)),
    current=Current(speed=3.7, direction=0.4),
)

_HARD_CURRENT = (
    reduced(
        "a current for thirty years",
        _FLOWS_CURRENT,
        "the way of the water, together with each place and phase,",
        _FLOWS_CURRENT.camera,
    ),
)

_STONES = (Stone(place=(0.0, -20.0), radius=0.8, waves=1.0), Stone(place=(4.0, -24.0), radius=10.0, waves=1.0))
_INVISIBLE_STANDING = (
    Scene(current=Current(speed=0.4, stones=_STONES)),
    Scene(current=Current(stones=(Stone(waves=0.0),))),
)

_OVER = Current(stones=(Stone(place=(-0.6, -7.0), height=0.9), Stone(place=(1.0, -9.0), radius=1.1, height=0.4)))
_SUNK = Current(stones=(Stone(height=0.0),))
_BANK = Shore(kind="island", place=(30.0, -40.0), size=160.0, radius=20.0, depth=6.0, surf=Surf(height=0.0))
_FAR = tuple(stone.model_copy(update={"place": (1e7 - 8.6, -1e7 + 1.0)}) for stone in _OVER.stones[:1])
_HARD_STONES = (
    reduced(
        "a stone ten thousand kilometres away",
        Scene(current=Current(stones=_FAR), waves=(ParametricWave(amplitude=0.1),)),
        "the vector from a stone to the camera",
        Camera(position=(1e7 - 8.0, 2.0, -1e7 + 8.0), pitch=-0.25),
        times=(0.0,),
    ),
)
_STONE_VARIANTS = (
    Scene(current=_OVER, foam=Foam(saturation=(WakeSaturation(),)), light=None),
    Scene(current=_OVER, shore=_BANK, light=Light(reflection="planar"), water=Water(depth=6.0)),
    Scene(current=_OVER, waves=_WAVES, light=Light()),
)

CASES = {
    "rings": Cases(invisible=_INVISIBLE_RINGS, hard=_HARD_RINGS),
    "touch": Cases(invisible=_INVISIBLE_TOUCH, hard=_HARD_TOUCH, variants=_VARIANTS),
    "ripples": Cases(invisible=_INVISIBLE_RIPPLES, hard=_HARD_RIPPLES),
    "current": Cases(invisible=(Scene(waves=_WAVES, current=Current(speed=0.0)),), hard=_HARD_CURRENT),
    "standing waves": Cases(invisible=_INVISIBLE_STANDING),
    "stones": Cases(invisible=(Scene(current=_SUNK),), hard=_HARD_STONES, variants=_STONE_VARIANTS),
}
