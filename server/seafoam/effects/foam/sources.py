"""Foam by height (Kryachko 2005), by slope (GPU ocean, 2007), of the surf, behind boats and stones in a current.

docs/formulae.md, sections 4, 8, 15 and 16.
"""

import math

import numpy as np

from seafoam.effects.boats.boat import HULLS
from seafoam.effects.boats.wake import WAY
from seafoam.effects.bounds import SATURATION_CAP, max_surface_height
from seafoam.effects.effect import Bound, Contribution, QualityParameter, SaturationSource, foam_effect
from seafoam.effects.shader import VALUE_NOISE, Const, SlotFile
from seafoam.effects.waves import current
from seafoam.effects.waves.parametric import max_profile_slope
from seafoam.framegraph.rules import Uniform, constants, number, rounded, significant, vector
from seafoam.ocean.basics.dispersion import paper_level, wavevector
from seafoam.ocean.waves.wakes import LEAST_SPEED, Wake, stone_wakes
from seafoam.quality import Quality
from seafoam.scene import Foam, HeightSaturation, Scene, SlopeSaturation, SurfSaturation, WakeSaturation
from seafoam.sums import summed

NODES = 17
"""Entries of the table of visible heights."""
_LENGTHS, _PLACES = 61, 384
"""Number of wavelengths of the highest wave over which the table is computed, and points in each."""
WIDENED = 1.5
"""Side of the box that approximates the five points of a blur, in units of the blur: the best fit on choppy lakes."""
_WIDENED = "foam/saturation/slope.glsl@widened"
_TORN = {False: "foam/saturation/wake.glsl@torn_exact", True: "foam/saturation/wake.glsl@torn"}
"""By whether the look is filtered."""
HULL_SPEED = 1.25
"""Speed over the square root of the length, √m/s, at which the bow's foam reaches its full amount."""
_CONTACT, _NO_CONTACT = "foam/saturation/wake.glsl@contact", "foam/saturation/wake.glsl@contact_none"
_STILL = "no boat moves, and no stone stands in a current"


def visible_heights(scene: Scene) -> tuple[float, float, list[tuple[float, float]]]:
    """Mean height of the parametric waves over their troughs (m), their greatest slope, and the visible heights.

    Entry i: mean and standard deviation (m) of the heights that are visible along rays that fall by (i / (NODES - 1))^2
    of the greatest slope, all waves running in one direction. A point at x is visible if h + slope x is greater there
    than at every point before it; its weight is the difference.
    """
    waves = [(wave, math.hypot(*wavevector(wave, scene.water.depth))) for wave in scene.waves if wave.amplitude > 0.0]
    first = max(waves, key=lambda item: item[0].amplitude)[1]
    x = np.arange(_LENGTHS * _PLACES) * (2.0 * math.pi / (first * _PLACES))
    h = np.zeros_like(x)
    for wave, k in waves:
        h += wave.amplitude * np.power(0.5 + 0.5 * np.cos(k * x), wave.exponent)
    steepest = summed(k * wave.amplitude * max_profile_slope(wave.exponent) for wave, k in waves)
    seen = [(float(h.mean()), float(h.std()))] * NODES
    for i in range(NODES - 1):
        over = h + steepest * (i / (NODES - 1)) ** 2 * x
        # From the highest crest on, since the line's beginning has nothing before it that could hide it.
        share = np.maximum(np.diff(np.maximum.accumulate(over)), 0.0)
        total = float(share.sum())
        if total > 1e-9 * float(h.max()):
            mean = float((share * h[1:]).sum()) / total
            seen[i] = (mean, math.sqrt(float((share * (h[1:] - mean) ** 2).sum()) / total))
        else:
            seen[i] = (float(h.max()), 0.0)
    return float(h.mean()), steepest, seen


