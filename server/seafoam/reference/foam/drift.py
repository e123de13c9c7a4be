"""Section 14: foam advected by a steady flow over a square, traced back in float64.

The flow's uniform part comes from ``ocean/waves/stokes.py``, which shaders use too; a test compares it with
water orbits.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.special import ndtri

from seafoam.ocean.waves.stokes import steady_drift
from seafoam.reference.noise import pcg, value
from seafoam.reference.types import Floats, Pair, Vec2, dot, smoothstep
from seafoam.scene import Drift, DriftSaturation, Scene

GENERATIONS = 4
COUNTED = 1024
PEAK = 1.2564312086261697  # solution y of e^y = 1 + 2y
LONGEST = 0.125  # longest time step, s
TURN = 0.2  # longest time step, as a rotation of the fastest vortex, rad
FADE, REACH = 3.0, 6.0  # distances at which a vortex begins to fade and ends, in radii
OCTAVES = ((0.55, 1.0, False), (0.3, 2.3, True), (0.15, 5.1, False))
"""Weight, frequency and rotation (or none) of each octave of a patch."""
DEVIATION = 0.138
HALF_CUT = 0.1
APART = (3.37, 5.61)  # offset between the two copies of a mask, in tiles
BESIDE = 1e-3  # step of the finite differences of displacements, m
RIM = 0.6  # distance from the middle at which foam begins to fade, over half the side


@dataclass(frozen=True)
class Flow:
    """A flow over a square; places in m from its middle."""

    steady: Vec2  # m/s
    half: float  # half the square's side, m
    vortices: tuple[tuple[float, float, float, float], ...]  # centre (x, z), radius (m), speed there (m/s)

    def velocity(self, x: Floats, z: Floats) -> Floats:
        """(u, w) at (x, z); (2, r) m/s."""
        flow = np.repeat(np.array(self.steady)[:, None], x.size, axis=1)
        x, z = np.clip(x, -self.half, self.half), np.clip(z, -self.half, self.half)
        for c_x, c_z, radius, speed in self.vortices:
            r_x, r_z = x - c_x, z - c_z
            square = (r_x * r_x + r_z * r_z) / radius**2
            near = np.flatnonzero(square < REACH * REACH)
            omega = angular_velocity(square[near], radius, speed)
            flow[:, near] += omega * np.stack((-r_z[near], r_x[near]))
        return flow

    def back(self, x: Floats, z: Floats, seconds: float) -> Floats:
        """Where the water at (x, z) was ``seconds`` ago, by Runge-Kutta steps; (2, r) m."""
        fastest = max(
            (abs(float(angular_velocity(np.zeros(1), a, v)[0])) for _, _, a, v in self.vortices), default=1e-9
        )
        count = max(math.ceil(seconds / min(LONGEST, TURN / max(fastest, 1e-9))), 1)
        h, place = seconds / count, np.stack((x, z))
        for _ in range(count):
            a = self.velocity(*place)
            b = self.velocity(*(place - 0.5 * h * a))
            c = self.velocity(*(place - 0.5 * h * b))
            d = self.velocity(*(place - h * c))
            place = place - h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        return place


def angular_velocity(square: Floats, radius: float, speed: float) -> Floats:
    """Ω of a vortex at (r/a)² = ``square``, rad/s: V/a · κ (1 − e^−y)/(y/β), faded from 3 to 6 radii; (r,)."""
    y = PEAK * square
    # expm1 keeps the digits; at the centre itself the limit is 1.
    share = np.where(y > 0.0, -np.expm1(-y) / np.where(y > 0.0, y, 1.0), 1.0)
    whole = speed / radius * PEAK / -math.expm1(-PEAK)
    return whole * share * (1.0 - smoothstep(FADE, REACH, np.sqrt(square)))


def flow_of(scene: Scene) -> Flow:
    drift = scene.drift
    assert drift is not None
    x, z = drift.place
    vortices = tuple((one.place[0] - x, one.place[1] - z, one.radius, one.speed) for one in drift.vortices)
    return Flow(steady_drift(scene), 0.5 * drift.size, vortices)


def _over_square(scene: Scene, drift: Drift, origin: Vec2, x: Floats, z: Floats) -> tuple[Flow, Pair, Floats]:
    """The flow, places (x, z), m from the origin, in its square, m from the middle, and the foam's fade to the rim."""
    flow, q_x, q_z = flow_of(scene), x + (origin[0] - drift.place[0]), z + (origin[1] - drift.place[1])
    return flow, (q_x, q_z), 1.0 - smoothstep(RIM, 1.0, np.hypot(q_x, q_z) / flow.half)


