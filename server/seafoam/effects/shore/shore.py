"""A shore: sea floor, land, surf, and water coloured by the way through it. docs/formulae.md, section 8."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, surface_top, surface_trough
from seafoam.effects.effect import Bound, Contribution, Effect, Knob, PassSpec, Piece, SlotFile, TextureUse, refine
from seafoam.effects.light.noise import VALUE_NOISE
from seafoam.effects.water.seafloor import bed_sun
from seafoam.effects.waves.parametric import steepest_profile
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, TextureInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, array, number, significant, vector
from seafoam.ocean.cascades import RAISED, cascades
from seafoam.ocean.dispersion import wavevector
from seafoam.ocean.rings import ring_slope
from seafoam.ocean.seabed import floor_grid
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore
from seafoam.textures import ROWS, shore_floor_name, shore_profiles, shore_profiles_name

PERIOD = 2.0**18
"""The shore stands once in a square of so many metres; no eye sees so far."""
MASK_WAVES = ((83.0, 0.4, 31.0), (57.0, 2.1, 23.0), (119.0, 3.6, 43.0), (71.0, 5.3, 37.0))
"""The mask that breaks the rhythm: wavelength (m), heading (rad) and period (s) of its four sines."""

LAND_CELLS, LAND_COARSEST, LAND_ROUNDS = 128, 4, 64
"""Cells along a side of the finest (texels, if fewer) and coarsest level of land's tree; cells a beam asks at most."""
_GROUND = ("shore/square.glsl", "shore/spline.glsl", "shore/floor.glsl")
"""The height field. Without the eye's place, so that the map's passes are drawn once."""
MARCH_GROUND: tuple[Piece, ...] = (
    "surface/begin.glsl",
    "shore/ground.glsl",
    "shore/march.glsl",
    refine("refine_ground", "shore_floor", "vec4"),
)
FIND_LAND: tuple[Piece, ...] = (*MARCH_GROUND, "shore/maxima.glsl", "shore/find_land.glsl")
"""What finds the land that the eye's rays meet."""


