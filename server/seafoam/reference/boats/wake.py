"""Sections 15 and 16: wakes and their foam.

Standing waves behind stones are wakes of hulls that move against the current as fast as it flows.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seafoam.ocean.waves.wakes import LEAST_SPEED, Wake, joint_height, joint_slope, wakes
from seafoam.reference.boats.boat import FORMS, HULL_SPEED, STEM, Course, course_of
from seafoam.reference.noise import filtered_step, footprint_variance, patches
from seafoam.reference.types import Bools, Bounds, Floats, Footprints, Gradient, Pair, Vec2, smoothstep_slope
from seafoam.scene import Boat, Current, Scene, Stone, WakeSaturation

PATCHES = (0.31, False), (0.11, True), (0.037, False)
"""Cells of the noise that tears a wake's foam, in lengths of the hull, and whether they are turned."""


@dataclass(frozen=True)
class Wakes:
    """Wakes as a part of the surface around one origin."""

    wakes: tuple[Wake, ...]

    @cached_property
    def bounds(self) -> Bounds:
        top, slope = joint_height(self.wakes), joint_slope(self.wakes)
        shortest = max((wake.shortest for wake in self.wakes if wake.shows), default=0.0)
        return Bounds(top, -top, slope, slope * (2.0 * shortest), 1.0 / shortest if shortest > 0.0 else math.inf)

    def along(self, i: int, x: Floats, z: Floats) -> tuple[Floats, Floats, Gradient, Gradient]:
        """Distance of places (x, z) behind the bow of wake i and aside (m), and the gradients of both."""
        raise NotImplementedError

    def height(self, x: Floats, z: Floats) -> Floats:
        return self._sums(x, z)[0, :]

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return self._sums(x, z)[1:]

    def _sums(self, x: Floats, z: Floats) -> Floats:
        """The height and its derivatives by x and z; (3, r)."""
        total = np.zeros((3, x.size))
        for i, wake in enumerate(self.wakes):
            behind, aside, on_behind, on_aside = self.along(i, x, z)
            height, rise, spread = pattern(wake, behind, np.abs(aside))
            spread = spread * np.where(aside < 0.0, -1.0, 1.0)
            total += [
                height,
                *(rise * along + spread * across for along, across in zip(on_behind, on_aside, strict=True)),
            ]
        return total


@dataclass(frozen=True)
class WakeSet(Wakes):
    boats: tuple[Boat, ...]
    courses: tuple[Course, ...]

    def along(self, i: int, x: Floats, z: Floats) -> tuple[Floats, Floats, Gradient, Gradient]:
        course = self.courses[i]
        from_x, from_z = x + course.centre[0], z + course.centre[1]
        out = np.hypot(from_x, from_z)
        far = np.maximum(out, 0.1 * course.radius)
        angle = course.turn * (course.bearing - np.arctan2(from_z, from_x))
        angle = np.mod(angle + 0.3, 2.0 * math.pi) - 0.3
        share = course.turn * course.radius / (far * far)
        behind = course.radius * angle + STEM * self.boats[i].length
        return behind, out - course.radius, (share * from_z, -share * from_x), (from_x / far, from_z / far)

    def foam(self, source: WakeSaturation, x: Floats, z: Floats, cap: float, footprints: Footprints | None) -> Floats:
        """f of the boats' foam at (x, z), m from the origin, averaged over footprints; (r,) in [0, cap]."""
        total = np.zeros_like(x)
        for i, (boat, course) in enumerate(zip(self.boats, self.courses, strict=True)):
            if boat.speed < 0.5:
                continue
            size = boat.length
            behind, aside, on_behind, on_aside = self.along(i, x, z)
            b, s = behind / size, np.abs(aside) / size
            past = np.maximum(b - 0.86, 0.0)
            on_x, on_z = (x + course.centre[0]) / size, (z + course.centre[1]) / size
            torn = patches(on_x, on_z, PATCHES, footprints, size)
            width = 0.085 + 0.055 * np.sqrt(past)
            v_b, v_s = (footprint_variance(part, footprints) / size**2 for part in (on_behind, on_aside))
            band = filtered_step(-1.15 * width, -0.5 * width, s, v_s)
            band -= filtered_step(0.5 * width, 1.15 * width, s, v_s)
            band *= filtered_step(-0.06, 0.04, b - 0.86, v_b)
            age = np.exp(-np.minimum(past * size / (source.life * boat.speed), 80.0))
            run, ahead = np.minimum(b / 0.55, 1.0), np.maximum(b, 0.0)
            edge = 0.015 + 0.105 * run * (2.0 - run) + 0.16 * np.maximum(b - 0.55, 0.0)
            off = (s - edge) / (0.02 + 0.025 * ahead)
            wider = 1.0 + 2.0 * v_s / (0.02 + 0.025 * ahead) ** 2
            bell = np.exp(-np.minimum(off * off / wider + 1.3 * ahead, 80.0)) / np.sqrt(wider)
            thrown = filtered_step(-0.01, 0.06, b, v_b) * bell
            share = min(boat.speed / (HULL_SPEED * math.sqrt(size)), 1.0)
            total += source.amount * band * age * (0.3 + 0.9 * torn)
            total += source.bow * share**2 * thrown * (0.3 + torn)
            total += source.contact * share * contact(boat, course, x, z, torn, footprints)
        return np.minimum(total, cap)


