"""Caustics: sunlight that ripples focus on a level floor, drawn into a map each frame. docs/formulae.md, section 11."""

import math

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, surface_trough
from seafoam.effects.effect import Bound, Const, Contribution, Effect, Knob, PassSpec, SlotFile
from seafoam.effects.light.light import sun_direction
from seafoam.framegraph.passes import Grid, Points
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.refraction import INDEX, refracted_cosine
from seafoam.ocean.ripples import Ripple, ripples, tiles
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Chop

COLOURS = ("red", "green", "blue")
COLOUR_INDEX = (-0.0033, 0.0, 0.0042)
"""Index of water for red, green and blue, less that for green (Daimon and Masumura 2007: 650, 550 and 450 nm)."""
RIM = 4
"""Texels around the map that a photon on its edge, or the smoothing there, can reach."""
MOST_SPREAD = 4.0
"""Where light spreads farther, the grid's triangles cover the map many times over; photons cost alike at any depth."""
SHIFTED = 0.125
"""Colours whose light lands as far beside green's wherever it enters, to so many half texels, are drawn by one grid."""
MOST_SHIFT = 8.0
"""Half texels from green's light to that of a colour that one grid is drawn for, at most."""
_LEVEL = 0.25
"""No ray falls by less: its cosine to the vertical."""
_TALLEST = 4.0
"""Slopes are taken to stay below so many standard deviations, beyond the tile's end too."""


def landing(light: Light, depth: float, slope: tuple[float, float], index: float = INDEX) -> tuple[float, float]:
    """How far beside the place where the sun's light enters at a slope it lands on the floor, m."""
    sun = sun_direction(light)
    size = math.sqrt(1.0 + slope[0] ** 2 + slope[1] ** 2)
    n = (-slope[0] / size, 1.0 / size, -slope[1] / size)
    c = max(sum(a * b for a, b in zip(n, sun, strict=True)), 0.0)
    turn = c / index - refracted_cosine(c, index)
    ray = tuple(turn * a - b / index for a, b in zip(n, sun, strict=True))
    way = depth / max(-ray[1], _LEVEL)
    return ray[0] * way, ray[2] * way


def _tall(chop: Chop) -> list[tuple[float, float]]:
    """Slopes of every heading up to the tallest."""
    angles = [2.0 * math.pi * i / 64 for i in range(64)]
    sizes = [share * _TALLEST * chop.slope for share in (0.25, 0.5, 0.75, 1.0)]
    return [(size * math.cos(angle), size * math.sin(angle)) for angle in angles for size in sizes]


def _shifts(
    light: Light, depth: float, chop: Chop, indices: tuple[float, ...], half: float
) -> list[tuple[float, float]]:
    """How far beside green's the light of each index lands, in half texels of ``half`` m; empty: not evenly far."""
    slopes = [(0.0, 0.0), *_tall(chop)]
    green = [landing(light, depth, slope) for slope in slopes]
    shifts = []
    for index in indices:
        there = (landing(light, depth, slope, index) for slope in slopes)
        # The first is what level water makes of it.
        (x, z), *others = [((b[0] - a[0]) / half, (b[1] - a[1]) / half) for a, b in zip(green, there, strict=True)]
        if any(max(abs(u - x), abs(v - z)) > SHIFTED for u, v in others) or max(abs(x), abs(z)) > MOST_SHIFT:
            return []
        shifts.append((x, z))
    return shifts


def _bspline(x: float) -> float:
    """The uniform cubic one, x in texels."""
    a = abs(x)
    return (4.0 - 6.0 * a * a + 3.0 * a**3) / 6.0 if a < 1.0 else max(2.0 - a, 0.0) ** 3 / 6.0


def _smoothing(shifts: list[tuple[float, float]]) -> tuple[int, int, dict[str, Uniform]]:
    """Half texels before a texel's first that smoothing reads, how many along a side, and the weights of each colour.

    What a spline leaves from 7/4 texel on, 0.26 % at most, is shared out.
    """
    span = math.ceil(MOST_SHIFT) + 4
    places = [m for m in range(-span, span + 1) if any(abs(m - 0.5 + part) < 3.5 for both in shifts for part in both)]
    uniforms = {}
    for axis, name in enumerate(("u_caustic_across", "u_caustic_along")):
        columns = []
        for shift in shifts:
            away = [0.5 * (m - 0.5 + shift[axis]) for m in places]
            weights = [_bspline(x) if abs(x) < 1.75 else 0.0 for x in away]
            columns.append([significant(weight / sum(weights)) for weight in weights])
        rows = [Constant(value=row) for row in zip(*columns, strict=True)]
        uniforms[name] = array("vec3", rows, len(rows))
    return -places[0], len(places), uniforms


