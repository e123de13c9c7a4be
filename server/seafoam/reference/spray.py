"""Section 13: drops in flight, and as splats on a picture.

Births are given: what judges them are their statistics and the float64 surface on which they start
(``tests/gpu/reference/test_spray.py``). Flight, visibility, size and light of a drop are written from the page. What
its water hides within the splat is a transcript of the shader: a picture with other strands could not be compared
sample by sample.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.spray import BATCHES
from seafoam.reference.light.atmosphere import CONTRAST
from seafoam.reference.noise import Words, number
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.renderer.state import ReferenceState
from seafoam.reference.sampling import trilinear
from seafoam.reference.types import Floats, Pair, Rows, Vec2, dot, smoothstep, unit
from seafoam.scene import Scene
from seafoam.textures.foam import STRANDS, strand_levels

SHEET, MIST, DRIFT, COLUMN = 0.0, 1.0, 2.0, 3.0  # kinds of drops
NEAREST = 0.3
NARROWEST = 0.75  # half the least width and length, samples
AROUND = np.array([(0.06, 0.2), (0.06, 0.2), (0.013, 0.06), (1e9, 2e9)])
"""Tangents of half the angle of a drop's length from which on it fades, and where it is gone, by kind: that of a column
never."""
BEHIND = 0.999
WINDOW = 0.4
FINER = 3.7
BRIGHTEST = 64.0
ONWARD = 0.8  # mean cosine of the light that drops send on
KINDS = np.array(
    [
        (1.0, GRAVITY, 0.35, 0.35, 0.9, 1.4, 0.15, 2.5, 0.22),
        (1.0, 1.5, 0.9, 0.5, 0.5, 2.2, 0.2, 1.5, 0.7),
        (0.5, 2.5, 0.9, 0.8, 0.8, 3.0, 0.3, 3.0, 1.0),
        (4.0, GRAVITY, 0.0, 0.6, 0.8, 1.6, 0.15, 3.0, 0.3),
    ],
    [(name, np.float64) for name in ["drag", "weight", "wait", "least", "more", "grows", "moment", "longest", "soft"]],
)
"""Of sheets, mist, spindrift and columns: factor on the time constant of the drag, acceleration (m/s²), share of a
batch's interval over which births are spread, radius at birth and what varies of it, its growth over a life, time of
motion blur (s), greatest length over the radius, and width of the threshold of strands."""


@dataclass(frozen=True, eq=False)
class Sprayed:
    """A scene and the drops of its spray at a time from a camera, as a renderer throws them."""

    scene: Scene
    drops: NDArray[np.float32]
    """(3, n, 4): birth and age; velocity and radius; strength, kind, seed and life."""


@dataclass(frozen=True, eq=False)
class Drops(Rows):
    """Drops as they were at birth, x and z relative to the camera; (n,) or (n, 3) each."""

    birth: Floats
    velocity: Floats
    age: Floats
    life: Floats
    radius: Floats
    strength: Floats
    kind: Floats
    seed: Words  # the upper 24 bits of a drop's word

    @staticmethod
    def of(table: NDArray[np.float32]) -> "Drops":
        """Those of :attr:`Sprayed.drops` that are in the air."""
        birth, thrown, traits = table[:, table[2, :, 0] > 0.0].astype(np.float64)
        strength, kind, seed, life = traits.T
        return Drops(
            birth[:, :3], thrown[:, :3], birth[:, 3], life, thrown[:, 3], strength, kind, seed.astype(np.uint64)
        )


class Splats:
    """The drops of a scene's spray on the picture, as ellipses."""

    def __init__(self, state: ReferenceState, drops: Drops) -> None:
        spray, shore, grid = state.scene.spray, state.scene.shore, state.grid
        assert spray is not None
        # Drops of waves come in batches, each begins at its own time, spindrift on its crest; those at rocks do not.
        on_rocks = shore is not None and shore.surf.height > 0.0 and len(rocks(shore, spray.steep)) > 0
        every = 0.0 if on_rocks else spray.life / BATCHES
        vary = number(drops.seed, 6)
        wind = (spray.wind_speed * math.cos(spray.downwind), spray.wind_speed * math.sin(spray.downwind))
        of = KINDS[drops.kind.astype(np.intp)]
        tau = of["drag"] * (spray.drag * (0.6 + 0.8 * vary))
        wait = every * number(drops.seed, 8) * of["wait"]
        rides = np.where(drops.kind == DRIFT, np.minimum(wait, drops.age), 0.0)
        torn = drops.birth + rides[:, None] * drops.velocity * np.array([1.0, 0.0, 1.0])
        place, moving = flight(torn, drops.velocity, drops.age - rides, tau, of["weight"], wind)
        away = place - np.array([0.0, grid.eye_y, 0.0])
        depth = away @ grid.ray_z
        chosen = np.flatnonzero(depth >= NEAREST)
        soft = 0.35 * drops.radius[chosen] + 0.02
        clear, over = _visible(state, away[chosen], soft)
        chosen, over, clear = chosen[clear > 0.0], over[clear > 0.0], clear[clear > 0.0]
        drops, of = drops.subset(chosen), of[chosen]
        away, moving, depth, vary = (part[chosen] for part in (away, moving, depth, vary))
        radius, thick, self.cover = form(drops.kind, drops.age - wait[chosen], drops.life, vary, number(drops.seed, 9))
        # Clip positions of the centres, and directions of flight on the picture (n, 2), y up.
        self.X, self.Y, self.along, size = _ellipses(grid, away, moving, drops.radius * radius, of, over)
        self.half = np.maximum(size, NARROWEST)  # (n, 2) half the length and the width, samples
        thin = size.prod(axis=-1) / self.half.prod(axis=-1)
        sharp = np.log2(0.5 * WINDOW * STRANDS / self.half[:, 1])
        self.level = np.clip(sharp, 0.0, 5.0)  # of the strands' texture
        tangent = size[:, 0] * math.sqrt(float(grid.ray_y @ grid.ray_y)) / (0.5 * grid.rows)
        fades, gone = AROUND[drops.kind.astype(np.intp)].T
        apart = 1.0 - smoothstep(0.0, 1.0, (tangent - fades) / (gone - fades))
        hides = 1.0 - np.exp(-thick * drops.strength * clear * smoothstep(NEAREST, 1.0, depth) * apart)
        self.depth = -np.log(1.0 - np.minimum(thin * hides, 0.999))  # optical depth of the middle
        self.soft = of["soft"] + (1.0 - of["soft"]) * self.level / 5.0
        self.fine = 1.0 - np.clip((sharp + 2.0) / 2.0, 0.0, 1.0)
        stretch = 0.5 * WINDOW * np.minimum(self.half[:, 0] / self.half[:, 1], 2.0)
        # (n, 3): first place in the texture, and texture along half the length.
        self.window = np.stack((number(drops.seed, 10), number(drops.seed, 11), stretch), axis=-1)
        self.scattered, self.onward, self.sun = _light(state, away, drops.velocity, self.along)

    def draw_over(self, picture: Floats, X: Floats, Y: Floats) -> None:
        """Draw the drops over samples (H, W, 3), in place. X, Y (H, W): clip positions of the samples."""
        rows, columns = X.shape
        thick, total = np.zeros((rows, columns)), np.zeros((rows, columns, 3))
        sides = np.array([columns, rows])
        for i in range(self.X.size):
            along = self.along[i]
            across = np.array([-along[1], along[0]])
            reach = np.abs(along) * self.half[i, 0] + np.abs(across) * self.half[i, 1] + 1.0
            middle = 0.5 * np.array([self.X[i] + 1.0, 1.0 - self.Y[i]]) * sides
            left, top = np.clip(np.floor(middle - reach), 0, sides).astype(np.intp)
            right, bottom = np.clip(np.floor(middle + reach) + 1.0, 0, sides).astype(np.intp)
            here = (slice(top, bottom), slice(left, right))
            right_of, above = (X[here] - self.X[i]) * 0.5 * columns, (Y[here] - self.Y[i]) * 0.5 * rows
            a = (right_of * along[0] + above * along[1]) / self.half[i, 0]
            b = (right_of * across[0] + above * across[1]) / self.half[i, 1]
            square = a * a + b * b
            within = square < 1.0
            if within.any():
                depth, colour = self._water(i, a[within], b[within], square[within])
                thick[here][within] += depth
                total[here][within] += colour
        wet = thick >= 1e-4
        cover = 1.0 - np.exp(-thick[wet])
        picture[wet] = picture[wet] * (1.0 - cover)[:, None] + total[wet] * (cover / thick[wet])[:, None]

    def _water(self, i: int, a: Floats, b: Floats, square: Floats) -> Pair:
        """Optical depth (n,) of a drop at places in it, and its light times that (n, 3)."""
        u, v, stretch = self.window[i]
        by_u, by_v = a * stretch, b * 0.5 * WINDOW
        within = 1.0 - square
        level, levels = np.full(a.shape, self.level[i]), strand_levels()
        rank = trilinear(levels, u + by_u, v + by_v, level)
        cover = np.clip((self.cover[i] * within - rank) / self.soft[i] + 0.5, 0.0, 1.0)
        finer = trilinear(levels, v + FINER * by_v, u - FINER * by_u, level + math.log2(FINER))
        cover = cover + self.fine[i] * (np.clip((cover - finer) / 0.3 + 0.5, 0.0, 1.0) - cover)
        depth = self.depth[i] * within * cover
        along, across, eye = self.sun[i]
        facing = 0.75 + 0.25 * (a * along + b * across + np.sqrt(within) * eye)
        colour = self.scattered[i] * facing[:, None] + self.onward[i] * np.exp(-1.5 * depth)[:, None]
        return depth, colour * depth[:, None]


