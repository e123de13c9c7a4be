"""Stones that stand over a current: traced in the fragment shader, with shadow and mirror image.

docs/formulae.md, section 16.
"""

import math

from seafoam.effects.bounds import max_surface_height, min_surface_height
from seafoam.effects.effect import ABOVE, Contribution, PassSpec, part_effect
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, HASH, PLACE, Piece, SlotFile, SlotRef, Source, constant_function
from seafoam.effects.water.water import WATER
from seafoam.framegraph.plan import Quads
from seafoam.framegraph.rules import Constant, Rule, array, constants, number, significant, to_camera, vector
from seafoam.ocean.coast.boulders import BOULDER_REACH, cuts
from seafoam.quality import Quality
from seafoam.scene import Current, Scene, Shore, Stone

SHAPE = "waves/boulder.glsl@shape"
_VEIL = (SHAPE, "waves/boulder.glsl@veil")
_SHADOW = SlotFile("open sun", "waves/boulder.glsl@sunlit", prefix="boulder", needs=_VEIL)
_MIRROR = SlotFile("reflection", "waves/boulder.glsl@mirrored", needs=(*ILLUMINATION, *_VEIL))


def _as_boats(path: str) -> Source:
    """A file of boats, which are drawn alike."""
    names = (
        (r"boat_(\w+)", r"boulder_\1"),
        (r"(near|meet)_boats?", r"\1_boulder"),
        (r"(NO_)?BOAT(_RAYS)?", r"\1BOULDER\2"),
    )
    return Source(path, names)


def _draw(scene: Scene, current: Current, stones: tuple[Stone, ...], quality: Quality) -> Contribution:
    if not (stones := current.standing):
        return Contribution.invisible("all stones lie under the surface")
    places: list[Rule] = []
    for stone in stones:
        places += [*to_camera(*stone.place), Constant(value=(stone.radius, stone.dome))]
    lowest, highest = 1.01 * min_surface_height(scene) - 0.01, 1.01 * max_surface_height(scene) + 0.01
    ground = min(-(scene.shore.depth if scene.shore else scene.water.depth or 30.0), lowest)
    light, rock = scene.light, (scene.shore or Shore()).rock
    return Contribution(
        why=f"{len(stones)} stones over the water",
        slots=() if light is None else (_SHADOW, _MIRROR) if light.reflection == "sky" else (_SHADOW,),
        consts={
            "BOULDER_COUNT": len(stones),
            "BOULDER_REACH": BOULDER_REACH,
            "BOULDER_SHIFTED": quality.pixel_width > 1,
            "BOAT_SIDE": math.isqrt(quality.boat_samples),
            "BOAT_ALIKE": quality.samples == 1,
        },
        chosen_consts={"BOAT_ALIKE": False},
        uniforms={
            "u_boulder_place": array("vec4", places, len(stones)),
            "u_boulder_cuts": constants("vec3", [tuple(row) for stone in stones for row in cuts(stone).tolist()]),
            "u_boulder_foot": vector((significant(lowest), significant(highest), significant(ground))),
            "u_boulder_rock": vector(rock, "/shore/rock" if scene.shore else None),
            "u_boulder_wet": number(current.wetted),
        },
        passes=(_pass(scene, len(stones)),),
    )


def _look(film: Piece) -> tuple[Piece | SlotRef, ...]:
    rock = ("shore/soil.glsl@soil_struct", film, HASH, "lib/noise.glsl@slopes_3", "waves/boulder.glsl@light")
    return SlotRef("open sun"), "lib/refraction.glsl", *ILLUMINATION, *rock


def _pass(scene: Scene, count: int) -> PassSpec:
    film = Source("shore/land.glsl@land_film", (("FILM_ROUGHNESS", "0.02"),))
    look = (_as_boats("boats/drawn.glsl@dark"),) if scene.light is None else _look(film)
    over: tuple[Piece | SlotRef, ...] = ("waves/boulder.glsl@over_met",)
    if scene.shore is None:
        no_land = constant_function("bool", "boulder_behind_land", "vec3 ray, float farthest", "false")
        over = (SlotRef("find"), no_land, _as_boats("boats/drawn.glsl@over"))
    first = (*COMMON, PLACE, SlotRef("waves"), SHAPE, "waves/boulder.glsl@meet")
    drowned = (*first, SlotRef("sky"), *_look("waves/boulder.glsl@drowned"))
    slots = SlotRef("find"), SlotRef("underside"), WATER, SlotRef("reach")
    below = ("light/shade.glsl@optics", *slots, _as_boats("boats/drawn.glsl@under"), _as_boats("boats/drawn.glsl@main"))
    return PassSpec(
        "stones",
        "boulders",
        (*first, SlotRef("sky"), *look, *over, _as_boats("boats/drawn.glsl@main")),
        under=() if scene.light is None else (*drowned, *below),
        vertex=(*COMMON, SlotRef("waves"), SHAPE, "vertex/vertex.glsl@quad", "waves/boulder.glsl@vertex"),
        mesh=Quads(count=count),
        target=ABOVE,
        stage="after",
        blend="over",
        shines=False,
    )


EFFECT = part_effect("stones", _draw, "/current/stones")
