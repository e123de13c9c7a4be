"""A shore: sea floor, land with its soil and shadows, surf, and water coloured along the ray through it.

docs/formulae.md, section 8.
"""

import math

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, max_displacement
from seafoam.effects.effect import Bound, Contribution, QualityParameter, TextureUse, part_effect
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sun_irradiance
from seafoam.effects.shader import MARCH_AHEAD, SLOPES, VALUE_NOISE, Const, Piece, SlotFile, Source
from seafoam.effects.shore.limits import Limits, limits, rounded_up
from seafoam.effects.shore.maps import FIND_LAND, GROUND, MARCH_GROUND, MAXIMA, blur_deviation, map_passes, map_targets
from seafoam.effects.water.water import bed_sun
from seafoam.effects.waves.parametric import max_profile_slope
from seafoam.framegraph.rules import Phase, Uniform, array, constants, number, rounded, significant, vector
from seafoam.ocean.basics.dispersion import wavevector
from seafoam.ocean.coast.rocks import splash_height
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.ocean.waves.rings import ring_slope
from seafoam.quality import Quality
from seafoam.scene import Light, Scene, Shore
from seafoam.sums import summed
from seafoam.textures.shore import ROWS, ShoreFloor, ShoreProfiles, ShoreTravel

PERIOD = 2.0**18
"""Side of the square in which the shore repeats, m: farther than any camera sees."""
LAND_CELLS, LAND_COARSEST, LAND_ROUNDS = 128, 4, 64
"""Cells along a side of the finest (texels, if fewer) and coarsest level of the land's maxima; cells read per ray."""
LAND_LIGHT = {False: "shore/land.glsl@land_lit", True: "shore/land.glsl@land_film"}
"""The file that lights land, by whether it has detail."""
_WAVES = {False: "shore/waves.glsl@still", True: "shore/waves.glsl@waves"}
FILM_DRIES, SAND_DRIES = 4.0, 40.0
"""Times in which the film of water on sand and the sand dry to 1/e, s."""
SUN_RADIUS = 0.00465
"""Angular radius of the sun and of the moon, rad."""
LOWEST_RISE = 1e-3
"""Least slope of a sight of the sun's rim."""
SUNLIT_FROM = (*GROUND, "shore/sunlit.glsl@sunlit_from")
"""Files of the heights from which the sun is seen over the land."""
NO_SHADOWS = ("shore/sunlit.glsl@sunlit_from_none",)


def soil_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the land's material; the noise library and shore/ground.glsl@ground come before them."""
    assert scene.shore is not None
    if scene.shore.detail <= 0.0:
        return ("shore/soil.glsl@soil_struct", "shore/soil.glsl@soil_plain")
    soil = "shore/soil.glsl@soil"
    if splash_height(scene.shore, scene.spray) == 0.0:
        return (*SLOPES, "shore/soil.glsl@soil_struct", soil)
    dry = Source(soil, (("land_soil", "land_soil_dry"),))
    return (*SLOPES, "shore/soil.glsl@soil_struct", dry, "shore/soil.glsl@splashed")


def _shadows(scene: Scene, shore: Shore, drawn: bool, quality: Quality) -> Contribution | None:
    light = scene.light
    if light is None:
        return None
    ground = ("shore/ground.glsl@place", "shore/ground.glsl@square", "shore/ground.glsl@spline")
    needs = (*ground, "shore/land.glsl@land_maxima")
    return Contribution(
        why="how much of the sun is seen over the land",
        slots=(SlotFile("open sun", "shore/sunlit.glsl@sunlit", prefix="land", needs=needs),),
        consts={"SHADOW_STEPS": quality.shadow_steps},
        uniforms={"u_land_sun": vector(rounded(sights(light)))},
        bound=Bound.zero_if(not _lit(light), "the sun is below the horizon")
        or Bound.zero_if(limits(shore, quality).land_top <= -0.6 * shore.deep, "no land is above the water"),
    )


def sights(light: Light) -> tuple[float, float, float, float]:
    """Level unit vector toward the sun, (x, z), and the slopes of the sights of its upper and lower rim."""
    x, y, z = lamp(light)
    elevation = math.atan2(y, math.hypot(x, z))
    level = max(math.hypot(x, z), 1e-6)
    upper = min(elevation + SUN_RADIUS, 1.5)
    lower = min(elevation - SUN_RADIUS, 1.49)
    return x / level, z / level, max(math.tan(upper), LOWEST_RISE), max(math.tan(lower), LOWEST_RISE)


def _lit(light: Light) -> bool:
    return bool(sun_irradiance(light).any())


def _unshadowed(scene: Scene) -> Scene:
    assert scene.shore is not None
    return scene.model_copy(update={"shore": scene.shore.model_copy(update={"shadows": False})})