def _smooth(low: float, high: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
    t = np.clip((x - low) / max(high - low, 1e-6), 0.0, 1.0)
    result: NDArray[np.float64] = t * t * (3.0 - 2.0 * t)
    return result


def _limits(shore: Shore, quality: Quality) -> tuple[float, ...]:
    """:func:`_measured` of the shore, whatever its place and its colours."""
    plain = Shore()
    same = {name: getattr(plain, name) for name in ("place", "sand", "rock", "plants", "plants_from", "reef")}
    return _measured(shore.model_copy(update=same), quality.shore_map, quality.shore_floor, quality.shore_profile)


@lru_cache(maxsize=32)
def _measured(shore: Shore, map_texels: int, floor_texels: int, nodes: int) -> tuple[float, ...]:
    """Greatest slope of shore waves, of the open sea's share (1/m), of floor and of land over y = 0; height of land, m;
    greatest second derivative of shore waves, 1/m.

    Of waves at every texel in every phase, as high as they can be there: without the mask, the exposure and the ridges,
    which lower them; a tenth is added for what lies between.
    """
    floor = floor_grid(shore, floor_texels)[..., 0]
    step = shore.size / floor_texels
    slopes = [
        math.hypot(*(float(np.abs(np.diff(part, axis=axis)).max()) / step for axis in (0, 1)))
        for part in (floor, np.maximum(floor, 0.0))
    ]
    heights = ndimage.zoom(floor, map_texels / floor_texels, order=1, grid_mode=True, mode="nearest")
    texel = shore.size / map_texels
    dry = heights >= 0.0
    if dry.all() or not dry.any():
        distance = np.full_like(heights, (-1.0 if dry.all() else 1.0) * shore.size)
    else:
        distance = (
            np.where(dry, 0.5 - ndimage.distance_transform_edt(dry), ndimage.distance_transform_edt(~dry) - 0.5) * texel
        )
    sigma = _spread(shore, map_texels)
    d = ndimage.gaussian_filter(distance, sigma, mode="nearest")
    depth = ndimage.gaussian_filter(-heights, sigma, mode="nearest")
    surf = shore.surf
    breaks = max(surf.height, 0.05) / 0.78
    low = 0.3 + 0.7 * _smooth(0.0, breaks, depth)
    shoal = np.where(depth >= breaks, (breaks / np.maximum(depth, breaks)) ** 0.25, low)
    inland = _smooth(-1.2 * max(surf.height, 0.05) / shore.slope, 0.0, d)
    tall = surf.height * shoal * inland * (1.0 - _smooth(0.45 * shore.deep, 0.9 * shore.deep, depth))
    least = max(0.3 * surf.height, 0.05)
    per_metre = 1.0 / (surf.period * np.sqrt(9.81 * (least + shore.slope * np.maximum(d, 0.0))))
    skew = 1.0 - _smooth(breaks, 2.5 * breaks, depth)
    table = shore_profiles(nodes, surf.skew, surf.sharpness).astype(np.float64)

    def change(values: NDArray[np.float64]) -> NDArray[np.float64]:
        found: NDArray[np.float64] = np.stack([np.gradient(values, texel, axis=axis) for axis in (0, 1)], axis=-1)
        return found

    # Every other texel says as much of fields this smooth.
    breaking = np.zeros_like(dry)
    breaking[::2, ::2] = tall[::2, ::2] > 0.05 * surf.height
    slope = curvature = 0.0
    if breaking.any():
        height, way = tall[breaking][:, None], change(d)[breaking]
        # A smoothed distance changes by about a metre a metre; near the texel it may reach a little more.
        way *= 1.05 / np.maximum(np.hypot(way[:, :1], way[:, 1:]), 1.0)
        at = skew[breaking] * (ROWS - 1)
        row = np.minimum(at.astype(int), ROWS - 2)
        share = (at - row)[:, None]
        turning = (np.roll(table, -1, axis=1) - table) * nodes
        rising = np.diff(table, axis=0) * (ROWS - 1)
        value = table[row] * (1.0 - share) + table[row + 1] * share
        turn = turning[row] * (1.0 - share) + turning[row + 1] * share
        parts = [
            height
            * (rising[row] * change(skew)[breaking][:, i : i + 1] - turn * (way[:, i] * per_metre[breaking])[:, None])
            + value * change(tall)[breaking][:, i : i + 1]
            for i in (0, 1)
        ]
        # The mask's own slope: four sines of about 75 m, through a step of 1.6.
        varies = surf.variation * 0.94 * 0.5 * sum(2.0 * math.pi / length for length, _, _ in MASK_WAVES)
        slope = float(np.hypot(*parts).max()) + 0.5 * surf.height * varies
        # Where troughs turn up along the way to the shore; what else changes, changes far more slowly.
        bends = np.maximum(np.roll(table, -1, axis=1) - 2.0 * table + np.roll(table, 1, axis=1), 0.0).max(axis=1)
        turns = np.hypot(way[:, 0], way[:, 1]) * per_metre[breaking]
        along = np.maximum(bends[row], bends[row + 1]) * nodes**2 * turns**2 * height[:, 0]
        across = 2.0 * np.abs(turn).max(axis=1) * turns * np.hypot(*change(tall)[breaking].T)
        curvature = float((along + across).max()) + 2.0 * varies * float((np.abs(turn).max(axis=1) * turns).max())
    open_share = change(_smooth(0.0, 0.6 * shore.deep, depth))
    ring = 1.5 * 0.9 / (0.25 * shore.radius) if shore.kind == "lagoon" else 0.0
    shared = float(np.hypot(open_share[..., 0], open_share[..., 1]).max()) + ring
    return 1.1 * slope, shared, slopes[0], slopes[1], float(floor.max()), 1.1 * curvature


def _spread(shore: Shore, texels: int) -> float:
    """Standard deviation of the smoothing, texels; at most a twelfth of the map."""
    return min(shore.smoothing * texels / shore.size, texels / 12.0)


def _up(value: float) -> float:
    """The next number of 3 significant digits: hides the last bits that processors disagree on."""
    if value <= 0.0:
        return 0.0
    scale = 10.0 ** (math.floor(math.log10(value)) - 2)
    return significant(math.ceil(value * 1.02 / scale) * scale)


def _place(shore: Shore) -> dict[str, Uniform]:
    turn = 2.0 * math.pi / PERIOD
    x, z = shore.place
    return {
        "u_shore_place": array(
            "float",
            [
                Phase(offset=-turn * x, rate=0.0, k=(turn, 0.0)),
                Phase(offset=-turn * z, rate=0.0, k=(0.0, turn)),
            ],
            2,
        ),
        "u_shore_size": number(shore.size),
    }


def map_passes(shore: Shore, quality: Quality) -> tuple[PassSpec, ...]:
    """The passes that draw the map: nearest points by jump flooding, distances, smoothing, and what waves need."""
    texels, surf = quality.shore_map, shore.surf
    floor = {"u_shore_floor": TextureInput(texture="shore_floor")}

    def one(
        name: str, files: tuple[str, ...], target: str, read: dict[str, str], uniforms: dict[str, Uniform] | None = None
    ) -> PassSpec:
        return PassSpec(
            name=f"shore: {name}",
            program=f"shore_{name.split(',')[0].replace(' ', '_')}",
            fragment=files,
            target=target,
            inputs={**floor, **{sampler: TargetInput(target=source) for sampler, source in read.items()}},
            uniforms=uniforms or {},
        )

    passes = [
        one("highest land", ("shore/tree.glsl", "shore/maxima_pass.glsl"), "land_cells", {}),
        one(
            "highest land around",
            ("shore/tree.glsl", "shore/around_pass.glsl"),
            "land_maxima",
            {"u_land_cells": "land_cells"},
        ),
    ]
    passes.append(one("seed", (*_GROUND, "shore/seed_pass.glsl"), "shore_near_0", {}))
    steps = [1]
    while (step := texels >> len(steps)) >= 1:
        steps.append(step)
    for i, step in enumerate(steps):
        passes.append(
            one(
                f"flood, {step} texels",
                ("shore/flood_pass.glsl",),
                f"shore_near_{(i + 1) % 2}",
                {"u_nearest": f"shore_near_{i % 2}"},
                {"u_flood_step": number(float(step))},
            )
        )
    passes.append(
        one(
            "distance",
            (*_GROUND, "shore/distance_pass.glsl"),
            "shore_rough",
            {"u_nearest": f"shore_near_{len(steps) % 2}"},
        )
    )
    for side, source, target in (((1.0, 0.0), "shore_rough", "shore_half"), ((0.0, 1.0), "shore_half", "shore_smooth")):
        passes.append(
            one(
                f"blur, {'x' if side[0] else 'z'}",
                ("shore/blur_pass.glsl",),
                target,
                {"u_rough": source},
                {"u_blur_side": vector(side), "u_shore_spread": number(significant(_spread(shore, texels)))},
            )
        )
    turns = [(2.0 * math.pi / length, heading, period) for length, heading, period in MASK_WAVES]
    passes.append(
        one(
            "map",
            ("lib/numbers.glsl", "shore/map_pass.glsl"),
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
                "u_surf_mask": Uniform(
                    type="vec2",
                    count=4,
                    rules=tuple(
                        rule
                        for k, heading, _ in turns
                        for rule in vector(
                            (significant(k * math.cos(heading)), significant(k * math.sin(heading)))
                        ).rules
                    ),
                ),
                "u_surf_mask_phase": array(
                    "float",
                    [
                        Phase(offset=1.7 * i, rate=2.0 * math.pi / period, k=(0.0, 0.0))
                        for i, (_, _, period) in enumerate(turns)
                    ],
                    4,
                ),
            },
        )
    )
    return tuple(passes)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``shore``."""
    shore = scene.shore
    if shore is None:
        return None
    surf = shore.surf
    slope, share, floor_slope, land_slope, land_top, curvature = _limits(shore, quality)
    swing = max(surface_top(scene), -surface_trough(scene))
    steepest = _up(slope + share * swing)
    # The open sea's share changes its slope twice, and is smooth over the length of its own ramp.
    bend = _up(curvature + 2.0 * share * _open_slope(scene) + 6.0 * share**2 * swing)
    lit = scene.light is not None
    cells = min(LAND_CELLS, quality.shore_floor)
    texels = FixedSize(width=quality.shore_map, height=quality.shore_map)
    reach = min(max(math.ceil(3.0 * _spread(shore, quality.shore_map)), 1), 48)
    under = (
        SlotFile("reach", "shore/reach.glsl", needs=MARCH_GROUND),
        SlotFile("under bed", "water/seafloor/floor.glsl", needs=("water/seafloor/even.glsl", "shore/bed.glsl")),
    )
    return Contribution(
        why=f"{shore.kind}, {shore.size:g} m square" + (f", waves of {surf.height:g} m" if surf.height > 0.0 else ""),
        slots=(
            SlotFile(
                "shore",
                "shore/waves.glsl",
                needs=(
                    "shore/place.glsl",
                    *_GROUND,
                    *VALUE_NOISE,
                    "shore/field.glsl",
                ),
            ),
            *((SlotFile("body", "shore/body.glsl"),) if lit else ()),
            SlotFile(
                "through",
                "shore/through.glsl",
                needs=("lib/refraction.glsl", "shore/ground.glsl", *(() if lit else ("shore/body.glsl",))),
            ),
            SlotFile(
                "land",
                "shore/before.glsl",
                needs=FIND_LAND,
            ),
            SlotFile(
                "land color",
                "shore/color.glsl",
                needs=(
                    "shore/ground.glsl",
                    f"shore/land_{'lit' if lit else 'flat'}.glsl",
                ),
            ),
            SlotFile("beyond", "shore/beyond.glsl"),
            SlotFile(
                "start",
                "shore/start.glsl",
                prefix="land",
                needs=("surface/pyramid.glsl", "shore/ground.glsl", "shore/maxima.glsl"),
            ),
            *(under if lit else ()),
        ),
        consts={
            "SHORE_PERIOD": PERIOD,
            "REFRACTION_STEPS": quality.refraction_steps,
            "FLOOR_TEXELS": quality.shore_floor,
            "MAP_TEXELS": quality.shore_map,
            "PROFILE_NODES": quality.shore_profile,
            "PROFILE_ROWS": ROWS,
            "SPREAD_REACH": reach,
            "LAND_CELLS": cells,
            "LAND_COARSEST": LAND_COARSEST,
            "LAND_ROUNDS": LAND_ROUNDS,
        },
        uniforms={
            **_place(shore),
            "u_shore_time": array("float", [Phase(offset=0.0, rate=-2.0 * math.pi / surf.period, k=(0.0, 0.0))], 1),
            "u_shore_top": number(_up(max(land_top, 0.0))),
            "u_shore_steepest": array("float", [Constant(value=(_up(s),)) for s in (floor_slope, land_slope)], 2),
            **({} if scene.light is None else bed_sun(scene.light)),
            # A thousandth less: bounds are rounded up on their way to where these are taken away again.
            "u_shore_bounds": vector((0.999 * steepest, 0.999 * bend)),
            "u_shore_swash": number(significant(0.3 * surf.height)),
            "u_shore_plants_from": number(shore.plants_from, "/shore/plants_from"),
            "u_shore_reef": number(shore.reef, "/shore/reef"),
            "u_shore_sand": vector(shore.sand, "/shore/sand"),
            "u_shore_rock": vector(shore.rock, "/shore/rock"),
            "u_shore_plants": vector(shore.plants, "/shore/plants"),
        },
        inputs={
            "u_shore_floor": TextureInput(texture="shore_floor"),
            "u_shore_profiles": TextureInput(texture="shore_profiles"),
            "u_shore_map": TargetInput(target="shore_map"),
            "u_land_maxima": TargetInput(target="land_maxima"),
        },
        textures={
            "shore_floor": TextureUse(shore_floor_name(shore, quality.shore_floor), wrap="clamp_to_edge"),
            "shore_profiles": TextureUse(shore_profiles_name(surf.skew, surf.sharpness, quality.shore_profile)),
        },
        targets={
            **{
                name: Target(size=FixedSize(width=2 * cells, height=cells), format="RGBA16F")
                for name in ("land_cells", "land_maxima")
            },
            **{f"shore_near_{i}": Target(size=texels, format="RGBA16F") for i in range(2)},
            **{f"shore_{name}": Target(size=texels, format="RGBA32F") for name in ("rough", "half", "smooth", "map")},
        },
        passes=map_passes(shore, quality),
        bottom=-shore.deep,
        bound=_bound(scene, shore, land_top),
        top=surf.height,
        steepest=steepest,
        curvature=bend,
        march=2,
    )


def _open_slope(scene: Scene) -> float:
    """No slope of the open sea's waves is steeper."""
    steepest = ring_slope(scene)
    for wave in scene.waves:
        steepest += wave.amplitude * math.hypot(*wavevector(wave, scene.water.depth)) * steepest_profile(wave.exponent)
    if scene.sea is not None and scene.sea.wind > 0.0:
        steepest += sum(of.steepest for of in cascades(scene.sea, scene.water.depth)[:RAISED])
    return steepest


def _bound(scene: Scene, shore: Shore, top: float) -> Bound | None:
    """Without a coast there is no surf; a floor below where waves feel it shows by its light alone."""
    if top >= -0.6 * shore.deep:
        return None
    if scene.light is None:
        return Bound(0.0, "no coast, and no light on the floor")
    return Bound(
        floor_limit(scene, scene.light, -top), f"no coast, and no light comes back from {-top:.3g} m", FLOOR_FIELDS
    )


EFFECT = Effect(
    "shore",
    contribute,
    knobs=(
        Knob("/shore_map", "texels of the distance map", (64, 128, 256, 512), "geometry"),
        Knob("/shore_floor", "texels of the height field", (64, 128, 256, 512), "geometry"),
        Knob("/refraction_steps", "steps of the refracted ray", (1, 2, 4, 8, 16), "geometry"),
        Knob("/shore_profile", "nodes of the wave profile table", (32, 64, 128, 256), "geometry"),
    ),
)
