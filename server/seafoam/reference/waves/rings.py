"""Section 2: rings of stones, drops and blasts, at one time, around one origin.

Ages and vectors are differences of float64 numbers, exact up to one rounding. Level of still water and bounds come from
``ocean/waves/rings.py``, which shaders use too; the search for intersections relies on them, and tests verify them.
"""

import math
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves.rings import ring_curvature, ring_height, ring_slope
from seafoam.reference.types import Bounds, Floats, Vec2, smoothstep_slope
from seafoam.reference.waves.parametric import wavenumber
from seafoam.scene import Ring, Scene

LEAST = 1e-4  # a ring's amplitude is reduced by this, m,
LEAST_SHARE = 1.0 / 256.0  # or by this share of I₀ if that is more
ROUND = 0.25  # radius of the rounded centre, in wavelengths
BAND = 1.0  # width of front and tail, in wavelengths


@dataclass(frozen=True)
class OneRing:
    amplitude: float  # amplitude I₀e^(−bs) − d, at least 0, m
    k: float  # wavenumber, rad/m
    length: float  # wavelength, m
    theta: float  # phase ωs, rad
    front: float  # radius of the front, c s, m
    tail: float  # length of the waves behind the front, m; infinite if they reach the centre
    x: float  # centre, m from the origin
    z: float


@dataclass(frozen=True)
class RingSet:
    """The rings of a scene, as a part of its surface."""

    rings: tuple[OneRing, ...]
    bounds: Bounds

    def height(self, x: Floats, z: Floats) -> Floats:
        return self._sums(x, z)[0, :]

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return self._sums(x, z)[1:]

    def _sums(self, x: Floats, z: Floats) -> Floats:
        """The height and its derivatives by x and z; (3, r)."""
        total = np.zeros((3, x.size))
        for ring in self.rings:
            reach = ring.front + ROUND * ring.length
            here = np.flatnonzero((x - ring.x) ** 2 + (z - ring.z) ** 2 <= reach * reach)
            total[:, here] += ring_wave(ring, x[here], z[here])
        return total


def ring_set(scene: Scene, time: float, origin: Vec2) -> RingSet:
    """The scene's active rings at a time (s) around an origin (x, z) in m."""
    states = [one_ring(ring, scene.water.depth, time, origin) for ring in scene.rings]
    rings, top = _active(states), ring_height(scene)
    finest = min((1.0 / ring.k for ring in rings), default=math.inf)
    return RingSet(rings, Bounds(top, -top, ring_slope(scene), ring_curvature(scene), finest))


def touch_set(scene: Scene, time: float, origin: Vec2) -> RingSet:
    """The rings of the scene's touches, carried by its current; they have slopes without height."""
    states = []
    for touch in scene.touches:
        ring, since = one_ring(touch.ring, None, time, origin), Fraction(time) - Fraction(touch.time)
        velocity = (0.0, 0.0) if scene.current is None else scene.current.velocity
        x, z = (
            float(Fraction(place) + Fraction(part) * since - Fraction(middle))
            for place, part, middle in zip(touch.place, velocity, origin, strict=True)
        )
        states.append(replace(ring, x=x, z=z))
    return RingSet(_active(states), Bounds())


def _active(rings: list[OneRing]) -> tuple[OneRing, ...]:
    return tuple(ring for ring in rings if ring.amplitude > 0.0 and ring.front > 0.0)


def one_ring(ring: Ring, depth: float | None, time: float, origin: Vec2) -> OneRing:
    since = Fraction(time) - Fraction(ring.birth)
    age = float(since % Fraction(ring.every)) if ring.every is not None else max(float(since), 0.0)
    omega = math.sqrt(GRAVITY * 2.0 * math.pi / ring.wavelength)
    k = wavenumber(ring.wavelength, depth)
    amplitude = ring.amplitude * math.exp(-ring.decay * age) - max(LEAST, LEAST_SHARE * ring.amplitude)
    return OneRing(
        amplitude=max(amplitude, 0.0),
        k=k,
        length=2.0 * math.pi / k,
        theta=omega * age,
        front=omega / k * age,
        tail=math.inf if ring.crests is None else ring.crests * 2.0 * math.pi / k,
        x=ring.place[0] - origin[0],
        z=ring.place[1] - origin[1],
    )


def ring_wave(ring: OneRing, x: Floats, z: Floats) -> Floats:
    """η at (x, z), m, and its derivatives by x and z; (3, r)."""
    soft, band = ROUND * ring.length, BAND * ring.length
    from_x, from_z = x - ring.x, z - ring.z
    square = from_x**2 + from_z**2
    # ρ = √(r² + a²) − a, without cancellation.
    far = np.sqrt(square + soft * soft)
    rho = square / (far + soft)
    head, head_change = smoothstep_slope(0.0, band, ring.front - rho)
    tail, tail_change = np.ones_like(rho), np.zeros_like(rho)
    if math.isfinite(ring.tail):
        tail, tail_change = smoothstep_slope(0.0, band, rho - (ring.front - ring.tail - 2.0 * band))
    angle = ring.k * rho - ring.theta
    change = np.cos(angle) * (head * tail_change - head_change * tail) - ring.k * np.sin(angle) * head * tail
    outward = change / far
    return ring.amplitude * np.stack((np.cos(angle) * head * tail, outward * from_x, outward * from_z))
