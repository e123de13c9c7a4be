"""Caustics: sunlight focused by ripples on a level floor, drawn into a map each frame. docs/formulae.md, section 11."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from seafoam.effects.bounds import FLOOR_FIELDS, floor_limit, min_surface_height
from seafoam.effects.effect import Bound, Contribution, PassSpec, QualityParameter, Resources, drawn_map, part_effect
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.shader import SlotFile
from seafoam.effects.waves.ripples import ripple_phases
from seafoam.framegraph.plan import Grid, Points
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Uniform, array, constants, in_tile, number, rounded, significant, vector
from seafoam.ocean.arrays import Floats
from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves.ripples import Ripple, ripple_cascades, tiles
from seafoam.quality import Quality
from seafoam.scene import Caustics, Light, Ripples, Scene
from seafoam.sums import summed

COLOUR_INDEX = {"red": -0.0033, "green": 0.0, "blue": 0.0042}
"""Refractive index of water at 650, 550 and 450 nm less that at 550 nm (Daimon and Masumura 2007)."""
RIM = 4
"""Border around the map, texels, that contains photons which land near the edge and the support of the smoothing."""
MAX_SPREAD = 4.0
"""Widening of a light bundle above which photons are used: the grid's triangles then overlap many times over, while
the cost of photons does not depend on the depth."""
SHIFT_TOLERANCE = 0.25
"""If a colour's light lands at a constant distance from green's, to within this many half texels for all slopes, one
grid serves all colours."""
MAX_SHIFT = 8.0
"""Greatest such distance, half texels."""
_MIN_FALL = 0.25
"""Minimum cosine of the angle between a refracted ray and the vertical."""
_MAX_DEVIATIONS = 4.0
"""Greatest slope considered, in standard deviations of the slope."""
_MAX_FOCUS = 64.0
"""Greatest brightness of a texel relative to the light under level water; above all that the tests draw."""


def landing(light: Light, depth: float, slopes: Floats, index: float = WATER_INDEX) -> Floats:
    """Distance (x, z) from where sunlight enters water of slopes (n, 2) to where it meets the floor, (n, 2) m."""
    sun = np.array(lamp(light))
    n = np.insert(-slopes, 1, 1.0, axis=1) / np.sqrt(1.0 + (slopes * slopes).sum(axis=1, keepdims=True))
    c = np.maximum((n * sun).sum(axis=1, keepdims=True), 0.0)
    ray = (c / index - np.sqrt(1.0 - (1.0 - c * c) / index**2)) * n - sun / index
    result: Floats = ray[:, ::2] * depth / np.maximum(-ray[:, 1:2], _MIN_FALL)
    return result


@dataclass(frozen=True)
class _Tile:
    """Sunlight that enters a tile of ripples over a level floor. ``depth``: m; ``side``: of the tile, m."""

    light: Light
    ripples: Ripples
    depth: float
    dispersion: float
    side: float

    @property
    def waves(self) -> list[Ripple]:
        return [wave for cascade in ripple_cascades(self.ripples, True) for wave in cascade]

    @property
    def level(self) -> tuple[float, float]:
        """Where the light lands under level water."""
        x, z = landing(self.light, self.depth, np.zeros((1, 2)))[0].tolist()
        return x, z

    @property
    def steep_slopes(self) -> Floats:
        """(n, 2) slopes in all directions up to :data:`_MAX_DEVIATIONS` standard deviations."""
        angles = 2.0 * math.pi * np.arange(64) / 64
        sizes = np.array([[0.25], [0.5], [0.75], [1.0]]) * _MAX_DEVIATIONS * self.ripples.slope
        return np.stack((sizes * np.cos(angles), sizes * np.sin(angles)), axis=-1).reshape(-1, 2)

    @property
    def spread(self) -> float:
        """Width of a light bundle on the floor relative to its width at the surface, root mean square."""
        bend = math.sqrt(summed((wave.slope * wave.k) ** 2 for wave in self.waves) / 2.0)
        return 0.25 * self.depth * bend

    def index(self, difference: float) -> float:
        """Refractive index for a colour; ``difference``: its entry in :data:`COLOUR_INDEX`."""
        return WATER_INDEX + self.dispersion * difference

    def margin(self, cells: int) -> int:
        """Width of the border of cells around the tile whose light can land in it, at most the tile's own width."""
        level = np.array(self.level)
        reach = float(np.abs(landing(self.light, self.depth, self.steep_slopes) - level).max())
        # Dispersion moves light by a fraction of the whole distance, less than a thirtieth at the greatest setting.
        reach += float(np.abs(level).sum()) / 30.0
        return min(math.ceil(1.05 * reach / self.side * cells) + 2, cells)

    def shifts(self, half: float) -> list[tuple[float, float]] | None:
        """Shift of each colour's light against green's, in half texels of ``half`` m; ``None`` if it varies."""
        slopes = np.concatenate((np.zeros((1, 2)), self.steep_slopes))
        green = landing(self.light, self.depth, slopes)
        colours = [landing(self.light, self.depth, slopes, self.index(bent)) for bent in COLOUR_INDEX.values()]
        shifts = (np.array(colours) - green) / half
        # The first are those of level water.
        level = shifts[:, :1]
        if np.abs(shifts - level).max() > SHIFT_TOLERANCE or np.abs(level).max() > MAX_SHIFT:
            return None
        return [(float(x), float(z)) for x, z in level[:, 0]]