def _generation(source: DriftSaturation, time: float) -> tuple[int, float, float]:
    """Number of the youngest generation of foam at a time, its age, and the time from one to the next, s."""
    interval = Fraction(source.life) / GENERATIONS
    number = math.floor(Fraction(time) / interval)
    return number, float(Fraction(time) - number * interval), float(interval)


def drift_saturation(scene: Scene, source: DriftSaturation, time: float, origin: Vec2, x: Floats, z: Floats) -> Floats:
    """f of drifting foam at (x, z), m from the origin, at a time (s); (r,), not capped."""
    result = np.zeros_like(x)
    if scene.drift is None:
        return result
    flow, (q_x, q_z), rim = _over_square(scene, scene.drift, origin, x, z)
    inside = np.flatnonzero(rim > 0.0)
    number, youngest, interval = _generation(source, time)
    at_x, at_z = q_x[inside], q_z[inside]
    for j in range(GENERATIONS):
        at_x, at_z = flow.back(at_x, at_z, youngest if j == 0 else interval)
        age = youngest + j * interval
        share = math.sin(math.pi * age / source.life) ** 2
        result[inside] += share * patch(source, (number - j) % COUNTED, at_x, at_z)
    return source.amount * rim * result


@dataclass(frozen=True, eq=False)
class Copy:
    """One of the two copies of a mask that the flow advects, at r places."""

    weight: Floats  # (r,); the weights of the two copies sum to 1
    x: Floats  # where the mask is read, m from the origin; (r,) each
    z: Floats
    turn: Floats  # (r, 2, 2): Jacobian of the displacement, applied to vectors (x, z)

    def turned(self, foot: Floats) -> Floats:
        """Footprints (r, 2) m, mapped to the copy; (r, 2)."""
        return dot(self.turn, foot[:, None])


def copies(
    scene: Scene, source: DriftSaturation, tile: float, time: float, origin: Vec2, x: Floats, z: Floats
) -> list[Copy]:
    """The two copies of a mask with tiles of a side ``tile`` (m) at (x, z), m from the origin, at a time (s)."""
    assert scene.drift is not None
    flow, (q_x, q_z), rim = _over_square(scene, scene.drift, origin, x, z)
    number, youngest, interval = _generation(source, time)
    inside = np.flatnonzero(rim > 0.0)
    grown = math.sin(0.5 * math.pi * youngest / interval) ** 2
    # Weight of the copy of odd generations; outside the square only the other copy is visible.
    share = rim * (grown if number % 2 == 1 else 1.0 - grown)
    pair = []
    for i, seconds in enumerate((youngest, youngest + interval)):
        odd = (number - i) % 2 == 1
        apart = tuple(part * tile if odd else 0.0 for part in APART)
        away, turn = np.zeros((x.size, 2)), np.tile(np.eye(2), (x.size, 1, 1))
        place = q_x[inside], q_z[inside]
        here = _moved_back(flow, *place, seconds)
        away[inside] = rim[inside, None] * here
        for axis, (d_x, d_z) in enumerate(((BESIDE, 0.0), (0.0, BESIDE))):
            change = (_moved_back(flow, place[0] + d_x, place[1] + d_z, seconds) - here) / BESIDE
            turn[inside, :, axis] += rim[inside, None] * change
        pair.append(Copy(share if odd else 1.0 - share, x + away[:, 0] + apart[0], z + away[:, 1] + apart[1], turn))
    return pair


def _moved_back(flow: Flow, x: Floats, z: Floats, seconds: float) -> Floats:
    """Vectors from places to where their water was, (r, 2) m."""
    return (flow.back(x, z, seconds) - np.stack((x, z))).T


def patch(source: DriftSaturation, generation: int, x: Floats, z: Floats) -> Floats:
    """The patches of a generation at (x, z), m from the square's middle; (r,) in [0, 1]."""
    key = int(pcg(np.uint64(source.seed) ^ pcg(np.array([generation], np.uint64)))[0])
    total = np.zeros_like(x)
    for i, (weight, frequency, turned) in enumerate(OCTAVES):
        u, v = x / source.patch, z / source.patch
        if turned:
            u, v = 0.8 * u - 0.6 * v, 0.6 * u + 0.8 * v
        total += weight * value(key + i, u * frequency, v * frequency)
    middle = 0.5 + DEVIATION * float(ndtri(1.0 - source.coverage))
    return smoothstep(middle - HALF_CUT, middle + HALF_CUT, total)
