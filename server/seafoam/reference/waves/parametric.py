"""Section 2: parametric waves and ripples, at one time, around one origin.

Phases at distant times and places are reduced exactly: ω, k, t and the origin are taken as exact float64 numbers, ωt −
k·origin + phase is a fraction, and 2π has 50 digits. Only the vector from the origin is evaluated in float64.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce

import numpy as np
from scipy import optimize, special

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves import groups as wave_groups
from seafoam.ocean.waves.ripples import ripple_cascades
from seafoam.ocean.waves.stokes import orbit
from seafoam.reference.noise import PERIOD, fractal
from seafoam.reference.types import Bounds, Floats, Vec2, Vec3, smoothstep_slope
from seafoam.scene import ParametricWave, Ripples, Scene

_TWO_PI = 2 * Fraction("3.14159265358979323846264338327950288419716939937510")
BOUND_SAMPLES = 8192
CYCLE = np.linspace(0.0, 2.0 * math.pi, BOUND_SAMPLES + 1)  # phases at which bounds of a wave are sampled
RELIEF_SAMPLES = 256
"""Phases over which slopes are averaged; their number affects K < ½, where the slope is infinite at troughs."""
GUST_OCTAVES = 3
STEEPEST = 1e9  # value used for an infinite slope
TROUGH = 1e-4
"""Least |p| in the derivative of waves of exponent below ½, whose slope is infinite at the trough."""


@dataclass(frozen=True, eq=False)
class GroupFactor:
    corners: Floats  # values of the noise at its corners, in [0, 1]; rows along the second axis
    along: Vec2
    """Step of the noise along the way of the groups, (x, z) cells/m; the other is at right angles to it."""
    contrast: float
    velocity: Vec2  # (x, z) m/s
    place: Vec2  # the origin in the noise, cells

    def __call__(self, x: Floats, z: Floats, ago: Floats | float = 0.0) -> Floats:
        """Factor at (x, z), m from the origin, ``ago`` s before; in [1 − contrast, 1]."""
        noise = self._noise(x + self.velocity[0] * ago, z + self.velocity[1] * ago)[0]
        return 1.0 - self.contrast * (1.0 - noise)

    def gradient(self, x: Floats, z: Floats) -> Floats:
        """Its derivatives, (2, r) 1/m."""
        _, by_u, by_v = self._noise(x, z)
        k_x, k_z = self.along
        return self.contrast * np.stack((k_x * by_u - k_z * by_v, k_z * by_u + k_x * by_v))

    def _noise(self, x: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
        """Value noise and its derivatives per cell."""
        k_x, k_z = self.along
        u, v = self.place[0] + k_x * x + k_z * z, self.place[1] - k_z * x + k_x * z
        i, j = np.floor(u), np.floor(v)
        s, t = u - i, v - j
        column, row = np.mod(i, wave_groups.PERIOD).astype(np.int64), np.mod(j, wave_groups.PERIOD).astype(np.int64)
        right, down = (column + 1) % wave_groups.PERIOD, (row + 1) % wave_groups.PERIOD
        a, b, c, d = (self.corners[m, n] for m in (row, down) for n in (column, right))
        (s_in, s_rate), (t_in, t_rate) = smoothstep_slope(0.0, 1.0, s), smoothstep_slope(0.0, 1.0, t)
        top, bottom = a + (b - a) * s_in, c + (d - c) * s_in
        by_u = s_rate * ((b - a) * (1.0 - t_in) + (d - c) * t_in)
        return top + (bottom - top) * t_in, by_u, t_rate * (bottom - top)


def group_factor(scene: Scene, time: float, origin: Vec2) -> GroupFactor | None:
    """The factor of the scene's groups at a time (s) around an origin (x, z) in m; None without groups."""
    groups = scene.wave_groups
    if groups is None or not wave_groups.in_groups(scene):
        return None
    along, velocity = wave_groups.group_cells(scene, groups), wave_groups.group_velocity(scene)
    moved = [Fraction(start) - Fraction(speed) * Fraction(time) for start, speed in zip(origin, velocity, strict=True)]
    k_x, k_z = Fraction(along[0]), Fraction(along[1])
    place = (
        float((k_x * moved[0] + k_z * moved[1]) % wave_groups.PERIOD),
        float((k_x * moved[1] - k_z * moved[0]) % wave_groups.PERIOD),
    )
    return GroupFactor(wave_groups.group_corners(groups.seed), along, groups.contrast, velocity, place)