def draw_height(scene: Scene, foam: Foam, height: HeightSaturation, quality: Quality) -> Contribution:
    pointer = foam.pointer(height)
    file = "foam/saturation/height.glsl@filtered" if foam.look == "filtered" else "foam/saturation/height.glsl@plain"
    own: dict[str, Uniform] = {}
    needs: tuple[str, ...] = ()
    # Shores refract waves, and an open sea resolves its heights until its largest waves are smaller than a pixel.
    raised = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if raised and foam.look == "filtered" and scene.sea is None and scene.shore is None:
        file, needs = "foam/saturation/height.glsl@seen", ("foam/saturation/height.glsl@level",)
        mean, steepest, seen = visible_heights(scene)
        kx, kz = wavevector(max(raised, key=lambda wave: wave.amplitude), scene.water.depth)
        wave = vector((kx, kz, significant(mean), significant(1.0 / max(steepest, 1e-30))))
        own = {"u_height_wave": wave, "u_height_seen": constants("vec2", map(rounded, seen))}
    return Contribution(
        why=f"height saturation between {height.base:g} and {height.full:g} m",
        slots=(SlotFile("saturation", file, prefix="height", needs=needs),),
        consts={"HEIGHT_NODES": NODES},
        uniforms={
            **own,
            "u_height_level": number(significant(paper_level(scene))),
            "u_height_base": number(height.base, f"{pointer}/base"),
            "u_height_full": number(height.full, f"{pointer}/full"),
        },
        bound=Bound.zero_if(
            height_limit(height, scene) == 0.0,
            "no crest reaches the height where foam starts",
            (f"{pointer}/base", f"{pointer}/full"),
        ),
    )


def height_limit(height: HeightSaturation, scene: Scene) -> float:
    """Return the greatest height saturation: that of the highest crest."""
    fraction = (max_surface_height(scene) + paper_level(scene) - height.base) / (height.full - height.base)
    return min(max(fraction, 0.0), SATURATION_CAP)


def draw_slope(scene: Scene, foam: Foam, slope: SlopeSaturation, quality: Quality) -> Contribution:
    # Without slope filtering a wider footprint has no effect.
    blurred = _WIDENED if quality.slope_places == 1 and quality.surface.filter else "foam/saturation/slope.glsl@blurred"
    file = blurred if slope.blur > 0.0 else "foam/saturation/slope.glsl@plain"
    pointer = foam.pointer(slope)
    return Contribution(
        why=f"slope saturation, {slope.gain:g} times 1 - n.y of the normal",
        slots=(SlotFile("saturation", file, prefix="slope", needs=("foam/saturation/slope.glsl@lack",)),),
        consts={"SLOPE_MOST": 1.0 if foam.look == "filtered" else SATURATION_CAP, "SLOPE_WIDENED": WIDENED},
        uniforms={
            "u_slope_gain": number(slope.gain, f"{pointer}/gain"),
            "u_slope_base": number(slope.base, f"{pointer}/base"),
            "u_slope_blur": number(slope.blur),
        },
        bound=Bound.zero_if(slope_limit(slope, scene) == 0.0, "the surface has no waves, so no slope"),
    )


def slope_limit(slope: SlopeSaturation, scene: Scene) -> float:
    """Return the greatest slope saturation: that of a vertical surface; 0 if the surface is level."""
    return min(slope.gain * (1.0 - slope.base), SATURATION_CAP) if max_surface_height(scene) > 0.0 else 0.0


def draw_surf(scene: Scene, foam: Foam, surf: SurfSaturation, quality: Quality) -> Contribution:
    pointer = foam.pointer(surf)
    if scene.shore is None:
        return Contribution.invisible("there is no shore to break on")
    height = scene.shore.surf.height
    filtered = foam.look == "filtered"
    front = "foam/saturation/surf.glsl@front_filtered" if filtered else "foam/saturation/surf.glsl@front"
    needs = (_TORN[filtered], "foam/saturation/surf.glsl@patches", "foam/saturation/surf.glsl@swept", front)
    return Contribution(
        why=f"foam of the surf, {surf.life:g} periods to 1/e",
        slots=(
            SlotFile("saturation", "foam/saturation/surf.glsl@surf", prefix="surf", needs=needs),
            *((SlotFile("land foam", "shore/waves.glsl@line"),) if surf.line > 0.0 else ()),
        ),
        consts={
            "SURF_CAP": 1.0 if filtered else SATURATION_CAP,
            "SURF_FILTERED": filtered,
            "SURF_LINED": surf.line > 0.0,
        },
        uniforms={
            "u_surf_foam": number(surf.amount),
            "u_surf_life": number(surf.life, f"{pointer}/life"),
            "u_surf_veil": number(surf.veil),
            "u_surf_line": number(surf.line),
            "u_surf_scale": number(significant(1.0 / max(height, 1e-6))),
        },
        bound=Bound.zero_if(height == 0.0 or surf.amount + surf.veil + surf.line == 0.0, "no wave breaks"),
    )


