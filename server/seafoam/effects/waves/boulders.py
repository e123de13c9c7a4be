"""Stones that stand over a current: traced in the fragment shader, with shadow and mirror image.

docs/formulae.md, section 16.
"""

import math

from seafoam.effects.bounds import max_surface_height, min_surface_height
from seafoam.effects.effect import ABOVE, Contribution, PassSpec, part_effect
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, HASH, PLACE, Piece, SlotFile, SlotRef, Source, constant_function
from seafoam.effects.water.water import WATER
from seafoam.framegraph.plan import BoundingSphere, Quads
from seafoam.framegraph.rules import Constant, Rule, array, constants, number, significant, to_camera, vector
from seafoam.ocean.coast.boulders import BOULDER_REACH, SIDES, TOPS, boulders, cuts, dome_height, wetted
from seafoam.quality import Quality
from seafoam.scene import Current, Scene, Shore, Stone

LIKE = 0.9
"""Size of the ellipsoid that throws a stone's shadow, in that of its dome."""
WET = 0.3
"""Reflectance of wet rock in that of dry rock."""
ROUGHNESS = 0.02
"""Mean square slope of the film on wet rock, as on land that spray wets."""
DEEPEST = 30.0
"""Depth down to which stones stand in water without a floor, m."""
SHAPE = "waves/boulder.glsl@shape"
VEIL = (SHAPE, "waves/boulder.glsl@veil")
RENAMED = (
    *((f"boat_{name}", f"boulder_{name}") for name in ("ray", "water", "plane", "hidden", "before", "light", "in_air")),
    *(("near_boats", "near_boulders"), ("meet_boat", "meet_boulder"), ("boat_behind_land", "boulder_behind_land")),
    *(("NO_BOAT", "NO_BOULDER"), ("BOAT_RAYS", "BOULDER_RAYS")),
)
"""Names in the files of boats, which are drawn alike."""


def _as_boats(part: str) -> Source:
    return Source(f"boats/drawn.glsl@{part}", RENAMED)


def _draw(scene: Scene, current: Current, stones: tuple[Stone, ...], quality: Quality) -> Contribution:
    stones = boulders(current)
    if not stones:
        return Contribution.invisible("all stones lie under the surface")
    places: list[Rule] = []
    for stone in stones:
        places += [*to_camera(*stone.place), Constant(value=(stone.radius, dome_height(stone)))]
    foot = significant(1.01 * min_surface_height(scene) - 0.01), significant(1.01 * max_surface_height(scene) + 0.01)
    ground = -(DEEPEST if scene.water.depth is None else scene.water.depth)
    ground = ground if scene.shore is None else -scene.shore.depth
    rows = SIDES + TOPS + 1
    mirrors = scene.light is not None and scene.light.reflection == "sky"
    mirror = SlotFile("reflection", "waves/boulder.glsl@mirrored", needs=(*ILLUMINATION, *VEIL))
    shadow = SlotFile("open sun", "waves/boulder.glsl@sunlit", prefix="boulder", needs=VEIL)
    rock = (scene.shore or Shore()).rock
    return Contribution(
        why=f"{len(stones)} stones over the water",
        slots=(*((shadow,) if scene.light is not None else ()), *((mirror,) if mirrors else ())),
        consts={
            "BOULDER_COUNT": len(stones),
            "BOULDER_ROWS": rows,
            "BOULDER_REACH": BOULDER_REACH,
            "BOULDER_STEPS": 8,
            "BOULDER_SHIFTED": quality.pixel_width > 1,
            "BOULDER_LIKE": LIKE,
            "BOULDER_WET": WET,
            "BOULDER_ROUGHNESS": ROUGHNESS,
            "BOAT_SIDE": math.isqrt(quality.boat_samples),
            "BOAT_ALIKE": quality.samples == 1,
        },
        chosen_consts={"BOAT_ALIKE": False},
        uniforms={
            "u_boulder_place": array("vec4", places, len(stones)),
            "u_boulder_cuts": constants("vec3", [tuple(row) for stone in stones for row in cuts(stone).tolist()]),
            "u_boulder_foot": vector((*foot, min(ground, foot[0]))),
            "u_boulder_rock": vector(rock, "/shore/rock" if scene.shore else None),
            "u_boulder_wet": number(wetted(current)),
        },
        passes=(_pass(scene, stones, min(ground, foot[0])),),
    )


def _pass(scene: Scene, stones: tuple[Stone, ...], ground: float) -> PassSpec:
    look: tuple[Piece | SlotRef, ...] = (_as_boats("dark"),)
    if scene.light is not None:
        film = Source("shore/land.glsl@land_film", (("FILM_ROUGHNESS", "BOULDER_ROUGHNESS"),))
        noise = (HASH, "lib/noise.glsl@slopes_3")
        light = ("lib/refraction.glsl", *ILLUMINATION, "shore/soil.glsl@soil_struct", film, *noise)
        look = (SlotRef("open sun"), *light, "waves/boulder.glsl@light")
    over: tuple[Piece | SlotRef, ...] = ("waves/boulder.glsl@over_met",)
    if scene.shore is None:
        no_land = constant_function("bool", "boulder_behind_land", "vec3 ray, float farthest", "false")
        over = (SlotRef("find"), no_land, _as_boats("over"))
    common: tuple[Piece | SlotRef, ...] = (*COMMON, PLACE, SlotRef("waves"), SHAPE, "waves/boulder.glsl@meet")
    common = (*common, SlotRef("sky"), *look)
    under = (
        "light/shade.glsl@optics",
        SlotRef("find"),
        SlotRef("underside"),
        WATER,
        SlotRef("reach"),
        _as_boats("under"),
    )
    return PassSpec(
        "stones",
        "boulders",
        (*common, *over, _as_boats("main")),
        under=() if scene.light is None else (*common, *under, _as_boats("main")),
        vertex=(*COMMON, SlotRef("waves"), SHAPE, "vertex/vertex.glsl@quad", "waves/boulder.glsl@vertex"),
        mesh=Quads(count=len(stones)),
        target=ABOVE,
        stage="after",
        blend="over",
        shines=False,
        view=tuple(_bounding_sphere(stone, ground) for stone in stones),
    )


def _bounding_sphere(stone: Stone, ground: float) -> BoundingSphere:
    (x, z), top = stone.place, dome_height(stone)
    radius = math.hypot(1.5 * BOULDER_REACH * stone.radius, 0.5 * (top - ground))
    return BoundingSphere(centre=(x, significant(0.5 * (top + ground)), z), radius=significant(1.001 * radius + 0.1))


EFFECT = part_effect("stones", _draw, "/current/stones")
