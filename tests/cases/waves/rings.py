"""Hard cases of waves.rings, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import PLACE, TIME, reference
from support.scenes import Camera, Foam, HeightSaturation, Ring, Ripples, Scene, SlopeSaturation, Water

_VIEW = Camera(position=(0.0, 3.2, 0.0), pitch=-0.35)

_STONE = Ring(place=(0.3, -7.0), amplitude=0.12, decay=0.4, wavelength=1.6)


def _moved(by: tuple[float, float]) -> tuple[Ring, Camera]:
    """The stone and the view, elsewhere."""
    x, y, z = _VIEW.position
    return (
        _STONE.model_copy(update={"place": (_STONE.place[0] + by[0], _STONE.place[1] + by[1])}),
        _VIEW.model_copy(update={"position": (x + by[0], y, z + by[1])}),
    )


_AWAY = _moved((9.9e6, -9.9e6))

_INVISIBLE = (
    Scene(rings=(Ring(amplitude=1e-4), Ring(amplitude=0.0))),
    Scene(rings=(Ring(amplitude=1e-4),), foam=Foam(saturation=(HeightSaturation(),), look="halftone")),
    Scene(rings=(Ring(amplitude=1.00001e-4, wavelength=3.0),), water=Water(translucency=0.0)),
    Scene(rings=(_STONE,), light=None),
)

_HARD = (
    HardCase(
        "a hundred rings at one point",
        Scene(rings=(_STONE.model_copy(update={"amplitude": 0.004}),) * 100, water=Water(ripples=Ripples())),
        guard="height and slope are bounded by the sum over rings that can meet (ocean/waves/rings.py)",
        times=(2.0,),
        camera=_VIEW,
        without={
            "ocean/waves/rings.py": {
                "total += w * train": "total = w * train",
                "min(_over_the_plane(shown), _over_time(shown))": "_over_the_plane(shown)",
            }
        },
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
    HardCase(
        "rings a thousand million seconds from now",
        Scene(rings=(_STONE.model_copy(update={"birth": 1e9}), _STONE.model_copy(update={"every": 14.0}))),
        guard="ages are reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9 + 2.3),
        camera=_VIEW,
        without=TIME,
    ),
    HardCase(
        "rings ten thousand kilometres away",
        Scene(rings=(_AWAY[0],), water=Water(ripples=Ripples())),
        guard="the vector from the centre to the camera is reduced in float64 (framegraph/evaluation.py)",
        times=(2.3,),
        camera=_AWAY[1],
        without=PLACE,
    ),
    HardCase(
        "rings long dead",
        Scene(rings=(_STONE,), foam=Foam(saturation=(HeightSaturation(base=0.0, full=0.5),), look="halftone")),
        guard="negative amplitudes count as 0 (waves/rings.glsl@ring)",
        times=(13.8, 1e9),
        camera=_VIEW,
        without={"waves/rings.glsl": {"amplitude <= 0.0 || rho": "rho"}},
        missed_by=reference("waves/rings", "a_dead_ring_leaves_no_trace"),
    ),
)

CASES = {"rings": Cases(invisible=_INVISIBLE, hard=_HARD)}