def contact(boat: Boat, course: Course, x: Floats, z: Floats, torn: Floats, footprints: Footprints | None) -> Floats:
    """Density of white water along a hull's water line, averaged over footprints; (r,) in [0, 1.2]."""
    size, form = boat.length, FORMS[boat.kind]
    (c_x, c_z), (a_x, a_z) = course.place, course.heading
    ahead = ((x - c_x) * a_x + (z - c_z) * a_z) / size
    right = ((z - c_z) * a_x - (x - c_x) * a_z) / size
    c, s = math.cos(boat.heel), math.sin(boat.heel)
    # How far level water at each place is from the hull's sides, in breadth.
    up = s * right - form.widest
    lack = form.fine * (ahead + 0.12) ** 2 + form.flare * up**2 + c * np.abs(right) - form.beam
    by_ahead = 2.0 * form.fine * (ahead + 0.12)
    by_right = 2.0 * form.flare * s * up + c * np.where(right < 0.0, -1.0, 1.0)
    change = np.hypot(by_ahead, by_right)
    away, by_ahead, by_right = lack / change, by_ahead / change, by_right / change
    half = form.beam - form.flare * form.widest**2
    stem = math.sqrt(half / form.fine) - 0.12
    past = np.maximum(ahead - stem, -0.45 - ahead)
    by_ahead, by_right = np.where(past > away, 1.0, by_ahead), np.where(past > away, 0.0, by_right)
    away = np.maximum(away, past)
    aft = np.clip((stem - ahead) / (stem + 0.45), 0.0, 1.0)
    width = 2.0 * form.beam * (0.05 + 0.1 * aft) * (0.5 + torn)
    gradient = (by_ahead * a_x - by_right * a_z, by_ahead * a_z + by_right * a_x)
    variance = footprint_variance(gradient, footprints) / size**2
    band = filtered_step(-width, np.zeros_like(x), away, variance)
    band -= filtered_step(0.4 * width, 1.4 * width, away, variance)
    return (1.0 - 0.6 * aft) * band * (0.3 + 0.9 * torn)


def pattern(wake: Wake, behind: Floats, aside: Floats) -> tuple[Floats, Floats, Floats]:
    """Height of a wake at places behind the bow and aside (≥ 0), m, and its slopes; (r,) each."""
    boat = wake.boat
    if not wake.shows:
        return np.zeros_like(behind), np.zeros_like(behind), np.zeros_like(behind)
    x = np.maximum(behind, 1e-3)
    q = aside / x
    inside: Bools = (behind > 0.0) & (8.0 * q * q < 1.0) & (behind < wake.length)
    q = np.where(inside, q, 0.0)
    root = np.sqrt(1.0 - 8.0 * q * q)
    root_q = -8.0 * q / np.maximum(root, 1e-6)
    size, end = boat.length, wake.length
    edge, edge_s = smoothstep_slope(0.0, 0.5, root * root)
    begin, begin_x = smoothstep_slope(0.0, 0.6 * size, behind)
    stop, stop_x = smoothstep_slope(0.5 * end, end, behind)
    side, side_z = smoothstep_slope(0.25 * boat.radius, 0.4 * boat.radius, aside)
    window = edge * begin * (1.0 - stop) * (1.0 - side) * inside
    window_q = edge_s * (-16.0 * q) * begin * (1.0 - stop) * (1.0 - side) * inside
    window_x = edge * (begin_x * (1.0 - stop) - begin * stop_x) * (1.0 - side) * inside
    window_z = -edge * begin * (1.0 - stop) * side_z * inside
    fall = np.where(inside, 1.0 / (1.0 + behind / wake.wavelength), 0.0)
    fall_x = -fall * fall / wake.wavelength
    height, rise, spread = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    steep = np.maximum(q, 1e-4)
    systems = (
        (2.0 * q / (1.0 + root), 2.0 / (1.0 + root) - 2.0 * q * root_q / (1.0 + root) ** 2, 0.5, 0.5),
        ((1.0 + root) / (4.0 * steep), root_q / (4.0 * steep) - (1.0 + root) / (4.0 * steep**2), 1.0, 1.0 / 3.0),
    )
    for t, t_q, share, power in systems:
        secant = np.sqrt(1.0 + t * t)
        # a = share A window(q, x, z) fall(x)^power cut(q), and its partial derivatives.
        a = share * boat.wake * fall**power
        a_x, a_z, a_q = a * window_x, a * window_z, a * window_q
        a_x = a_x + share * boat.wake * power * np.where(fall > 0.0, fall, 1.0) ** (power - 1.0) * fall_x * window
        a = a * window
        k = wake.k * secant * secant
        short = np.exp(-np.minimum((k / wake.shortest) ** 2, 700.0))
        a_q = (a_q - a * 4.0 * k * wake.k * t * t_q / wake.shortest**2) * short
        a, a_x, a_z = a * short, a_x * short, a_z * short
        phase = wake.k * secant * (behind - aside * t)
        cosine, down = np.cos(phase), -a * np.sin(phase) * wake.k * secant
        height += a * cosine
        rise += down + (a_x - a_q * q / x) * cosine
        spread += -down * t + (a_z + a_q / x) * cosine
    return height, rise, spread