@dataclass(frozen=True)
class WaveSet:
    """n waves as arrays of shape (n,). θ = phase − kx·x − kz·z with x, z counted from the origin."""

    amplitude: Floats
    exponent: Floats
    orbit: Floats  # horizontal amplitude of each wave's orbits at the surface, m
    k: Floats  # wavenumbers, rad/m
    kx: Floats
    kz: Floats
    omega: Floats  # angular frequencies, rad/s
    phase: Floats  # θ at the origin at the given time, in [0, 2π)
    groups: GroupFactor | None = None  # factor of the heights; None: 1

    @cached_property
    def level(self) -> float:
        """Mean of Σ A u^K, m: height of still water over the troughs. The mean of sin^2K is B(K + ½, ½)/π."""
        return sum(A * float(special.beta(K + 0.5, 0.5)) / math.pi for A, K, _ in self._shapes)

    @cached_property
    def _shapes(self) -> list[Vec3]:
        """(A, K, k) of the waves that are not flat."""
        shapes = zip(self.amplitude.tolist(), self.exponent.tolist(), self.k.tolist(), strict=True)
        return [shape for shape in shapes if shape[0] > 0.0]

    @cached_property
    def bounds(self) -> Bounds:
        """By sampling each wave; without the infinite second derivative at the cusp of K < 1."""
        highest, steepest, bends = float(self.amplitude.sum()), 0.0, []
        for A, K, k in self._shapes:
            change = wave_derivative(CYCLE, A, K)
            steepest += k * (STEEPEST if K < 0.5 else 1.001 * float(np.abs(change).max()))
            bends.append(k * k * np.abs(np.diff(change)).max())
        slope, curvature = steepest, 1.05 * float(sum(bends)) * BOUND_SAMPLES / (2.0 * math.pi)
        if self.groups is not None:
            # Greatest derivatives of the factor: those of smoothstep, 1.5 and 6 a cell.
            cell = math.hypot(*self.groups.along)
            rise = 1.000001 * self.groups.contrast * 1.5 * cell
            slope += highest * rise
            curvature = curvature + 2.0 * steepest * rise + highest * (self.groups.contrast * 6.0 * cell**2)
        # The finest crest is √(2/K)/k, 1/k for K < 2.
        shape = min((math.sqrt(2.0 / max(K, 2.0)) / k for _, K, k in self._shapes), default=math.inf)
        return Bounds(highest - self.level, -self.level, slope, curvature, shape)

    @cached_property
    def relief(self) -> float:
        """Slope amplitude of the sinusoid whose mean square slope is that of all waves together."""
        angles = np.linspace(0.0, 0.5 * math.pi, 2 * RELIEF_SAMPLES + 1)[1::2]
        theta: Floats = 2.0 * angles - 0.5 * math.pi
        squares = [float(np.mean((k * wave_derivative(theta, A, K)) ** 2)) for A, K, k in self._shapes]
        return math.sqrt(2.0 * sum(squares))

    def theta(self, x: Floats, z: Floats) -> Floats:
        """Phases at (x, z), m from the origin, shape (r,): (n, r) rad, not reduced."""
        return self.phase[:, None] - self.kx[:, None] * x - self.kz[:, None] * z

    def height(self, x: Floats, z: Floats) -> Floats:
        """Σ y over the waves at (x, z), minus its mean, times the factor of the groups; (r,) m."""
        return self._grouped(self._even_height(x, z), x, z)

    def gradient(self, x: Floats, z: Floats) -> Floats:
        slope = np.zeros((2, x.size))
        for i, theta in enumerate(self.theta(x, z)):
            k = np.array([[self.kx[i]], [self.kz[i]]])
            slope -= k * wave_derivative(theta, self.amplitude[i], self.exponent[i])
        if self.groups is None:
            return slope
        return self.groups(x, z) * slope + self._even_height(x, z) * self.groups.gradient(x, z)

    def _even_height(self, x: Floats, z: Floats) -> Floats:
        """The height without groups; (r,) m."""
        total = np.full_like(x, -self.level)
        for i, theta in enumerate(self.theta(x, z)):
            total += wave_height(theta, self.amplitude[i], self.exponent[i])
        return total

    def _grouped(self, values: Floats, x: Floats, z: Floats) -> Floats:
        return values if self.groups is None else values * self.groups(x, z)

    def to_rest(self, x: Floats, z: Floats) -> Floats:
        """Displacement from (x, z) to the rest position of the water, to first order in the slope, m; (2, r)."""
        by = np.zeros((2, x.size))
        for i, theta in enumerate(self.theta(x, z)):
            k = np.array([[self.kx[i]], [self.kz[i]]])
            by += k * (self.orbit[i] * np.cos(theta) / math.hypot(self.kx[i], self.kz[i]))
        return self._grouped(by, x, z)


