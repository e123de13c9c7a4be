"""Rings of stones, drops and blasts: summed at each place, or drawn into a map first (dynamic displacement mapping).

docs/formulae.md, section 2.
"""

import math
from collections.abc import Iterable

from seafoam.effects.contribution import (
    Bound,
    Constant,
    Contribution,
    Effect,
    FixedSize,
    Fullscreen,
    HardCase,
    Held,
    Knob,
    Loop,
    PassSpec,
    Rule,
    SlotFile,
    Target,
    TargetInput,
    Uniform,
    array,
    number,
    significant,
)
from seafoam.effects.extremes import crest_limit, slope_sensitivity
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Chop, Foam, HeightSaturation, ParametricWave, Scene, SlopeSaturation, Water
from seafoam.scene.ring_level import FRONT, SOFT, Train, calm_level, ring_slope, trains
from seafoam.scene.rings import DEAD, Ring

_FAR = 1e8
"""Places are held so far from the eye, m: no picture reaches there."""
_FEWEST_TEXELS = 6.0
"""A map with fewer texels to its shortest wave would not hold it; the rings are summed then."""


def _age(ring: Ring) -> Rule:
    if ring.every is not None:
        return Loop(period=ring.every, offset=-ring.birth)
    # At its life its amplitude is 0; a second more is as good as any age.
    return Held(offset=-ring.birth, rate=1.0, low=0.0, high=significant(ring.life + 1.0))


def _shapes(shown: tuple[Train, ...]) -> Uniform:
    return array(
        "vec4",
        [Constant(value=(t.ring.amplitude, significant(t.k), significant(t.omega), t.ring.decay)) for t in shown],
        len(shown),
    )


def _now(shown: tuple[Train, ...], ways: Iterable[tuple[Rule, Rule]]) -> Uniform:
    """Way, age and tail of each ring."""
    rules: list[Rule] = []
    for train, way in zip(shown, ways, strict=True):
        rules += [*way, _age(train.ring), Constant(value=(significant(train.tail),))]
    return array("vec4", rules, len(shown))


def _to_eye(x: float, z: float) -> tuple[Held, Held]:
    """From a place to the eye."""
    return (
        Held(offset=-x, k=(1.0, 0.0), low=-_FAR, high=_FAR),
        Held(offset=-z, k=(0.0, 1.0), low=-_FAR, high=_FAR),
    )


def _square(shown: tuple[Train, ...]) -> tuple[float, float, float]:
    """Corner (x, z) and side of the square that all rings stay in, m."""
    low, high = (
        tuple(pick(t.ring.place[i] + sign * t.reach for t in shown) for i in (0, 1))
        for pick, sign in ((min, -1.0), (max, 1.0))
    )
    # A texel's breadth of still water lies around it, whatever the size: the rim reads as still.
    side = math.ceil(1.02 * max(high[0] - low[0], high[1] - low[1], 1.0))
    return math.floor(0.5 * (low[0] + high[0] - side)), math.floor(0.5 * (low[1] + high[1] - side)), side


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any ring."""
    if not scene.rings:
        return None
    every = trains(scene)
    shown = tuple(train for train in every if train.ring.life > 0.0) or every
    level, steepest = calm_level(scene), ring_slope(scene)
    bound = _bound(scene, level, steepest)
    count = len(shown)
    consts: dict[str, int | float | bool] = {
        "RING_COUNT": count,
        "RING_DEAD": DEAD,
        "RING_SOFT": SOFT,
        "RING_FRONT": FRONT,
    }
    what = f"{count} ring{'s' if count > 1 else ''}"
    corner_x, corner_z, side = _square(shown)
    texel = side / quality.rings_size
    if quality.rings == "exact" or texel * _FEWEST_TEXELS > min(train.length for train in shown):
        return Contribution(
            why=f"{what}, summed at each place",
            slots=(SlotFile("waves", "rings/exact.glsl", prefix="rings", needs=("rings/ring.glsl",)),),
            consts=consts,
            uniforms={
                "u_ring_now": _now(shown, (_to_eye(*train.ring.place) for train in shown)),
                "u_ring_shape": _shapes(shown),
                "u_ring_level": number(level),
            },
            bound=bound,
            top=2.0 * level,
            steepest=steepest,
        )
    corners = (
        (Constant(value=(corner_x - t.ring.place[0],)), Constant(value=(corner_z - t.ring.place[1],))) for t in shown
    )
    common = math.exp(sum(math.log(train.k) for train in shown) / count)
    return Contribution(
        why=f"{what}, drawn into a map of {side:g} m each frame",
        slots=(SlotFile("waves", "rings/map.glsl", prefix="rings"),),
        consts=consts,
        uniforms={
            "u_ring_corner": array("vec2", _to_eye(corner_x, corner_z), 1),
            "u_ring_side": number(side),
            "u_ring_level": number(level),
            "u_ring_common": number(significant(common)),
        },
        inputs={"u_ring_map": TargetInput(target="rings")},
        targets={
            "rings": Target(
                size=FixedSize(width=quality.rings_size, height=quality.rings_size), format="RGBA16F", filter="linear"
            )
        },
        passes=(
            PassSpec(
                name=f"rings, {side:g} m map",
                program="rings",
                vertex=("vertex/fullscreen.glsl",),
                fragment=("common/numbers.glsl", "rings/ring.glsl", "rings/map_pass.glsl"),
                target="rings",
                mesh=Fullscreen(),
                uniforms={
                    "u_ring_now": _now(shown, corners),
                    "u_ring_shape": _shapes(shown),
                    "u_ring_texel": number(texel),
                },
            ),
        ),
        bound=bound,
        top=2.0 * level,
        steepest=steepest,
    )


def _bound(scene: Scene, level: float, steepest: float) -> Bound | None:
    """As for waves: their slopes under a light, and their height where foam or a floor shows it."""
    if level == 0.0:
        return Bound(0.0, f"no ring is ever higher than {DEAD:g} m")
    ripples = scene.water.chop is not None and scene.light is not None
    if scene.foam is not None or ripples or scene.water.depth is not None:
        return None
    if scene.light is None:
        return Bound(0.0, "nothing lies on them, and there is no light")
    return Bound(
        slope_sensitivity(scene) * steepest + 0.2 * level + crest_limit(scene),
        f"slopes are never above {steepest:.1g}",
        ("/light/exposure", "/water/roughness", "/water/translucency", "/water/absorption_length"),
    )


_LOW = Camera(position=(0.37, 2.2, -0.21), yaw=0.0, pitch=-0.25)

EFFECT = Effect("rings", contribute)
