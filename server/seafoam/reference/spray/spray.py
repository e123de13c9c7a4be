"""Section 13: the drops of a scene's spray at a time: their positions, and the discs that samples see."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.rocks import rocks
from seafoam.reference.light import light
from seafoam.reference.noise import pcg, share
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.camera import View
from seafoam.reference.renderer.relief import Part
from seafoam.reference.shore.maps import SWASH
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Bools, Floats, Indices, dot, smoothstep, unit
from seafoam.reference.waves.parametric import WaveSet, angular_frequency, wave_derivative, wave_height
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray

EPOCHS = 65536
DELAY = 1.5
SPOT = 6.0
JET = 1.5
"""Sides of the squares of coast that emit drops at the same time and in the same way, m."""
CANDIDATES = 4
CREST_SLOPE2 = 0.02
MIST_WEIGHT = 1.5
NEAREST = 0.3
WIDEST = 124.0
NARROWEST = 0.75
"""Radii, in samples."""
BEHIND = 0.999
_Words = NDArray[np.uint64]
_LOW = np.uint64(0xFFFFFFFF)


@dataclass(frozen=True, eq=False)
class Drops:
    """Drops in the air, x and z relative to the camera; (n,) or (n, 3) each."""

    birth: Floats
    velocity: Floats
    age: Floats
    word: _Words

    def of(self, chosen: Bools | Indices) -> Drops:
        """A subset, in order."""
        return Drops(self.birth[chosen], self.velocity[chosen], self.age[chosen], self.word[chosen])

    def number(self, k: int) -> Floats:
        """The k-th random number in [0, 1) of each drop."""
        return _number(self.word, k)


@dataclass(frozen=True, eq=False)
class Discs:
    """Discs on the picture, farthest first; (n,) each except the light."""

    X: Floats
    Y: Floats
    """Clip positions of their centres."""
    radius: Floats
    """Radii, in samples."""
    opacity: Floats
    light: Floats
    """Radiance (n, 3), exposed."""


def _number(word: _Words, k: int) -> Floats:
    return share(pcg((word + np.uint64(k)) & _LOW))


class Shown:
    """How drops are lit, and seen through the air."""

    def __init__(self, air: light.Air | None, visibility: float, exposure: float) -> None:
        self.air = air
        self.visibility = visibility
        self.exposure = exposure

    def __call__(self, away: Floats) -> Floats:
        """Radiance of drops at (n, 3), m from the camera; (n, 3), exposed."""
        if self.air is None:
            return np.ones_like(away)
        d = unit(away)
        onward = np.maximum(dot(d, self.air.sun), 0.0) ** 6
        sun = self.air.sun_irradiance * (0.6 + 0.9 * onward)[:, None]
        scattered = (sun + 0.8 * self.air.sky_irradiance) / math.pi
        distance = np.sqrt(dot(away, away))
        result: Floats = light.haze(self.air, self.visibility, scattered, d, distance) * self.exposure
        return result


def _cycles(time: float, period: float) -> tuple[int, float]:
    """Number of whole periods since time 0, and the fraction of the current one."""
    passed = Fraction(time) / Fraction(period)
    whole = math.floor(passed)
    return whole, float(passed - whole)


def flight(
    birth: Floats, velocity: Floats, age: Floats, tau: Floats, weight: Floats, wind: tuple[float, float]
) -> Floats:
    """Positions (n, 3) of drops ``age`` s after their start: ballistics with linear drag, τ and weight (n,) each."""
    last = np.stack((np.full_like(age, wind[0]), -weight * tau, np.full_like(age, wind[1])), axis=-1)
    result: Floats = birth + last * age[:, None] + (velocity - last) * (-tau * np.expm1(-age / tau))[:, None]
    return result


def life_on_rocks(spray: Spray, coast: Coast) -> float:
    """Lifetime of drops from rocks, s: they vanish before the next crest arrives."""
    return min(spray.life, coast.shore.surf.period - DELAY)


def from_rocks(spray: Spray, coast: Coast, time: float) -> Drops:
    """Drops that the surf of a coast throws up."""
    places = rocks(coast.shore, spray.steep)
    if len(places) == 0 or coast.shore.surf.height == 0.0:
        return _none()
    index = np.arange(DROPS, dtype=np.uint64)
    own = pcg(index)
    rock = places[np.arange(DROPS) % len(places)]
    out = rock[:, 2:]
    along = np.stack((-out[:, 1], out[:, 0]), axis=-1)
    q = rock[:, :2] + 2.0 * (_number(own, 0) - 0.5)[:, None] * along
    field = coast.field.value(q[:, 0], q[:, 1])
    period = coast.shore.surf.period
    whole, left = _cycles(time, period)
    turn = -left - field[:, 0]
    wave = np.floor(turn).astype(np.int64) - whole
    counted = (wave % EPOCHS).astype(np.uint64)
    word = pcg(own ^ counted)
    spot = np.floor(q / SPOT).astype(np.int64).astype(np.uint64) & _LOW
    burst = pcg(pcg(pcg(spot[:, 0]) ^ spot[:, 1]) ^ counted)
    delay = DELAY * (0.7 * _number(burst, 0) + 0.3 * _number(word, 1))
    age = (1.0 - (turn - np.floor(turn))) * period - delay
    strong = 0.3 + 0.7 * _number(burst, 1)
    start = spray.speed * np.sqrt(GRAVITY * np.maximum(field[:, 1], 0.0) / SWASH) * strong
    jet = np.floor(q / JET).astype(np.int64).astype(np.uint64) & _LOW
    way = pcg(pcg(pcg(jet[:, 0]) ^ jet[:, 1]) ^ counted)
    fast = start * (0.4 + 0.6 * _number(way, 0)) * (0.25 + 0.75 * _number(word, 2))
    lean = 0.3 * _number(way, 1) + 0.2 * _number(word, 4) - 0.05
    aside = 0.7 * _number(way, 2) + 0.3 * _number(word, 7) - 0.5
    level = lean[:, None] * out + aside[:, None] * along
    velocity = fast[:, None] * np.stack((level[:, 0], 0.8 + 0.2 * _number(word, 3), level[:, 1]), axis=-1)
    birth = np.stack((q[:, 0] - coast.offset[0], field[:, 1], q[:, 1] - coast.offset[1]), axis=-1)
    alive = (age >= 0.0) & (age < life_on_rocks(spray, coast)) & (start > spray.threshold)
    return Drops(birth, velocity, age, word).of(alive)


def from_waves(spray: Spray, scene: Scene, waves: WaveSet, time: float, origin: tuple[float, float]) -> Drops:
    """Drops that the parametric waves of a scene throw up. ``waves``: those at this time, relative to ``origin``."""
    omega = np.array([angular_frequency(wave) for wave in scene.waves])
    if float(waves.amplitude.sum()) == 0.0:
        return _none()
    own = pcg(np.arange(DROPS, dtype=np.uint64))
    whole, left = _cycles(time, spray.life)
    turn = left + _number(own, 0)
    passed = np.floor(turn)
    age = (turn - passed) * spray.life
    word = pcg(own ^ ((whole + passed.astype(np.int64)) % EPOCHS).astype(np.uint64))
    side = 2.0 * spray.reach
    eye = tuple(math.fmod(place, side) for place in origin)
    best = np.full(DROPS, -1.0)
    at, slope, height = np.zeros((DROPS, 2)), np.zeros((DROPS, 2)), np.zeros(DROPS)
    for k in range(CANDIDATES):
        p = np.stack([side * _number(word, 8 + 2 * k + i) - eye[i] for i in (0, 1)], axis=-1)
        p -= side * np.floor(p / side + 0.5)
        rise, tall, steep = np.zeros(DROPS), np.zeros(DROPS), np.zeros((DROPS, 2))
        for i, theta in enumerate(waves.theta(p[:, 0], p[:, 1])):
            then = theta - omega[i] * age
            change = wave_derivative(then, waves.amplitude[i], waves.exponent[i])
            tall += wave_height(then, waves.amplitude[i], waves.exponent[i])
            steep -= change[:, None] * np.array([waves.kx[i], waves.kz[i]])
            rise += change * omega[i]
        faster = rise > best
        best, height = np.where(faster, rise, best), np.where(faster, tall - waves.level, height)
        at, slope = np.where(faster[:, None], p, at), np.where(faster[:, None], steep, slope)
    onward = -slope * (best / np.maximum(dot(slope, slope), CREST_SLOPE2))[:, None]
    aside = best[:, None] * (np.stack((_number(word, 2), _number(word, 3)), axis=-1) - 0.5)
    level = onward * (0.4 + 0.6 * _number(word, 4))[:, None] + aside
    upward = spray.speed * best * (0.4 + 0.6 * _number(word, 1))
    velocity = np.stack((level[:, 0], upward, level[:, 1]), axis=-1)
    birth = np.stack((at[:, 0], height, at[:, 1]), axis=-1)
    born = (best > spray.threshold) & (np.hypot(at[:, 0], at[:, 1]) < spray.reach)
    return Drops(birth, velocity, age, word).of(born)


def discs(
    spray: Spray, drops: Drops, life: float, view: View, rows: int, relief: Part, coast: Coast | None, shown: Shown
) -> Discs:
    """Discs of the drops on a picture of ``rows`` samples from top to bottom."""
    mist = drops.number(5) < spray.mist
    vary = drops.number(6)
    wind = (spray.wind * math.cos(spray.wind_direction), spray.wind * math.sin(spray.wind_direction))
    weight = np.where(mist, MIST_WEIGHT, GRAVITY)
    place = flight(drops.birth, drops.velocity, drops.age, spray.drag * (0.6 + 0.8 * vary), weight, wind)
    away = place - np.array([0.0, view.eye[1], 0.0])
    depth = away @ view.ray_z
    X, Y = (away @ axis / float(axis @ axis) / np.maximum(depth, 0.1) for axis in (view.ray_x, view.ray_y))
    seen = (depth >= NEAREST) & (np.abs(X) <= 1.0) & (np.abs(Y) <= 1.0)
    seen[seen] = ~_hidden(place[seen], away[seen], float(view.eye[1]), relief, coast)
    grown = np.where(mist, 9.0 * (0.35 + vary) * (0.3 + drops.age), 0.3 + 1.2 * vary * vary * vary)
    opacity = np.where(mist, 0.045, 0.9) * smoothstep(0.0, 0.05, drops.age) * smoothstep(NEAREST, 1.0, depth)
    opacity *= 1.0 - smoothstep(0.4, 1.0, drops.age / life)
    q = math.sqrt(float(view.ray_y @ view.ray_y))
    radius = spray.size * grown[seen] * 0.5 * rows / (q * depth[seen])
    wide = np.clip(radius, NARROWEST, WIDEST)
    thin = opacity[seen] * np.minimum((radius / wide) ** 2, 1.0)
    return Discs(X[seen], Y[seen], wide, thin, shown(away[seen]))


def _hidden(place: Floats, away: Floats, eye_y: float, relief: Part, coast: Coast | None) -> Bools:
    """Whether drops (n, 3) are below or behind water or ground; (n,)."""
    x, y, z = place.T
    under: Bools = y < relief.height(x, z)
    if coast is not None:
        under |= y < coast.ground(*coast.place(x, z))[0]
    above = np.flatnonzero(~under)
    d, far = unit(away[above]), np.sqrt(dot(away[above], away[above]))
    behind = intersect.first_crossing(relief, eye_y, d) < BEHIND * far
    if coast is not None:
        low, high = coast.within(d)
        behind |= intersect.land_crossing(coast.land, eye_y, d, low, np.minimum(high, BEHIND * far)) < BEHIND * far
    under[above] = behind
    return under


def _none() -> Drops:
    return Drops(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros(0, np.uint64))


def lay_over(picture: Floats, X: Floats, Y: Floats, over: Discs) -> None:
    """Blend discs over samples (H, W, 3), in place. X, Y (H, W): clip positions of the samples."""
    rows, columns = X.shape
    for i in range(over.X.size):
        r = over.radius[i]
        middle = 0.5 * (over.X[i] + 1.0) * columns, 0.5 * (1.0 - over.Y[i]) * rows
        left, right = (int(np.clip(math.floor(middle[0] + s * (r + 1.0)), 0, columns - 1)) for s in (-1.0, 1.0))
        top, bottom = (int(np.clip(math.floor(middle[1] + s * (r + 1.0)), 0, rows - 1)) for s in (-1.0, 1.0))
        here = (slice(top, bottom + 1), slice(left, right + 1))
        across = (X[here] - over.X[i]) * 0.5 * columns / r
        down = (Y[here] - over.Y[i]) * 0.5 * rows / r
        cover = over.opacity[i] * (np.maximum(1.0 - across * across - down * down, 0.0) ** 2)[..., None]
        picture[here] = picture[here] * (1.0 - cover) + over.light[i] * cover