def _margin(light: Light, depth: float, chop: Chop, tile: float, cells: int) -> int:
    """Cells beyond the tile from which light may land in it; at most a tile's."""
    flat = landing(light, depth, (0.0, 0.0))
    reach = 0.0
    for slope in _tall(chop):
        x, z = landing(light, depth, slope)
        reach = max(reach, abs(x - flat[0]), abs(z - flat[1]))
    # Colours part by their share of the whole way, which is below a thirtieth at the greatest dispersion.
    reach += abs(flat[0]) / 30.0 + abs(flat[1]) / 30.0
    return min(math.ceil(1.05 * reach / tile * cells) + 2, cells)


def _spread(depth: float, waves: list[Ripple]) -> float:
    """How many times as wide as on the surface a bundle of light is on the floor, root mean square; without focus 1."""
    bend = math.sqrt(sum((wave.slope * wave.k) ** 2 for wave in waves) / 2.0)
    return 0.25 * depth * bend


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light.caustics`` on ripples over a level floor."""
    light, water = scene.light, scene.water
    if light is None or light.caustics is None or water.depth is None or water.chop is None or scene.shore is not None:
        return None
    tile = tiles(True)[0]
    depth = water.depth
    waves = [wave for cascade in ripples(water.chop, True) for wave in cascade]
    flat = landing(light, depth, (0.0, 0.0))
    photons = quality.caustics == "photons" or _spread(depth, waves) > MOST_SPREAD
    rays = quality.caustics_photons if photons else quality.caustics_cells
    texels = quality.caustics_size
    rim = RIM
    consts: dict[str, Const] = {"CAUSTIC_WAVES": len(waves), "CAUSTIC_TEXELS": texels}
    spread = light.caustics.dispersion
    colours = dict(zip(COLOURS, COLOUR_INDEX, strict=True)) if spread > 0.0 else {"white": 0.0}
    weights: dict[str, Uniform] = {}
    if photons:
        # Their four sums a texel take a target a colour.
        drawn = {name: f"caustic_{name}" for name in colours}
        read = {f"u_caustic_{name}": drawn.get(name, "caustic_white") for name in COLOURS}
        mesh: Grid | Points = Points(count=rays * rays)
        vertex, fragment, joined = (
            "water/caustics/photon_vertex.glsl",
            "water/caustics/photon_pass.glsl",
            "water/caustics/fold_pass.glsl",
        )
        consts |= {"CAUSTIC_PHOTONS": rays}
    else:
        indices = tuple(INDEX + spread * bent for bent in COLOUR_INDEX)
        shifts = _shifts(light, depth, water.chop, indices, 0.5 * tile / texels)
        if shifts:
            colours = {"white": 0.0}
        before, taps, weights = _smoothing(shifts or 3 * [(0.0, 0.0)])
        rim = max(RIM, before, taps - before - 2)
        drawn = dict.fromkeys(colours, "caustic_light")
        read = {"u_caustic_light": "caustic_light"}
        margin = _margin(light, depth, water.chop, tile, rays)
        mesh = Grid(rows=rays + 2 * margin, columns=rays + 2 * margin)
        vertex, fragment, joined = (
            "water/caustics/grid_vertex.glsl",
            "water/caustics/grid_pass.glsl",
            "water/caustics/smooth_pass.glsl",
        )
        consts |= {"CAUSTIC_CELLS": rays, "CAUSTIC_MARGIN": margin, "CAUSTIC_BEFORE": before, "CAUSTIC_TAPS": taps}
    consts["CAUSTIC_RIM"] = rim
    # A grid is drawn at half texels: its triangles light what centres they cover.
    rough = (texels if photons else 2 * texels) + 2 * rim
    return Contribution(
        why=f"{rays}² {'photons' if photons else 'cells'} on a tile of {tile:g} m, "
        + ("3 colours" if len(colours) > 1 else "3 colours by one, shifted" if spread > 0.0 else "one colour for all"),
        slots=(SlotFile("caustics", "water/seafloor/caustics.glsl"),),
        consts=consts,
        uniforms={
            "u_caustic_tile": number(tile),
            "u_caustic_place": array(
                "vec2",
                [
                    Wrap(k=(1.0 / tile, 0.0), offset=significant(-flat[0] / tile)),
                    Wrap(k=(0.0, 1.0 / tile), offset=significant(-flat[1] / tile)),
                ],
                1,
            ),
        },
        inputs={"u_caustics": TargetInput(target="caustics")},
        targets={
            "caustic_slopes": Target(size=FixedSize(width=rays, height=rays), format="RGBA32F"),
            **{
                target: Target(size=FixedSize(width=rough, height=rough), format="RGBA16F") for target in drawn.values()
            },
            "caustics": Target(
                size=FixedSize(width=texels, height=texels), format="RGBA16F", filter="linear", wrap="repeat"
            ),
        },
        passes=(
            PassSpec(
                name="caustics: slopes",
                program="caustic_slopes",
                fragment=("lib/numbers.glsl", "water/caustics/slopes_pass.glsl"),
                target="caustic_slopes",
                uniforms=_slopes(waves, tile),
            ),
            *(
                PassSpec(
                    name=f"caustics: {name} light",
                    program="caustic_light",
                    vertex=("lib/refraction.glsl", "water/caustics/landing.glsl", vertex),
                    fragment=(fragment,),
                    target=drawn[name],
                    mesh=mesh,
                    inputs={"u_caustic_slopes": TargetInput(target="caustic_slopes")},
                    uniforms={
                        "u_caustic_depth": number(significant(depth)),
                        "u_caustic_flat": vector((significant(flat[0]), significant(flat[1]))),
                        "u_caustic_index": number(significant(INDEX + spread * bent)),
                        "u_caustic_tile": number(tile),
                        **({} if photons else {"u_caustic_channels": _channels(name)}),
                    },
                    blend="add",
                    clear=photons or name == next(iter(colours)),
                )
                for name, bent in colours.items()
            ),
            PassSpec(
                name="caustics: map",
                program="caustic_map",
                fragment=(joined,),
                target="caustics",
                inputs={sampler: TargetInput(target=target) for sampler, target in read.items()},
                uniforms=weights,
            ),
        ),
        bound=_bound(scene, light, max(depth + surface_trough(scene), 0.0), waves),
    )


def _channels(name: str) -> Uniform:
    """1 in the channels that a colour is drawn into: white in all."""
    return vector(tuple(float(name in (one, "white")) for one in COLOURS))


def _slopes(waves: list[Ripple], tile: float) -> dict[str, Uniform]:
    return {
        "u_caustic_wave": array(
            "vec4", [Constant(value=(w.kx, w.kz, significant(w.slope), 0.0)) for w in waves], len(waves)
        ),
        "u_caustic_phase": array(
            "float", [Phase(offset=w.phase, rate=w.omega, k=(0.0, 0.0)) for w in waves], len(waves)
        ),
        "u_caustic_tile": number(tile),
    }


def _bound(scene: Scene, light: Light, depth: float, waves: list[Ripple]) -> Bound:
    """The sun's light that comes back from the floor, as many times as a texel can hold of it."""
    return Bound(
        _BRIGHTEST * floor_limit(scene, light, depth, sky=False),
        f"no sunlight comes back from {depth:g} m",
        FLOOR_FIELDS,
    )


_BRIGHTEST = 64.0
"""Light of a texel over that under level water: no figure that the tests draw is brighter."""


EFFECT = Effect(
    "caustics",
    contribute,
    knobs=(
        Knob("/caustics", "caustics", ("grid", "photons"), "geometry"),
        Knob("/caustics_size", "texels of the caustic map", (128, 256, 512, 1024), "filtering"),
        Knob("/caustics_cells", "cells of the refracted grid", (64, 128, 256, 512), "geometry"),
        Knob("/caustics_photons", "photons per side", (128, 256, 512, 1024), "geometry"),
    ),
)
