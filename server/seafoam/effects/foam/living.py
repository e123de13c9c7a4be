"""Foam that lives: carried by its water, gathered in windrows, older masks. docs/formulae.md, section 5."""

import math

from seafoam.effects.effect import Contribution, Effect, HardCase, Piece, SlotFile, Source, constant_function
from seafoam.effects.light.noise import PERLIN_2
from seafoam.framegraph.rules import Phase, Uniform, array, number, vector
from seafoam.ocean.stokes import foam_drift, foam_life
from seafoam.quality import Quality
from seafoam.scene.living import FoamLife
from seafoam.scene.models import (
    Camera,
    Foam,
    HeightSaturation,
    ParametricWave,
    Scene,
    SurfSaturation,
)
from seafoam.scene.shore import Shore

AGE = 0.8
"""From mask to mask, in e-folds of the saturation."""
WINDROW_LENGTH = 8.0
"""Windrows are so many times as long as they are apart."""
WINDROW_RIDGE = 7.781
"""1 - this |n|, at least -1, has the mean 0 over gradient noise n in the plane (2·10⁶ places)."""
WINDROW_SEED = 1938
CELLS = 256
"""The noise repeats after so many cells."""


_NO_WINDROWS = constant_function("float", "windrow", "vec2 p, Footprint fp")
_AT_REST = constant_function("vec2", "carry", "vec2 p")
"""Off a coast too water lies where it rests."""


def carries(scene: Scene) -> bool:
    """Whether waves carry the foam to and fro."""
    life = foam_life(scene)
    return life is not None and life.carried


def living(look: str, life: FoamLife) -> tuple[str, tuple[Piece, ...]]:
    """The file that stands in for a look's where foam lives, and what it needs."""
    rows: tuple[Piece, ...] = (*PERLIN_2, "foam/windrows.glsl") if life.windrows > 0.0 else (_NO_WINDROWS,)
    return "foam/living.glsl", (*rows, Source(look, (("foam_amount", "young_amount"),)))


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``foam.life`` in the filtered look."""
    life = foam_life(scene)
    if life is None:
        return None
    slots = [SlotFile("carry", "carry/still.glsl", prefix="still")]
    if scene.shore is not None:
        surf = any(isinstance(one, SurfSaturation) for one in (scene.foam.saturation if scene.foam else ()))
        carry = f"carry/{'surf' if surf else 'shore'}.glsl" if life.carried else _AT_REST
        slots.append(SlotFile("shore carry", carry))
    drift = foam_drift(scene)
    uniforms: dict[str, Uniform] = {}
    if life.windrows > 0.0:
        c, s = math.cos(life.wind_direction), math.sin(life.wind_direction)
        across = 1.0 / life.windrow_spacing
        rows = ((c * across / WINDROW_LENGTH, s * across / WINDROW_LENGTH), (-s * across, c * across))
        turn = 2.0 * math.pi / CELLS
        place = [
            Phase(
                offset=0.0,
                rate=-turn * (row[0] * drift[0] + row[1] * drift[1]),
                k=(turn * row[0], turn * row[1]),
            )
            for row in rows
        ]
        uniforms = {
            "u_windrow_phase": array("float", place, 2),
            "u_windrow_matrix": vector((*rows[0], *rows[1])),
            "u_windrows": number(life.windrows, "/foam/life/windrows"),
        }
    return Contribution(
        why=f"foam drifts at {math.hypot(*drift):.2g} m/s"
        + (", carried to and fro by the waves" if life.carried else "")
        + (f", {len(life.masks)} masks for older foam" if life.masks else "")
        + (f", in rows {life.windrow_spacing:g} m apart" if life.windrows > 0.0 else ""),
        slots=tuple(slots),
        consts={"WINDROW_RIDGE": WINDROW_RIDGE, "WINDROW_SEED": WINDROW_SEED},
        uniforms=uniforms,
    )


_LIFE = FoamLife(wind_drift=0.3, windrows=1.0, windrow_spacing=4.0)
_FOAM = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, life=_LIFE)

EFFECT = Effect(
    "foam that lives",
    contribute,
    always_visible="a mask that is moved is another everywhere",
    hard_cases=(
        HardCase(
            name="foam that has drifted for thirty years",
            scene=Scene(waves=(ParametricWave(amplitude=0.2, wavelength=6.0),), foam=_FOAM),
            guard="the way of the drift reduced in float64, a phase of the mask (effects/foam/look.py)",
            without="in float32 the way of the drift at 1e9 s is a multiple of 32 m: another mask everywhere",
            times=(-1e9, 1e9),
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="foam of any age, ten thousand kilometres away",
            scene=Scene(waves=(ParametricWave(amplitude=0.2, wavelength=6.0),), foam=_FOAM),
            guard="the eye's place in the windrows' noise reduced in float64 (effects/foam/living.py)",
            without="in float32 the rows stand elsewhere: places of 1e7 m are a metre apart",
            camera=Camera(position=(9.99e6, 1.4, -9.99e6), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="foam next to none and next to whole, of all ages",
            scene=Scene(
                foam=_FOAM.model_copy(
                    update={"saturation": (HeightSaturation(base=-6.103515625e-05, full=0.99993896484375),)}
                )
            ),
            guard="the saturation at least 1e-6 in its logarithm (foam/living.glsl)",
            without="the logarithm of 0: an age without end, held by a clamp that NaN would pass",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="foam on a coast without surf",
            scene=Scene(
                light=None,
                shore=Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0),
                foam=_FOAM,
            ),
            guard="the gradient of the waves' phase at least 1e-6 (carry/shore.glsl)",
            without="nothing on llvmpipe; where the phase is level, 0/0",
            camera=Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2),
        ),
    ),
)