def _bspline(x: float) -> float:
    """The uniform cubic B-spline; x in texels."""
    a = abs(x)
    return (4.0 - 6.0 * a * a + 3.0 * a**3) / 6.0 if a < 1.0 else max(2.0 - a, 0.0) ** 3 / 6.0


def _smoothing(shifts: list[tuple[float, float]]) -> tuple[int, int, Uniform, Uniform]:
    """B-spline smoothing, shifted for each colour by ``shifts`` half texels: its start, half texels before a texel's
    first, its number of these, and each colour's weights along rows and along columns.

    The spline is cut off at 7/4 texels; the weights there, at most 0.26 % in all, are distributed over the others.
    """
    span = math.ceil(MAX_SHIFT) + 4
    places = [m for m in range(-span, span + 1) if any(abs(m - 0.5 + part) < 3.5 for both in shifts for part in both)]
    axes = []
    for axis in range(2):
        columns = []
        for shift in shifts:
            distances = [0.5 * (m - 0.5 + shift[axis]) for m in places]
            weights = [_bspline(x) if abs(x) < 1.75 else 0.0 for x in distances]
            columns.append([significant(weight / summed(weights)) for weight in weights])
        axes.append(constants("vec3", zip(*columns, strict=True)))
    return -places[0], len(places), axes[0], axes[1]


def _draw(scene: Scene, light: Light, caustics: Caustics, quality: Quality) -> Contribution | None:
    """Of ripples over a level floor."""
    water = scene.water
    if water.depth is None or water.ripples is None or scene.shore is not None:
        return None
    tile = _Tile(light, water.ripples, water.depth, caustics.dispersion, tiles(True)[0])
    photons = quality.caustics == "photons" or tile.spread > MAX_SPREAD
    rays = quality.caustics_photons if photons else quality.caustics_cells
    texels = quality.caustics_size
    shifts = None if photons else tile.shifts(0.5 * tile.side / texels)
    separate = tile.dispersion > 0.0 and shifts is None
    colours = COLOUR_INDEX if separate else {"white": 0.0}
    least = max(tile.depth + min_surface_height(scene), 0.0)
    how = "3 colours" if separate else "3 colours from one grid" if tile.dispersion > 0.0 else "one colour"
    contribution = Contribution(
        why=f"{rays}² {'photons' if photons else 'cells'} on a tile of {tile.side:g} m, {how}",
        slots=(SlotFile("caustics", "water/seafloor.glsl@caustics"),),
        consts={"CAUSTIC_WAVES": len(tile.waves), "CAUSTIC_TEXELS": texels},
        uniforms={
            "u_caustic_tile": number(tile.side),
            "u_caustic_place": array("vec2", in_tile(tile.side, offset=(-tile.level[0], -tile.level[1])), 1),
        },
        # Sunlight reflected by a white floor under the lowest water, focused as far as a texel can resolve it.
        bound=Bound(
            _MAX_FOCUS * floor_limit(scene, light, least, sky=False),
            f"no sunlight returns from a depth of {least:g} m",
            FLOOR_FIELDS,
        ),
        # Bright lines move along the floor as far as the water is found late.
        refine=1,
    )
    lit = _photons(tile, colours, rays, texels) if photons else _grid(tile, colours, rays, texels, shifts)
    return contribution.joined(_slope_map(tile, rays), lit)


def _slope_map(tile: _Tile, size: int) -> Resources:
    """Slopes of the ripples where rays enter the tile, ``size`` along each side."""
    waves = [(wave.kx, wave.kz, significant(wave.slope), 0.0) for wave in tile.waves]
    uniforms = {
        "u_caustic_wave": constants("vec4", waves),
        "u_caustic_phase": ripple_phases(tile.waves),
        "u_caustic_tile": number(tile.side),
    }
    files = ("lib/numbers.glsl", "water/caustics.glsl@slopes")
    slopes = PassSpec("caustics: slopes", "caustic_slopes", files, uniforms=uniforms)
    return drawn_map(slopes, Target(size=FixedSize.square(size), format="RGBA32F"))