def flight(birth: Floats, velocity: Floats, age: Floats, tau: Floats, weight: Floats, wind: Vec2) -> Pair:
    """Positions (n, 3), m, and velocities (n, 3), m/s, of drops (n,) s old: ballistics with linear drag."""
    last = np.stack((np.full_like(tau, wind[0]), -weight * tau, np.full_like(tau, wind[1])), axis=-1)
    place = birth + last * age[:, None] + (velocity - last) * (-tau * np.expm1(-age / tau))[:, None]
    return place, last + (velocity - last) * np.exp(-age / tau)[:, None]


def form(kind: Floats, age: Floats, life: Floats, vary: Floats, other: Floats) -> tuple[Floats, Floats, Floats]:
    """How drops (n,) have spread and torn at an age: radius over that at birth, optical depth, and cover; (n,) each."""
    index, x = kind.astype(np.intp), np.maximum(age, 0.0) / life
    of = KINDS[index]
    radius = (of["least"] + of["more"] * vary * np.where(kind == SHEET, vary, 1.0)) * (1.0 + of["grows"] * x)
    ends, begins = 1.0 - smoothstep(0.55, 1.0, x), smoothstep(0.0, 0.06, x)
    torn, spread = smoothstep(0.0, 0.6, x), smoothstep(0.05, 0.8, x)
    depths = (
        1.2 * ends * begins,
        0.9 * ends * begins / (0.4 + radius * radius),
        0.45 * (1.0 - x) * ends * smoothstep(0.0, 0.2, x) / (0.3 + radius),
        1.8 * ends * smoothstep(0.0, 0.02, x) / (0.4 + 0.6 * radius),
    )
    covers = (0.8 - 0.62 * torn) * (0.6 + 0.4 * other), 0.85, 1.0, 1.1 - 0.8 * spread
    depth, cover = (np.choose(index, np.broadcast_arrays(*each)) for each in (depths, covers))
    return radius, depth, cover


