"""Rings of stones, drops and blasts, summed at each sample or drawn into a map first, and rings of touches.

docs/formulae.md, section 2.
"""

import math
from collections.abc import Callable, Sequence

from seafoam.effects import effect
from seafoam.effects.bounds import measured_bounds, unlit
from seafoam.effects.shader import Const, SlotFile
from seafoam.framegraph import rules
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Clamp, Constant, Rule, Term, Uniform, array, constants, number, significant
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves.rings import FRONT, SOFT, Train, ring_curvature, ring_height, ring_slope, trains
from seafoam.quality import Quality
from seafoam.scene import Scene
from seafoam.scene import waves as model
from seafoam.sums import summed

RING_CONSTS: dict[str, Const] = {
    "RING_DEAD": model.DEAD,
    "RING_DEAD_SHARE": model.DEAD_SHARE,
    "RING_SOFT": SOFT,
    "RING_FRONT": FRONT,
}
"""What every file of rings needs."""
_MIN_TEXELS = 3.0
"""Texels to the shortest wave below which a map does not resolve it, so that the rings are summed instead."""
_TOUCH_LIFE = significant(math.log(1.0 / model.DEAD_SHARE) / model.TOUCH_DECAY + 1.0)
"""Age at which every ring has ended, and a second more, s."""


def _age(ring: model.Ring) -> Rule:
    if ring.every is not None:
        return rules.Loop(period=ring.every, offset=-ring.birth)
    # The amplitude is 0 from the end of the ring's life on, so the age can be clamped a second later.
    return Clamp(offset=-ring.birth, rate=1.0, low=0.0, high=significant(ring.life + 1.0))


def _shown(scene: Scene) -> tuple[Train, ...]:
    every = trains(scene)
    return tuple(train for train in every if train.ring.life > 0.0) or every


def _ring_uniforms(
    shown: Sequence[Train], origin_from: Callable[[float, float], tuple[Rule, Rule]] = rules.to_camera
) -> dict[str, Uniform]:
    """State and shape of each ring. ``origin_from``: the vector from a centre to the origin of the shader's p, m."""
    state: list[Rule] = []
    for train in shown:
        origin = origin_from(*train.ring.place)
        state += [*origin, _age(train.ring), Constant(value=(significant(train.tail),))]
    shapes = [(of.ring.amplitude, significant(of.k), significant(of.omega), of.ring.decay) for of in shown]
    return {"u_ring_now": array("vec4", state, len(shown)), "u_ring_shape": constants("vec4", shapes)}


def ring_uniforms(scene: Scene, name: str) -> dict[str, Uniform]:
    """State and shape of the scene's rings around the camera, as uniforms whose names begin with ``name``."""
    return {key.replace("u_ring", name): uniform for key, uniform in _ring_uniforms(_shown(scene)).items()}


def _square_around(shown: Sequence[Train]) -> tuple[float, float, float]:
    """A level square: its corner of least x and z, and its side, m."""
    low, high = (
        tuple(pick(t.ring.place[i] + sign * t.reach for t in shown) for i in (0, 1))
        for pick, sign in ((min, -1.0), (max, 1.0))
    )
    # The 2 % leave a margin of a texel of still water at any size, so that clamped reads beyond the map are still.
    side = math.ceil(1.02 * max(high[0] - low[0], high[1] - low[1], 1.0))
    return math.floor(0.5 * (low[0] + high[0] - side)), math.floor(0.5 * (low[1] + high[1] - side)), side


def _draw(scene: Scene, rings: tuple[model.Ring, ...], quality: Quality) -> effect.Contribution:
    shown = _shown(scene)
    square = _square_around(shown)
    # A power of 2, as the passes that measure its bounds ask: a row over would be left out of them.
    size = 1 << (quality.rings_size.bit_length() - 1)
    texel = square[2] / size
    summed = quality.rings == "exact" or texel * _MIN_TEXELS > min(train.length for train in shown)
    height = ring_height(scene)
    unseen = effect.Bound.zero_if(height == 0.0, f"no ring is higher than {model.DEAD:g} m at any time")
    how = "summed at each sample" if summed else f"drawn into a map of {square[2]:g} m in each frame"
    contribution = effect.Contribution(
        why=f"{len(shown)} ring{'s' if len(shown) > 1 else ''}, {how}",
        consts={"RING_COUNT": len(shown), "RING_BLOCK": min(len(shown), 32), **RING_CONSTS},
        bound=unseen or unlit(scene),
        max_height=height,
        min_height=-height,
        max_slope=ring_slope(scene),
        max_curvature=ring_curvature(scene),
        map_error=0.0 if summed else height * effect.HALF_FLOAT,
        # Steps are bounded by the slopes of rings and sea together: with a sea, rays near the horizon take eight times
        # as many.
        march_factor=1 if scene.sea is None else 8,
    )
    if not summed:
        return contribution.joined(_map(shown, square, size))
    slot = SlotFile("waves", "waves/rings.glsl@exact", prefix="rings", needs=("waves/rings.glsl@ring",))
    return contribution.joined(effect.Resources(slots=(slot,), uniforms=_ring_uniforms(shown)))