def _photons(tile: _Tile, colours: Mapping[str, float], side: int, texels: int) -> Resources:
    """The map from ``side``² photons for each colour, which are points added up in a target for that colour."""
    passes = [
        replace(
            _light_pass(tile, name, difference, "water/caustics.glsl@photon_vertex", "water/caustics.glsl@photon"),
            target=f"caustic_{name}",
            mesh=Points(count=side * side),
            clear=True,
        )
        for name, difference in colours.items()
    ]
    lights = {f"u_caustic_{name}": f"caustic_{name if name in colours else 'white'}" for name in COLOUR_INDEX}
    light = Target(size=FixedSize.square(texels + 2 * RIM), format="RGBA16F")
    fold = PassSpec("caustics: map", "caustic_map", ("water/caustics.glsl@fold",), lights, target="caustics")
    return Resources(
        consts={"CAUSTIC_PHOTONS": side, "CAUSTIC_RIM": RIM},
        targets={**{f"caustic_{name}": light for name in colours}, "caustics": _finished(texels)},
        passes=(*passes, fold),
    )


def _grid(
    tile: _Tile, colours: Mapping[str, float], cells: int, texels: int, shifts: list[tuple[float, float]] | None
) -> Resources:
    """The map from a grid of ``cells``² cells for each colour, whose triangles are as bright as they are small.

    ``shifts``: of the colours in a single grid.
    """
    before, taps, across, along = _smoothing(shifts or 3 * [(0.0, 0.0)])
    rim = max(RIM, before, taps - before - 2)
    margin, size = tile.margin(cells), 2 * texels + 2 * rim
    white = "white" in colours
    passes: list[PassSpec] = []
    for name, difference in colours.items():
        light = _light_pass(tile, name, difference, "water/caustics.glsl@grid_vertex", "water/caustics.glsl@grid")
        channels = vector(tuple(float(name in (own, "white")) for own in COLOUR_INDEX))
        mesh = Grid(rows=cells + 2 * margin, columns=cells + 2 * margin)
        uniforms = {**light.uniforms, "u_caustic_channels": channels}
        passes.append(replace(light, mesh=mesh, clear=not passes, uniforms=uniforms))
    rows, columns = ("water/caustics.glsl@smooth_rows",), ("water/caustics.glsl@smooth_columns",)
    return Resources(
        consts={
            "CAUSTIC_CELLS": cells,
            "CAUSTIC_MARGIN": margin,
            "CAUSTIC_BEFORE": before,
            "CAUSTIC_TAPS": taps,
            "CAUSTIC_RIM": rim,
            "CAUSTIC_WHITE": white,
        },
        # Twice the resolution: a triangle brightens only texels whose centres it covers. One channel adds up faster.
        targets={
            "caustic_light": Target(size=FixedSize.square(size), format="R16F" if white else "RGBA16F"),
            "caustics": _finished(texels),
            "caustic_rows": Target(size=FixedSize(width=texels, height=size), format="RGBA16F"),
        },
        passes=(
            *passes,
            PassSpec("caustics: rows", "caustic_rows", rows, {}, {"u_caustic_across": across}),
            PassSpec("caustics: map", "caustic_map", columns, {}, {"u_caustic_along": along}, "caustics"),
        ),
    )


def _finished(texels: int) -> Target:
    return Target(size=FixedSize.square(texels), format="RGBA16F", filter="linear_mipmap_linear", wrap="repeat")


def _light_pass(tile: _Tile, colour: str, difference: float, vertex: str, fragment: str) -> PassSpec:
    """The pass that adds up the light of a colour. ``difference``: its entry in :data:`COLOUR_INDEX`."""
    return PassSpec(
        f"caustics: {colour} light",
        "caustic_light",
        vertex=("lib/refraction.glsl", "water/caustics.glsl@landing", vertex),
        fragment=(fragment,),
        uniforms={
            "u_caustic_depth": number(significant(tile.depth)),
            "u_caustic_flat": vector(rounded(tile.level)),
            "u_caustic_index": number(significant(tile.index(difference))),
            "u_caustic_tile": number(tile.side),
        },
        blend="add",
    )


EFFECT = part_effect(
    "caustics",
    _draw,
    "/light/caustics",
    QualityParameter("/caustics", "caustics", ("grid", "photons"), "geometry"),
    QualityParameter("/caustics_size", "texels of the caustic map", (128, 256, 512, 1024), "filtering"),
    QualityParameter("/caustics_cells", "cells of the refracted grid", (64, 128, 256, 512), "geometry"),
    QualityParameter("/caustics_photons", "photons per side", (128, 256, 512, 1024), "geometry"),
    afloat=("u_caustic_place",),
)