GustField = Callable[[Floats, Floats], Floats]
"""The factor of gusts on the ripples' amplitude at (x, z), m from the origin; (r,), in [0, 2]."""


@dataclass(frozen=True)
class RippleSet:
    """n ripples as arrays of shape (n,), with θ as in :class:`WaveSet`."""

    slope: Floats
    kx: Floats
    kz: Floats
    phase: Floats
    gusts: GustField | None = None

    def gradient(self, x: Floats, z: Floats) -> Floats:
        """(c_x, c_z) = −Σ s k̂ cos θ at (x, z); (2, r)."""
        total = np.zeros((2, x.size))
        for s, kx, kz, phase in zip(self.slope, self.kx, self.kz, self.phase, strict=True):
            total -= s * np.array([[kx], [kz]]) / math.hypot(kx, kz) * np.cos(phase - kx * x - kz * z)
        return total if self.gusts is None else self.gusts(x, z) * total


def wave_height(theta: Floats, A: float, K: float) -> Floats:
    """y = A((sin θ + 1)/2)^K, in [0, A]; of the shape of ``theta``."""
    # (sin θ + 1)/2 is sin²(θ/2 + π/4), which has no cancellation at the trough.
    p = np.sin(0.5 * theta + 0.25 * math.pi)
    u = p * p
    # Products are several times faster than np.power.
    return A * (reduce(np.multiply, [u] * int(K)) if int(K) == K and K <= 16 else np.power(u, K))


def wave_derivative(theta: Floats, A: float, K: float) -> Floats:
    """dy/dθ = A K |p|^(2K−1) sign(p) c, m/rad; of the shape of ``theta``."""
    half = 0.5 * theta + 0.25 * math.pi
    p = np.sin(half)
    magnitude = np.abs(p)
    if K < 0.5:
        magnitude = np.maximum(magnitude, TROUGH)
    return A * K * np.power(magnitude, 2.0 * K - 1.0) * np.sign(p) * np.cos(half)


def reduced(*terms: Vec2, plus: float = 0.0) -> float:
    """Σ ab + plus modulo 2π, exact up to the last rounding; in [0, 2π)."""
    value = sum((Fraction(a) * Fraction(b) for a, b in terms), Fraction(plus))
    return float(value % _TWO_PI)


def noise_place(size: float, change: float, velocity: Vec2, time: float, origin: Vec2) -> Vec3:
    """An origin (x, z) in m at a time (s) in noise with cells of ``size`` m that drifts and changes; cells."""
    turn, cells = 2.0 * math.pi / (PERIOD * size), PERIOD / (2.0 * math.pi)
    return (
        cells * reduced((turn, origin[0]), (-turn * velocity[0], time)),
        cells * reduced((turn, origin[1]), (-turn * velocity[1], time)),
        cells * reduced((2.0 * math.pi / (PERIOD * change), time)),
    )


