"""The passes that draw a shore's maps: maxima of the land, distance from the coast, and what waves need at a place.

docs/formulae.md, section 8.
"""

import math

from seafoam.effects.effect import PassSpec
from seafoam.effects.shader import Piece, refine
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Phase, Rule, Uniform, array, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene import Shore

MASK_WAVES = ((83.0, 0.4, 31.0), (57.0, 2.1, 23.0), (119.0, 3.6, 43.0), (71.0, 5.3, 37.0))
"""The mask that varies the surf's height: wavelength (m), heading (rad) and period (s) of its four sines."""
GROUND = ("shore/ground.glsl@square", "shore/ground.glsl@spline", "shore/floor.glsl@floor")
"""The height field. Its files do not declare the camera's position, so that the map's passes are drawn once."""
MAXIMA = ("shore/land.glsl@land_maxima", "shore/march.glsl@maxima")
"""The tree of the land's maxima."""
MARCH_GROUND: tuple[Piece, ...] = (
    "surface/march.glsl@step",
    "surface/march.glsl@begin",
    "shore/ground.glsl@ground",
    "shore/march.glsl@march",
    refine("refine_ground", "shore_floor", "vec4"),
)
"""Files that march along a ray to the ground."""
FIND_LAND: tuple[Piece, ...] = (*MARCH_GROUND, *MAXIMA, "shore/land.glsl@find_land")
"""Files that find the land that a ray from the camera meets."""


def blur_deviation(shore: Shore, texels: int) -> float:
    """Standard deviation of the map's smoothing, texels; at most a twelfth of the map."""
    return min(shore.smoothing * texels / shore.size, texels / 12.0)


def map_targets(shore: Shore, quality: Quality, land_cells: int) -> dict[str, Target]:
    """Targets of :func:`map_passes`; ``land_cells``: cells along a side of the finest level of the land's maxima."""
    texels = FixedSize.square(quality.shore_map)
    share = Target(size=FixedSize(width=3 * quality.shore_map, height=quality.shore_map), format="RGBA32F")
    land = Target(size=FixedSize(width=2 * land_cells, height=land_cells), format="RGBA16F")
    return {
        **dict.fromkeys(("land_cells", "land_maxima"), land),
        **{f"shore_near_{i}": Target(size=texels, format="RGBA16F") for i in range(2)},
        **{f"shore_{name}": Target(size=texels, format="RGBA32F") for name in ("rough", "half", "smooth", "map")},
        **({} if shore.surf.height > 0.0 else {"shore_share": share}),
    }


def map_passes(shore: Shore, quality: Quality, sunlit_from: tuple[str, ...]) -> tuple[PassSpec, ...]:
    """The passes that draw the maps, in order; ``sunlit_from``: files of the heights from which the sun is seen."""
    flood, nearest = _flood_passes(quality.shore_map)
    distance = _pass("distance", (*GROUND, "shore/maps.glsl@distance"), "shore_rough", {"u_nearest": nearest})
    # Maxima of the land's height, level by level, and of each cell with its neighbours.
    around = ("shore/land.glsl@tree", *sunlit_from, "shore/maps.glsl@around")
    land = (
        _pass("highest land", ("shore/land.glsl@tree", "shore/march.glsl@maxima_pass"), "land_cells"),
        _pass("highest land around", around, "land_maxima"),
    )
    share = _pass("share", ("lib/texels.glsl@texel", "shore/maps.glsl@share"), "shore_share")
    waves = (_wave_pass(shore), *(() if shore.surf.height > 0.0 else (share,)))
    return (*land, *flood, distance, *_blur_passes(shore, quality.shore_map), *waves)


def _pass(
    name: str,
    files: tuple[str, ...],
    target: str,
    read: dict[str, str] | None = None,
    uniforms: dict[str, Uniform] | None = None,
) -> PassSpec:
    """``name``: up to a comma that of the program too; ``read``: sampler -> target."""
    program = f"shore_{name.split(',')[0].replace(' ', '_')}"
    return PassSpec(f"shore: {name}", program, files, read or {}, uniforms or {}, target)


def _flood_passes(texels: int) -> tuple[list[PassSpec], str]:
    """Nearest land and sea of every texel by jump flooding, and the target that holds them at the end."""
    passes = [_pass("seed", (*GROUND, "shore/maps.glsl@seed"), "shore_near_0")]
    # A first step of 1 texel corrects most of what the halved steps miss.
    steps = [1]
    while (step := texels >> len(steps)) >= 1:
        steps.append(step)
    for i, step in enumerate(steps):
        source, target = f"shore_near_{i % 2}", f"shore_near_{(i + 1) % 2}"
        read, uniforms = {"u_nearest": source}, {"u_flood_step": number(float(step))}
        passes.append(_pass(f"flood, {step} texels", ("shore/maps.glsl@flood",), target, read, uniforms))
    return passes, f"shore_near_{len(steps) % 2}"


def _blur_passes(shore: Shore, texels: int) -> list[PassSpec]:
    deviation = number(significant(blur_deviation(shore, texels)))
    sides = (("x", (1.0, 0.0), "shore_rough", "shore_half"), ("z", (0.0, 1.0), "shore_half", "shore_smooth"))
    passes = []
    for name, side, source, target in sides:
        uniforms = {"u_blur_side": vector(side), "u_shore_spread": deviation}
        passes.append(_pass(f"blur, {name}", ("shore/maps.glsl@blur",), target, {"u_rough": source}, uniforms))
    return passes


def _wave_pass(shore: Shore) -> PassSpec:
    """Phase, height and skew of the shore's waves at a place, and the share of the open sea's waves there."""
    surf = shore.surf
    arrives = "shore/maps.glsl@arrives_refracted" if surf.refraction else "shore/maps.glsl@arrives_normal"
    return _pass(
        "map",
        ("lib/numbers.glsl", "shore/maps.glsl@map_begin", arrives, "shore/maps.glsl@map"),
        "shore_map",
        {"u_smooth": "shore_smooth"},
        {
            "u_shore_deep": number(shore.deep),
            "u_shore_slope": number(shore.slope),
            "u_shore_shelter": number(shore.radius if shore.kind == "lagoon" else 0.0),
            "u_surf_height": number(surf.height),
            "u_surf_period": number(surf.period),
            "u_surf_variation": number(surf.variation),
            "u_surf_heading": vector((significant(math.cos(surf.heading)), significant(math.sin(surf.heading)))),
            "u_surf_exposure": number(surf.exposure),
            **mask_uniforms(moves=surf.height > 0.0),
        },
    )


def mask_uniforms(*, moves: bool = True) -> dict[str, Uniform]:
    vectors: list[Rule] = []
    phases: list[Rule] = []
    for i, (length, heading, period) in enumerate(MASK_WAVES):
        k = 2.0 * math.pi / length
        vectors += vector((significant(k * math.cos(heading)), significant(k * math.sin(heading)))).rules
        phases.append(Phase(offset=1.7 * i, rate=2.0 * math.pi / period if moves else 0.0, k=(0.0, 0.0)))
    count = len(MASK_WAVES)
    return {"u_surf_mask": array("vec2", vectors, count), "u_surf_mask_phase": array("float", phases, count)}