def _draw(scene: Scene, shore: Shore, quality: Quality) -> Contribution:
    surf, bounds = shore.surf, limits(shore, quality)
    steepest, curvature = _steepest(scene, bounds)
    cells, splash = min(LAND_CELLS, quality.shore_floor), splash_height(shore, scene.spray)
    thrown = shore.shadows and scene.light is not None and _lit(scene.light)
    # The travel time of a swell that the depth refracts.
    travel = {"shore_travel": TextureUse(ShoreTravel(shore=shore, texels=quality.shore_map), wrap="clamp_to_edge")}
    profiles = ShoreProfiles(nodes=quality.shore_profile, skew=surf.skew, sharpness=surf.sharpness)
    return Contribution(
        why=f"{shore.kind}, {shore.size:g} m square" + (f", waves of {surf.height:g} m" if surf.height > 0.0 else ""),
        slots=_slots(scene, shore),
        consts={**_consts(shore, quality, cells), "FILM_ROUGHNESS": _roughness(scene, shore)},
        uniforms={
            **_uniforms(shore, bounds, steepest, curvature),
            **({"u_land_splash": number(significant(splash))} if splash > 0.0 else {}),
            **({} if scene.light is None else bed_sun(scene.light)),
        },
        textures={
            "shore_floor": TextureUse(ShoreFloor(shore=shore, texels=quality.shore_floor), wrap="clamp_to_edge"),
            **(travel if surf.refraction else {}),
            "shore_profiles": TextureUse(profiles),
        },
        targets=map_targets(shore, quality, cells),
        passes=map_passes(shore, quality, SUNLIT_FROM if thrown else NO_SHADOWS),
        min_ground=-shore.deep,
        bound=_bound(scene, shore, bounds.land_top),
        max_height=surf.height,
        max_slope=steepest,
        max_curvature=curvature,
        march_factor=2,
        # A run-up is thin, and rays along it nearly level: at the march's tolerance alone its edge flickers.
        refine=1 if surf.height > 0.0 else 0,
    )


def _roughness(scene: Scene, shore: Shore) -> float:
    """Mean square slope of the film of water on land."""
    if shore.detail <= 0.0:
        return 0.02
    return 0.003 if splash_height(shore, scene.spray) == 0.0 else 0.04


def _slots(scene: Scene, shore: Shore) -> tuple[SlotFile, ...]:
    lit = scene.light is not None
    field = ("shore/waves.glsl@field",) if shore.surf.height > 0.0 else ()
    waves = ("shore/ground.glsl@place", *GROUND, *VALUE_NOISE, *field)
    # Water without light takes its colour by the same file, but does not fill the slot of the water's body.
    body = () if lit else ("shore/floor.glsl@body",)
    plain, detailed = ("shore/floor.glsl@shallow_plain",), (*soil_files(scene), "shore/floor.glsl@shallow")
    shallow = detailed if shore.detail > 0.0 else plain
    through = ("lib/refraction.glsl", "shore/ground.glsl@ground", *shallow, *body)
    light = LAND_LIGHT[shore.detail > 0.0] if lit else "shore/land.glsl@land_flat"
    wet = "shore/soil.glsl@wet" if shore.detail > 0.0 and shore.surf.height > 0.0 else "shore/soil.glsl@wet_still"
    soil = ("shore/ground.glsl@ground", *soil_files(scene), wet)
    start = ("surface/bounds.glsl@pyramid", "shore/ground.glsl@ground", *MAXIMA)
    floor = ("water/seafloor.glsl@even", "shore/ground.glsl@bed")
    underwater = (
        SlotFile("reach", "shore/march.glsl@reach", needs=MARCH_GROUND),
        SlotFile("under bed", "water/seafloor.glsl@floor", needs=floor),
    )
    return (
        SlotFile("shore", _WAVES[shore.surf.height > 0.0], needs=waves),
        *((SlotFile("body", "shore/floor.glsl@body"),) if lit else ()),
        SlotFile("through", "shore/floor.glsl@through", needs=through),
        SlotFile("land", "shore/waves.glsl@ahead", needs=FIND_LAND),
        SlotFile("land soil", "shore/floor.glsl@soil_found", needs=soil),
        SlotFile("land color", "shore/floor.glsl@color", needs=(light,)),
        SlotFile("beyond", "shore/march.glsl@beyond"),
        SlotFile("approach", "shore/march.glsl@approach", needs=(MARCH_AHEAD,)),
        SlotFile("start", "shore/march.glsl@start", prefix="land", needs=start),
        *(underwater if lit else ()),
    )