def _light(state: ReferenceState, away: Floats, thrown: Floats, along: Floats) -> tuple[Floats, Floats, Floats]:
    """Light that drops at (n, 3) scatter all round and what they send on nearly as it came, and the direction to the
    sun: along their flight on the picture, across it, and toward the eye; (n, 3) each."""
    lighting, grid = state.lighting, state.grid
    if lighting is None:
        return np.ones_like(away), np.zeros_like(away), np.zeros_like(away)
    air, none = lighting.air, np.zeros((len(away), 2))
    reached = lighting.open_sun(away + np.array([0.0, grid.eye_y, 0.0]), (none, none))
    distance = np.sqrt(dot(away, away))
    # Where the water beside a drop ends: outward of its flight, and up.
    level = thrown[:, ::2] / np.maximum(np.hypot(thrown[:, 0], thrown[:, 2]), 1e-3)[:, None]
    faces = np.insert(0.8 * level, 1, 0.6, axis=1)
    sun = air.sun_irradiance * (reached * (0.5 + 0.4 * dot(faces, air.sun)))[:, None]
    scattered = lighting.haze((sun + 0.9 * air.sky_irradiance) / math.pi, unit(away), distance) * lighting.exposure
    g = ONWARD
    phase = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * dot(unit(away), air.sun)) ** 1.5 / (2.0 * math.pi)
    through = np.exp(-CONTRAST / lighting.settings.visibility * distance)
    onward = air.sun_irradiance * (reached * phase * through)[:, None] * lighting.exposure

    aside = np.array([unit(axis) @ air.sun for axis in (grid.ray_x, grid.ray_y)])
    across = np.stack((-along[:, 1], along[:, 0]), axis=-1)
    eye = np.full(len(along), -float(air.sun @ grid.ray_z))
    toward_sun = np.stack((along @ aside, across @ aside, eye), axis=-1)
    return np.minimum(scattered, BRIGHTEST), np.minimum(onward, BRIGHTEST), toward_sun


