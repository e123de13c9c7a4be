"""Rings of stones, drops and blasts: summed at each place, or drawn into a map first (dynamic displacement mapping).

docs/formulae.md, section 2.
"""

import math
from collections.abc import Iterable

from seafoam.effects.bounds import crest_limit, slope_sensitivity
from seafoam.effects.effect import HALF_FLOAT, Bound, Const, Contribution, Effect, Knob, PassSpec, SlotFile
from seafoam.effects.waves.measured import measured_bounds
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Held, Loop, Rule, Uniform, array, number, significant
from seafoam.ocean.rings import FRONT, SOFT, Train, ring_curvature, ring_height, ring_slope, trains
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.rings import DEAD, DEAD_SHARE, Ring

_FAR = 1e8
"""Places are held so far from the eye, m: no picture reaches there."""
_FEWEST_TEXELS = 4.0
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
    height, steepest, curvature = ring_height(scene), ring_slope(scene), ring_curvature(scene)
    # Both slopes count in every step through both slabs: with a sea a ray near the horizon takes eight times as many.
    march = 1 if scene.sea is None else 8
    bound = _bound(scene, height, steepest)
    count = len(shown)
    consts: dict[str, Const] = {
        "RING_COUNT": count,
        "RING_BLOCK": min(count, 32),
        "RING_DEAD": DEAD,
        "RING_DEAD_SHARE": DEAD_SHARE,
        "RING_SOFT": SOFT,
        "RING_FRONT": FRONT,
    }
    what = f"{count} ring{'s' if count > 1 else ''}"
    corner_x, corner_z, side = _square(shown)
    texel = side / quality.rings_size
    if quality.rings == "exact" or texel * _FEWEST_TEXELS > min(train.length for train in shown):
        return Contribution(
            why=f"{what}, summed at each place",
            slots=(SlotFile("waves", "waves/rings/exact.glsl", prefix="rings", needs=("waves/rings/ring.glsl",)),),
            consts=consts,
            uniforms={
                "u_ring_now": _now(shown, (_to_eye(*train.ring.place) for train in shown)),
                "u_ring_shape": _shapes(shown),
            },
            bound=bound,
            max_height=height,
            min_height=-height,
            max_slope=steepest,
            max_curvature=curvature,
            march_factor=march,
        )
    corners = [
        (Constant(value=(corner_x - t.ring.place[0],)), Constant(value=(corner_z - t.ring.place[1],))) for t in shown
    ]

    def drawn(target: str, shader: str, size: int) -> PassSpec:
        return PassSpec(
            name=f"{target.replace('_', ', ')}, {side:g} m map",
            program=target,
            fragment=("lib/numbers.glsl", "waves/rings/ring.glsl", "waves/rings/reaching.glsl", shader),
            target=target,
            uniforms={
                "u_ring_now": _now(shown, corners),
                "u_ring_shape": _shapes(shown),
                "u_ring_texel": number(side / size),
            },
        )

    # The grain changes from wave to wave, not within one: half as fine is enough.
    sizes = {"rings": quality.rings_size, "rings_grain": quality.rings_size // 2}
    # The shortest wave is four texels long.
    targets, measured = measured_bounds("rings", sizes["rings"], side / sizes["rings"], stride=2)
    return Contribution(
        why=f"{what}, drawn into a map of {side:g} m each frame",
        slots=(
            SlotFile("waves", "waves/rings/map.glsl", prefix="rings"),
            SlotFile("bounds", "waves/rings/bounds.glsl", prefix="rings"),
        ),
        consts=consts,
        uniforms={
            "u_ring_corner": array("vec2", _to_eye(corner_x, corner_z), 1),
            "u_ring_side": number(side),
        },
        inputs={
            "u_ring_map": TargetInput(target="rings"),
            "u_ring_grain": TargetInput(target="rings_grain"),
            "u_ring_bounds": TargetInput(target="rings_bounds"),
        },
        targets=targets
        | {
            name: Target(size=FixedSize(width=size, height=size), format="RGBA16F", filter="linear")
            for name, size in sizes.items()
        },
        passes=(
            drawn("rings", "waves/rings/map_pass.glsl", sizes["rings"]),
            drawn("rings_grain", "waves/rings/grain_pass.glsl", sizes["rings_grain"]),
            *measured,
        ),
        bound=bound,
        max_height=height,
        min_height=-height,
        max_slope=steepest,
        max_curvature=curvature,
        map_error=height * HALF_FLOAT,
        march_factor=march,
    )


def _bound(scene: Scene, height: float, steepest: float) -> Bound | None:
    """As for waves: their slopes under a light, and their height where foam or a floor shows it."""
    if height == 0.0:
        return Bound(0.0, f"no ring is ever higher than {DEAD:g} m")
    ripples = scene.water.chop is not None and scene.light is not None
    if scene.foam is not None or ripples or scene.water.depth is not None or scene.boats:
        return None
    if scene.light is None:
        return Bound(0.0, "nothing lies on them, and there is no light")
    return Bound(
        slope_sensitivity(scene) * steepest + 0.2 * height + crest_limit(scene),
        f"slopes are never above {steepest:.1g}",
        ("/light/exposure", "/water/roughness", "/water/translucency", "/water/absorption_length"),
    )


EFFECT = Effect(
    "rings",
    contribute,
    knobs=(
        Knob("/rings", "rings", ("map", "exact"), "geometry"),
        Knob("/rings_size", "texels of the ring map", (256, 512, 1024, 2048), "geometry"),
    ),
)