def _map(shown: Sequence[Train], square: tuple[float, float, float], size: int) -> effect.Resources:
    """A map of the rings, ``size`` texels along each side of the square, and its measured bounds."""
    corner_x, corner_z, side = square
    texel = side / size
    place = effect.Resources(
        slots=(
            SlotFile("waves", "waves/rings.glsl@map", prefix="rings"),
            SlotFile("bounds", "waves/rings.glsl@bounds", prefix="rings"),
        ),
        uniforms={"u_ring_corner": array("vec2", rules.to_camera(corner_x, corner_z), 1), "u_ring_side": number(side)},
        inputs={"u_ring_bounds": "rings_bounds", "u_ring_map": "rings", "u_ring_grain": "rings_grain"},
    )

    def to_corner(x: float, z: float) -> tuple[Constant, Constant]:
        return Constant(value=(corner_x - x,)), Constant(value=(corner_z - z,))

    def drawn(target: str, file: str, texels: int) -> effect.Resources:
        spec = effect.PassSpec(
            f"{target.replace('_', ', ')}, {side:g} m map",
            target,
            ("lib/numbers.glsl", "waves/rings.glsl@ring", "waves/rings.glsl@reaching", file),
            uniforms={**_ring_uniforms(shown, to_corner), "u_ring_texel": number(side / texels)},
        )
        return effect.drawn_map(spec, Target(size=FixedSize.square(texels), format="RGBA16F", filter="linear"))

    return place.joined(
        drawn("rings", "waves/rings.glsl@map_pass", size),
        # The map's error varies from wave to wave, not within one, so half the resolution is enough for it.
        drawn("rings_grain", "waves/rings.glsl@grain_pass", size // 2),
        measured_bounds("rings", size, texel, stride=2 if min(of.length for of in shown) >= 4.0 * texel else 1),
    )


def _touches(scene: Scene, touches: tuple[model.Touch, ...], quality: Quality) -> effect.Contribution:
    strongest = max(touch.strength for touch in touches)
    velocity = (0.0, 0.0) if scene.current is None else scene.current.velocity
    absent = model.Touch(place=(0.0, 0.0), strength=0.0)
    given = (*touches, *(model.TOUCHES_MOST - len(touches)) * (absent,))
    each = [rule for i, touch in enumerate(given) for rule in _touch_rules(f"/touches/{i}", touch, velocity)]
    return effect.Contribution(
        # The list can change within the plan, so nothing here tells how long it is.
        why=f"up to {model.TOUCHES_MOST} touches of the water, summed at each sample",
        slots=(SlotFile("detail", "waves/rings.glsl@touch", prefix="touches", needs=("waves/rings.glsl@ring",)),),
        consts={
            "TOUCH_COUNT": model.TOUCHES_MOST,
            "TOUCH_CRESTS": model.TOUCH_CRESTS,
            "TOUCH_DECAY": model.TOUCH_DECAY,
            "TOUCH_GRAVITY": GRAVITY,
            "TOUCH_LEAST_LENGTH": model.TOUCH_LEAST_LENGTH,
            "TOUCH_LENGTH": model.TOUCH_LENGTH,
            **RING_CONSTS,
        },
        uniforms={"u_touch": array("vec4", each, model.TOUCHES_MOST)},
        # Rings of touches have slopes but no height, so only shading shows them.
        bound=effect.Bound.zero_if(
            scene.light is None, "the scene has no light, and touches show by the water's shading alone"
        )
        or effect.Bound.zero_if(strongest <= model.DEAD, f"no touch is stronger than {model.DEAD:g} m", ("/touches",)),
    )


def _touch_rules(pointer: str, touch: model.Touch, velocity: tuple[float, float]) -> list[Rule]:
    """One touch: the vector from its ring's centre to the camera (m), the ring's age (s), and the strength (m).

    The centre moves with the current from the time of the touch on: -place + velocity * time is the part of the vector
    that does not change, and the planner adds the part that does.
    """
    made: list[Rule] = []
    for axis, along in enumerate(((1.0, 0.0), (0.0, 1.0))):
        terms = [Term(field=f"{pointer}/place/{axis}", factor=-1.0)]
        values = [touch.place[axis]]
        if velocity[axis] != 0.0:
            terms.append(Term(field=f"{pointer}/time", factor=velocity[axis]))
            values.append(touch.time)
        offset = summed(term.factor * value for term, value in zip(terms, values, strict=True))
        made.append(Clamp(offset=offset, k=along, low=-rules.FAR, high=rules.FAR, terms=tuple(terms)))
    age = (Term(field=f"{pointer}/time", factor=-1.0),)
    made.append(Clamp(offset=-1.0 * touch.time, rate=1.0, low=0.0, high=_TOUCH_LIFE, terms=age))
    made.append(Constant(value=(touch.strength,), field=f"{pointer}/strength", absent=(0.0,)))
    return made


EFFECT = effect.part_effect(
    "rings",
    _draw,
    "/rings",
    effect.QualityParameter("/rings", "rings", ("map", "exact"), "geometry"),
    effect.QualityParameter("/rings_size", "texels of the ring map", (256, 512, 1024, 2048), "geometry"),
)
TOUCHES = effect.part_effect("touch", _touches, "/touches", afloat=("u_touch",))