def wake_set(scene: Scene, time: float, origin: Vec2) -> WakeSet:
    """The wakes of a scene's boats at a time (s) around an origin (x, z) in m."""
    return WakeSet(wakes(scene.boats), scene.boats, tuple(course_of(boat, time, origin) for boat in scene.boats))


@dataclass(frozen=True)
class StoneSet(Wakes):
    current: Current
    origin: Vec2

    @property
    def _downstream(self) -> Vec2:
        return math.cos(self.current.direction), math.sin(self.current.direction)

    def along(self, i: int, x: Floats, z: Floats) -> tuple[Floats, Floats, Gradient, Gradient]:
        c, s = self._downstream
        behind, aside = self._from_middle(self.current.stones[i], x, z)
        return behind + self.current.stones[i].radius, aside, (c, s), (-s, c)

    def _from_middle(self, stone: Stone, x: Floats, z: Floats) -> Pair:
        """How far places (x, z), m from the origin, are downstream of a stone's middle and to the right; (r,) m."""
        c, s = self._downstream
        from_x, from_z = x + (self.origin[0] - stone.place[0]), z + (self.origin[1] - stone.place[1])
        return c * from_x + s * from_z, c * from_z - s * from_x

    def foam(self, source: WakeSaturation, x: Floats, z: Floats, cap: float, footprints: Footprints | None) -> Floats:
        """f of the stones' foam at (x, z), m from the origin, averaged over footprints; (r,) in [0, cap]."""
        total = np.zeros_like(x)
        speed = self.current.speed
        if speed < LEAST_SPEED:
            return total
        c, s = self._downstream
        for stone in self.current.stones:
            r = stone.radius
            behind, aside = (distance / r for distance in self._from_middle(stone, x, z))
            on_x, on_z = ((c * behind - s * aside) / 4.0, (s * behind + c * aside) / 4.0)
            torn = patches(on_x, on_z, PATCHES, footprints, 4.0 * r)
            v_x = footprint_variance((c, s), footprints) / r**2
            v_z = footprint_variance((-s, c), footprints) / r**2
            down = np.maximum(behind, 0.0)
            width = 0.9 + 0.2 * np.sqrt(down)
            band = filtered_step(-1.2 * width, -0.6 * width, aside, v_z)
            band -= filtered_step(0.6 * width, 1.2 * width, aside, v_z)
            band *= filtered_step(-0.7, 0.3, behind, v_x) * np.exp(-np.minimum(down * r / (source.life * speed), 80.0))
            wider = 1.0 + 2.0 * (v_x + v_z) / 0.25**2
            off = (np.hypot(behind, aside) - 1.0) / 0.25
            rim = np.exp(-np.minimum(off**2 / wider, 80.0)) / np.sqrt(wider)
            cushion = rim * (1.0 - filtered_step(-0.5, 0.5, behind, v_x))
            share = min(speed / (HULL_SPEED * math.sqrt(4.0 * r)), 1.0)
            total += share * source.amount * band * (0.3 + 0.9 * torn)
            total += share * source.bow * cushion * (0.3 + torn)
        return np.minimum(total, cap)