def _consts(shore: Shore, quality: Quality, cells: int) -> dict[str, Const]:
    return {
        "SHORE_PERIOD": PERIOD,
        "REFRACTION_STEPS": quality.refraction_steps,
        "FLOOR_TEXELS": quality.shore_floor,
        "MAP_TEXELS": quality.shore_map,
        "PROFILE_NODES": quality.shore_profile,
        "PROFILE_ROWS": ROWS,
        "SURF": shore.surf.height > 0.0,
        "SPREAD_REACH": min(max(math.ceil(3.0 * blur_deviation(shore, quality.shore_map)), 1), 48),
        "LAND_CELLS": cells,
        "LAND_COARSEST": LAND_COARSEST,
        "LAND_ROUNDS": LAND_ROUNDS,
        "LAND_OCTAVES": quality.land_octaves,
    }


def _uniforms(shore: Shore, bounds: Limits, steepest: float, curvature: float) -> dict[str, Uniform]:
    """The camera's place on the shore, as phases over :data:`PERIOD`; the shore's bounds, its look and its swash."""
    turn, (x, z), surf = 2.0 * math.pi / PERIOD, shore.place, shore.surf
    place = [Phase(offset=-turn * x, rate=0.0, k=(turn, 0.0)), Phase(offset=-turn * z, rate=0.0, k=(0.0, turn))]
    return {
        "u_shore_place": array("float", place, 2),
        "u_shore_size": number(shore.size),
        "u_shore_top": number(rounded_up(max(bounds.land_top, 0.0))),
        "u_shore_steepest": constants("float", map(rounded_up, (bounds.floor_slope, bounds.land_slope))),
        "u_shore_bend": number(rounded_up(bounds.floor_curvature)),
        # A thousandth less: the shader subtracts these from sums of bounds that have been rounded up.
        "u_shore_bounds": vector((0.999 * steepest, 0.999 * curvature)),
        "u_shore_plants_from": number(shore.plants_from, "/shore/plants_from"),
        "u_shore_reef": number(shore.reef, "/shore/reef"),
        "u_shore_sand": vector(shore.sand, "/shore/sand"),
        "u_shore_rock": vector(shore.rock, "/shore/rock"),
        "u_shore_plants": vector(shore.plants, "/shore/plants"),
        "u_shore_time": array("float", [Phase(offset=0.0, rate=-2.0 * math.pi / surf.period, k=(0.0, 0.0))], 1),
        "u_shore_swash": number(significant(0.3 * surf.height)),
        "u_land_detail": number(shore.detail),
        "u_land_strand": number(significant(0.4 * surf.height + 0.12)),
        "u_land_dries": vector((significant(FILM_DRIES / surf.period), significant(SAND_DRIES / surf.period))),
    }


def _steepest(scene: Scene, bounds: Limits) -> tuple[float, float]:
    """Upper bounds of what the shore adds to the surface's slope and to its second derivative, 1/m."""
    swing, share, open_slope = max_displacement(scene), bounds.open_share_slope, ring_slope(scene)
    for wave in scene.waves:
        k = math.hypot(*wavevector(wave, scene.water.depth))
        open_slope += wave.amplitude * k * max_profile_slope(wave.exponent)
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        open_slope += summed(tile.max_slope for tile in cascades(scene.sea, scene.water.depth)[:RAISED])
    # The open sea's share enters its slope twice, and varies smoothly over the length of its own ramp.
    curvature = bounds.wave_curvature + 2.0 * share * open_slope + 6.0 * share**2 * swing
    return rounded_up(bounds.wave_slope + share * swing), rounded_up(curvature)


def _bound(scene: Scene, shore: Shore, top: float) -> Bound | None:
    """Without a coast there is no surf; a floor too deep to affect waves is visible only by the light it reflects."""
    if top >= -0.6 * shore.deep:
        return None
    if scene.light is None:
        return Bound(0.0, "no coast, and no light on the floor")
    why = f"no coast, and no light returns from a depth of {-top:.3g} m"
    return Bound(floor_limit(scene, scene.light, -top), why, FLOOR_FIELDS)


EFFECT = part_effect(
    "shore",
    _draw,
    "/shore",
    QualityParameter("/shore_map", "texels of the distance map", (64, 128, 256, 512), "geometry"),
    QualityParameter("/shore_floor", "texels of the height field", (64, 128, 256, 512), "geometry"),
    QualityParameter("/land_octaves", "octaves of the land's detail", (3, 4, 5, 6, 7), "geometry"),
    QualityParameter("/refraction_steps", "steps of the refracted ray", (1, 2, 4, 8, 16), "geometry"),
    QualityParameter("/shore_profile", "nodes of the wave profile table", (32, 64, 128, 256), "geometry"),
    fields=("/shore/surf",),
    without=lambda scene: scene.model_copy(update={"shore": None}),
)
SHADOWS = part_effect(
    "shadows of land",
    _shadows,
    "/shore/shadows",
    QualityParameter("/shadow_steps", "steps toward the sun over the land", (32, 64, 128, 256), "geometry"),
    without=_unshadowed,
)