def _ellipses(
    grid: SampleGrid, away: Floats, moving: Floats, radius: Floats, of: NDArray[np.void], over: Floats
) -> tuple[Floats, Floats, Floats, Floats]:
    """Clip positions X and Y of drops at (n, 3), directions on the picture (n, 2), half lengths and widths (n, 2).
    ``of``: rows of KINDS; ``over``: heights above water, m. Lengths on the picture are in samples."""
    sides, axes, depth = (grid.columns, grid.rows), (grid.ray_x, grid.ray_y), away @ grid.ray_z
    X, Y = (away @ axis / float(axis @ axis) / depth for axis in axes)
    moves = np.stack(
        [
            (moving @ axis / float(axis @ axis) - clip * (moving @ grid.ray_z)) / depth * 0.5 * side * of["moment"]
            for axis, clip, side in zip(axes, (X, Y), sides, strict=True)
        ],
        axis=-1,
    )
    scale = 0.5 * sides[1] / (math.sqrt(float(grid.ray_y @ grid.ray_y)) * depth)
    wide = np.minimum(radius, 0.5 * radius + over) * scale
    moved = np.hypot(moves[:, 0], moves[:, 1])
    longer = moved * np.minimum(over / np.maximum(np.abs(moving[:, 1]) * of["moment"], 1e-3), 1.0)
    along = np.where((moved > 1e-4)[:, None], moves / np.maximum(moved, 1e-300)[:, None], np.array([0.0, 1.0]))
    size = np.stack((wide + np.minimum(longer, of["longest"] * wide), wide), axis=-1)
    return X, Y, along, size


def _visible(state: ReferenceState, away: Floats, soft: Floats) -> Pair:
    """What is seen of drops (n, 3): nothing of those below or behind water or ground, or behind a boat; in [0, 1]. And
    their heights over both, m."""
    x, z, eye_y, relief, coast = away[:, 0], away[:, 2], state.eye_y, state.surface.relief, state.surface.coast
    ground = relief.height(x, z)
    if coast is not None:
        ground = np.maximum(ground, coast.ground(*coast.place(x, z))[0])
    over = away[:, 1] + eye_y - ground
    result = np.clip(over / soft, 0.0, 1.0)
    above = np.flatnonzero(over > 0.0)
    d, far = unit(away[above]), np.sqrt(dot(away[above], away[above]))
    behind = intersect.first_crossing(relief, eye_y, d) < BEHIND * far
    if coast is not None:
        low, high = coast.within(d)
        behind |= intersect.land_crossing(coast.land, eye_y, d, low, np.minimum(high, BEHIND * far)) < BEHIND * far
    if state.fleet is not None:
        behind |= state.fleet.trace(np.array([0.0, eye_y, 0.0]), d).t < BEHIND * far
    result[above[behind]] = 0.0
    return result, over