def angular_frequency(wave: ParametricWave) -> float:
    """ω = 2πs/λ, s = √(gλ/2π) unless given; rad/s."""
    speed = math.sqrt(GRAVITY * wave.wavelength / (2.0 * math.pi)) if wave.speed is None else wave.speed
    return 2.0 * math.pi * speed / wave.wavelength


def wavenumber(wavelength: float, depth: float | None) -> float:
    """k with k tanh(kh) = 2π/λ, rad/m; 2π/λ where the depth is None."""
    deep = 2.0 * math.pi / wavelength
    if depth is None:
        return deep
    # k tanh(kh) rises with k, is below k, and is k²h/(1 + kh) or more: its root bounds k from above.
    most = 0.5 * (deep + math.sqrt(deep * deep + 4.0 * deep / depth))
    return float(optimize.brentq(lambda k: k * math.tanh(k * depth) - deep, deep, most, xtol=1e-300, rtol=1e-15))


def afloat(scene: Scene, time: float, origin: Vec2) -> Vec2:
    """The origin (x, z) in the frame of the flowing water, which is the ground's at time 0; m."""
    if scene.current is None:
        return origin
    x, z = (
        float(Fraction(place) - Fraction(part) * Fraction(time))
        for place, part in zip(origin, scene.current.velocity, strict=True)
    )
    return x, z


def wave_set(scene: Scene, time: float, origin: Vec2, spatial: float = 1.0) -> WaveSet:
    """The scene's waves at a time (s) around an origin (x, z) in m; ``spatial`` scales the wavenumbers."""
    depth = scene.water.depth
    own = [(wave.amplitude, wave.exponent, wave.direction, orbit(wave, depth)) for wave in scene.waves]
    of_phase = [(wavenumber(wave.wavelength, depth) * spatial, angular_frequency(wave)) for wave in scene.waves]
    amplitude, exponent, heading, orbits = np.array(own, np.float64).reshape(-1, 4).T
    k, omega = np.array(of_phase, np.float64).reshape(-1, 2).T
    kx, kz = k * np.cos(heading), k * np.sin(heading)
    phase = [
        reduced((angular_frequency(wave), time), (-a, origin[0]), (-b, origin[1]), plus=wave.phase)
        for wave, a, b in zip(scene.waves, kx.tolist(), kz.tolist(), strict=True)
    ]
    groups = group_factor(scene, time, origin)
    return WaveSet(amplitude, exponent, orbits, k, kx, kz, omega, np.array(phase, np.float64), groups)


def ripple_set(
    ripples: Ripples | None, time: float, origin: Vec2, repeats: bool = False, gusts: GustField | None = None
) -> RippleSet:
    """Ripples at a time (s) around an origin (x, z) in m; empty without one."""
    drawn = [] if ripples is None else [ripple for cascade in ripple_cascades(ripples, repeats) for ripple in cascade]
    phase = [reduced((one.omega, time), (-one.kx, origin[0]), (-one.kz, origin[1]), plus=one.phase) for one in drawn]
    slope, kx, kz = np.array([(one.slope, one.kx, one.kz) for one in drawn], np.float64).reshape(-1, 3).T
    return RippleSet(slope, kx, kz, np.array(phase, np.float64), gusts)


def gust_field(ripples: Ripples | None, time: float, origin: Vec2) -> GustField | None:
    """Section 9: the gusts over ripples at a time (s) around an origin (x, z) in m; None without any."""
    if ripples is None or ripples.gusts is None:
        return None
    gusts, angle = ripples.gusts, ripples.downwind
    velocity = gusts.wind_speed * math.cos(angle), gusts.wind_speed * math.sin(angle)
    here = noise_place(gusts.size, gusts.change, velocity, time, origin)

    def factor(x: Floats, z: Floats) -> Floats:
        place = np.column_stack((x / gusts.size, z / gusts.size, np.zeros_like(x))) + here
        noise = fractal(place, np.zeros_like(x), GUST_OCTAVES, 64 * gusts.seed)
        return 1.0 + gusts.strength * np.clip(0.8 * noise, -1.0, 1.0)

    return factor