def surf_limit(surf: SurfSaturation, scene: Scene) -> float:
    """Return the greatest surf saturation: 2.4 times ``amount`` on thin water and twice ``veil``; 0 without surf."""
    if scene.shore is None or scene.shore.surf.height == 0.0:
        return 0.0
    return min(2.4 * surf.amount + 2.0 * surf.veil, SATURATION_CAP)


def draw_wake(scene: Scene, foam: Foam, wake: WakeSaturation, quality: Quality) -> Contribution:
    if wake_limit(wake, scene) == 0.0:
        return Contribution.invisible(_STILL)
    filtered = foam.look == "filtered"
    consts: dict[str, Const] = {"WAKE_CAP": 1.0 if filtered else SATURATION_CAP}
    amounts: list[tuple[float, ...]] = []
    if scene.current is not None and _stones(scene):
        # As of boats, each stone a hull of its breadth.
        speed = scene.current.speed
        for stone in scene.current.stones:
            share = min(speed / (HULL_SPEED * math.sqrt(4.0 * stone.radius)), 1.0)
            amounts.append((*rounded((wake.amount * share, wake.life * speed, wake.bow * share)), 0.0))
        files = (*VALUE_NOISE, _TORN[filtered], *current.WAY)
        slot = SlotFile("saturation", "foam/saturation/surf.glsl@stones", prefix="stones", needs=files)
        why = f"foam behind stones, {wake.life:g} s to 1/e"
        uniforms = {"u_stone_foam": constants("vec4", amounts)}
        behind = Contribution(why=why, slots=(slot,), consts=consts, uniforms=uniforms)
        return behind.joined(current.places(scene.current))
    for boat in scene.boats:
        moves = boat.speed >= LEAST_SPEED
        share = min(boat.speed / (HULL_SPEED * math.sqrt(boat.length)), 1.0)
        amounts.append(
            (
                wake.amount if moves else 0.0,
                significant(wake.life * max(boat.speed, LEAST_SPEED)),
                significant(wake.bow * share * share) if moves else 0.0,
                significant(wake.contact * share) if moves else 0.0,
            )
        )
    needs = (*VALUE_NOISE, _TORN[filtered], *WAY, _CONTACT if wake.contact else _NO_CONTACT)
    return Contribution(
        why=f"foam behind boats, {wake.life:g} s to 1/e",
        slots=(SlotFile("saturation", "foam/saturation/wake.glsl@wake", prefix="wake", needs=needs),),
        consts=consts,
        uniforms={
            "u_wake_foam": constants("vec4", amounts),
            "u_contact_hull": constants("vec3", (HULLS[boat.kind] for boat in scene.boats)),
        },
    )


def _stones(scene: Scene) -> tuple[Wake, ...]:
    """The wakes of the stones that white water stands at. Boats are at anchor where there are any."""
    return tuple(wake for wake in stone_wakes(scene.current) if wake.boat.speed >= LEAST_SPEED)


def wake_limit(wake: WakeSaturation, scene: Scene) -> float:
    """Return the greatest wake saturation: 0 if no boat moves, and no stone stands in a current."""
    if _stones(scene):
        return min(len(_stones(scene)) * (1.2 * wake.amount + 1.3 * wake.bow), SATURATION_CAP)
    if not any(boat.speed >= LEAST_SPEED for boat in scene.boats):
        return 0.0
    return min(len(scene.boats) * (1.2 * (wake.amount + wake.contact) + 1.7 * wake.bow), SATURATION_CAP)


HEIGHT = foam_effect("height foam", draw_height, SaturationSource(HeightSaturation, height_limit, ("base", "full")))
SLOPE = foam_effect(
    "slope foam",
    draw_slope,
    SaturationSource(SlopeSaturation, slope_limit, ("base", "gain")),
    QualityParameter("/slope_places", "points of the blurred slope", (1, 5), "filtering"),
)
SURF = foam_effect("surf foam", draw_surf, SaturationSource(SurfSaturation, surf_limit))
WAKE = foam_effect("wake foam", draw_wake, SaturationSource(WakeSaturation, wake_limit))
