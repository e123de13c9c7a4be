"""Rings of stones, drops and blasts: summed at each place, or drawn into a map first (dynamic displacement mapping).

docs/formulae.md, section 2.
"""

import math
from collections.abc import Iterable

from seafoam.effects.bounds import crest_limit, slope_sensitivity
from seafoam.effects.effect import HALF_FLOAT, Bound, Const, Contribution, Effect, HardCase, Knob, PassSpec, SlotFile
from seafoam.effects.waves.measured import measured_bounds
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Held, Loop, Rule, Uniform, array, number, significant
from seafoam.ocean.rings import FRONT, SOFT, Train, ring_curvature, ring_height, ring_slope, trains
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Chop, Foam, HeightSaturation, Scene, SlopeSaturation, Water
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
            slots=(SlotFile("waves", "rings/exact.glsl", prefix="rings", needs=("rings/ring.glsl",)),),
            consts=consts,
            uniforms={
                "u_ring_now": _now(shown, (_to_eye(*train.ring.place) for train in shown)),
                "u_ring_shape": _shapes(shown),
            },
            bound=bound,
            top=height,
            trough=-height,
            steepest=steepest,
            curvature=curvature,
            march=march,
        )
    corners = [
        (Constant(value=(corner_x - t.ring.place[0],)), Constant(value=(corner_z - t.ring.place[1],))) for t in shown
    ]

    def drawn(target: str, shader: str, size: int) -> PassSpec:
        return PassSpec(
            name=f"{target.replace('_', ', ')}, {side:g} m map",
            program=target,
            fragment=("common/numbers.glsl", "rings/ring.glsl", "rings/reaching.glsl", shader),
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
            SlotFile("waves", "rings/map.glsl", prefix="rings"),
            SlotFile("bounds", "rings/bounds.glsl", prefix="rings"),
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
            drawn("rings", "rings/map_pass.glsl", sizes["rings"]),
            drawn("rings_grain", "rings/grain_pass.glsl", sizes["rings_grain"]),
            *measured,
        ),
        bound=bound,
        top=height,
        trough=-height,
        steepest=steepest,
        curvature=curvature,
        grain=height * HALF_FLOAT,
        march=march,
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

EFFECT = Effect(
    "rings",
    contribute,
    invisible=(
        Scene(rings=(Ring(amplitude=1e-4), Ring(amplitude=0.0))),
        Scene(rings=(Ring(amplitude=1e-4),), foam=Foam(saturation=(HeightSaturation(),), look="halftone")),
        Scene(rings=(Ring(amplitude=1.00001e-4, wavelength=3.0),), water=Water(translucency=0.0)),
        Scene(rings=(_STONE,), light=None),
    ),
    knobs=(
        Knob("/rings", "rings", ("map", "exact"), "geometry"),
        Knob("/rings_size", "texels of the map of rings", (256, 512, 1024, 2048), "geometry"),
    ),
    hard_cases=(
        HardCase(
            name="a hundred rings at one point",
            scene=Scene(rings=(_STONE.model_copy(update={"amplitude": 0.004}),) * 100, water=Water(chop=Chop())),
            guard="height and slope bounded where rings meet (ocean/rings.py)",
            without="bounded by the highest ring alone, crests of 0.39 m stand over a slab of 8 mm",
            times=(2.0,),
            camera=_VIEW,
        ),
        HardCase(
            name="a ring at its own centre at its birth",
            scene=Scene(
                rings=(_STONE, _STONE.model_copy(update={"birth": 2.0})),
                foam=Foam(saturation=(SlopeSaturation(),), look="textured"),
            ),
            guard="the tip of r rounded, the front still at birth (rings/ring.glsl)",
            without="0/0 at the centre, and a cone of slope 0.45 around it",
            times=(0.0, 2.0, 2.4),
            camera=Camera(position=(0.3, 2.0, -7.0), pitch=-math.pi / 2),
        ),
        HardCase(
            name="a front without width",
            scene=Scene(
                rings=(_STONE.model_copy(update={"crests": 0.5}),),
                foam=Foam(saturation=(HeightSaturation(base=0.05, full=0.25),), look="textured"),
            ),
            guard="front and tail a wavelength wide (rings/ring.glsl)",
            without="slope 0.60 instead of 0.40 at the worst of 20 000 places, and 1500 in the front itself",
            times=(1.5,),
            camera=_VIEW,
        ),
        HardCase(
            name="rings a thousand million seconds from now",
            scene=Scene(rings=(_STONE.model_copy(update={"birth": 1e9}), _STONE.model_copy(update={"every": 14.0}))),
            guard="ages reduced in float64 (framegraph/evaluation.py)",
            without="in float32 the age is 0 until 32 s have passed: off by 0.12 m in a ring of 0.3 m",
            times=(-1e9, 1e9 + 2.3),
            camera=_VIEW,
        ),
        HardCase(
            name="rings ten thousand kilometres away",
            scene=Scene(rings=(_AWAY[0],), water=Water(chop=Chop())),
            guard="the way from the centre to the eye reduced in float64 (framegraph/evaluation.py)",
            without="in float32: off by 0.14 m in a ring of 0.3 m",
            times=(2.3,),
            camera=_AWAY[1],
        ),
        HardCase(
            name="rings long dead",
            scene=Scene(
                rings=(_STONE,), foam=Foam(saturation=(HeightSaturation(base=0.0, full=0.5),), look="halftone")
            ),
            guard="an amplitude below nothing is none (rings/ring.glsl)",
            without="ghosts of 0.4 mm and slope 0.0012 for ever",
            times=(13.8, 1e9),
            camera=_VIEW,
        ),
    ),
)
