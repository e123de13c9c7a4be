"""A river's current, and the standing waves behind its stones. docs/formulae.md, section 16."""

import math

from seafoam.effects.boats.wake import WakeKind, wakes_of
from seafoam.effects.bounds import min_surface_height
from seafoam.effects.effect import Contribution, PlanError, Resources, part_effect
from seafoam.framegraph.rules import Constant, Rule, array, constants, number, significant, to_camera, vector
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves.wakes import stone_wakes
from seafoam.quality import Quality
from seafoam.scene import Current, Scene, Stone

FASTEST = 0.7
"""Greatest Froude number of the depth: up to it the waves are within 4 % of those in deep water."""
WAY = ("waves/standing.glsl@way",)
STONES = WakeKind(
    "stones",
    "stones",
    "standing waves",
    "the water flows too slowly, or no stone makes waves",
    WAY,
    "waves/standing.glsl@declared_bounds",
    "waves/standing.glsl@bounds",
    ("waves/standing.glsl@within",),
    "waves/standing.glsl@gentler",
    (
        ("BOAT_COUNT", "STONE_COUNT"),
        ("WakeWay", "StoneWay"),
        ("wake_way", "stone_way"),
        ("wake_here", "stone_here"),
        ("wake_sum", "stone_sum"),
        ("wakes_waves", "stones_waves"),
        ("wakes_shading", "stones_shading"),
        ("u_boat_form", "u_stone_form"),
        ("u_boat_course", "u_stone_course"),
        ("u_wake", "u_stone"),
        ("u_wake_boat", "u_stone_size"),
        ("u_wake_map", "u_stone_map"),
        ("u_wake_blocks", "u_stone_blocks"),
        ("u_wake_bounds", "u_stone_bounds"),
        ("u_wake_highest", "u_stone_highest"),
    ),
)


def _draw(scene: Scene, current: Current, quality: Quality) -> Contribution:
    """The planner moves what effects declare as afloat."""
    if current.velocity == (0.0, 0.0):
        return Contribution.invisible("the water rests")
    _refuse(scene)
    return Contribution(why=f"a current of {current.speed:g} m/s carries waves, ripples and foam")


def _refuse(scene: Scene) -> None:
    """Raise :class:`PlanError` for what keeps its place over the ground where the current would move or change it."""
    kept = {
        "/rings": bool(scene.rings),
        "/drift": scene.drift is not None,
        "/spray": scene.spray is not None,
        "/shore/surf/height": scene.shore is not None and scene.shore.surf.height > 0.0,
        "/boats": any(boat.speed > 0.0 for boat in scene.boats),
    }
    for pointer, there in kept.items():
        if there:
            raise PlanError(pointer, f"{pointer.rsplit('/', 1)[-1]} cannot be combined with a current")


def _standing(scene: Scene, current: Current, stones: tuple[Stone, ...], quality: Quality) -> Contribution:
    depth = scene.water.depth
    if depth is not None and current.speed > FASTEST * math.sqrt(GRAVITY * depth):
        most = FASTEST * math.sqrt(GRAVITY * depth)
        raise PlanError("/current/speed", f"at most {most:.3g} m/s with stones in {depth:g} m of water")
    # Somewhat lower still: maps are rounded.
    lowest = significant(1.01 * min_surface_height(scene) - 0.01)
    lowest_water = Resources(uniforms={"u_stone_lowest": number(lowest)})
    return wakes_of(STONES, stone_wakes(current), quality).joined(places(current), lowest_water)


def places(current: Current) -> Resources:
    stones = current.stones
    courses: list[Rule] = []
    for stone in stones:
        courses += [*to_camera(*stone.place), Constant(value=(0.0, 1e9))]
    forms = [
        (significant(wake.boat.length), stone.radius, significant(wake.length), 0.0)
        for stone, wake in zip(stones, stone_wakes(current), strict=True)
    ]
    flow = significant(math.cos(current.direction)), significant(math.sin(current.direction))
    return Resources(
        consts={"STONE_COUNT": len(stones)},
        uniforms={
            "u_stone_course": array("vec4", courses, len(stones)),
            "u_stone_form": constants("vec4", forms),
            "u_stone_flow": vector(flow),
        },
    )


EFFECT = part_effect("current", _draw, "/current")
STANDING_WAVES = part_effect("standing waves", _standing, "/current/stones")
