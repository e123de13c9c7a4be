"""Water of a scene: its ripples, its body, its floor, and a river's current. docs/formulae.md, section 16."""

import math
from typing import Annotated, ClassVar

from pydantic import Field

from seafoam.scene.base import Angle, Downwind, InEffect, Part, Place, Radians, Rgb, Share
from seafoam.scene.light import Gusts


class Ripples(Part):
    """Wind ripples: they tilt the surface normal but do not change the surface height."""

    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    slope: float = Field(default=0.12, ge=0.0, le=0.6, description="Root mean square slope of the ripples")
    spread: Radians = Field(default=1.0, ge=0.0, le=3.1416)
    """Standard deviation of the ripples' directions, rad"""
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the ripples")
    gusts: Gusts | None = None
    """Moving patches of rougher and smoother ripples; absent: uniform ripples"""


_Length = Annotated[float, Field(ge=0.01, le=1000.0)]


class Water(Part):
    """Optical properties of the water, its floor, and its ripples."""

    absorption_length: tuple[_Length, _Length, _Length] = (7.0, 30.0, 70.0)
    """Distance after which absorption leaves 1/e of red, green and blue light, m (Outerra: 7, 30, 70)"""
    scattering: float = Field(default=0.005, ge=0.0, le=0.5)
    """Scattering coefficient, 1/m (Outerra: 0.005); larger values give brighter, murkier water"""
    depth: float | None = Field(default=None, ge=0.05, le=11000.0)
    """Depth of the floor below still water, m; absent: deep water"""
    floor_albedo: Rgb = Field(default=(0.62, 0.54, 0.40), description="Albedo of the floor, linear RGB")
    floor_tile: float | None = Field(default=None, ge=0.05, le=100.0)
    """Side of the square tiles on the floor, m; absent: no tiles"""
    view_below: bool = True
    """Draw the view from below the surface: Snell's window, total reflection, floor and water"""
    translucency: float = Field(default=0.25, ge=0.0, le=2.0)
    """Strength of the sunlight that shines through thin crests"""
    aeration: float = Field(default=0.0, ge=0.0, le=10.0)
    """Scattering coefficient of the air bubbles below foam, 1/m; makes the water there milky; 0: clear"""
    plume_depth: float = Field(default=1.5, ge=0.01, le=20.0)
    """Depth of the bubble plume where the saturation is 1, m; shallower in proportion to the saturation"""
    roughness: float = Field(default=0.05, ge=0.01, le=0.5)
    """Root mean square slope of the surface detail below ripple scale; larger values widen the sun's glint"""
    ripples: Ripples | None = Field(default=None, description="Wind ripples; absent: none")


STONES_MOST = 8
"""Maximum number of stones in a current."""


class Stone(Part):
    """A stone in a current: standing waves and white water lie behind it. Its shape is a hash of its place."""

    place: tuple[Place, Place] = Field(default=(0.0, -12.0), description="Centre (x, z), m")
    radius: float = Field(default=0.6, ge=0.1, le=10.0, description="Radius, m")
    waves: Share = 0.4
    """Amplitude of the waves at the stone, as a fraction of the velocity head U²/2g; 0: none"""
    height: float = Field(default=0.5, ge=0.0, le=1.5)
    """Height over still water, about, as a fraction of the radius; 0: just under the surface, not drawn"""

    @property
    def dome(self) -> float:
        """Height of the dome that planes cut to about the stone's height, m."""
        return round(1.12 * self.height * self.radius, 6)


class Current(Part):
    """A uniform current: it carries waves, ripples and foam past banks, floor and anything at anchor."""

    speed: float = Field(default=1.5, ge=0.0, le=10.0, description="Speed over the ground, m/s; 0: no current")
    direction: Angle = Field(default=0.0, description="Direction toward which the water flows, rad from +x toward +z")
    stones: tuple[Stone, ...] = Field(default=(), max_length=STONES_MOST, description="Stones in the river")

    @property
    def standing(self) -> tuple[Stone, ...]:
        """The stones that stand over the water."""
        return tuple(stone for stone in self.stones if stone.height > 0.0)

    @property
    def wetted(self) -> float:
        """Height over still water up to which water runs over stones, m: a share of the velocity head, and a film."""
        return round(0.04 + 0.0178 * self.speed**2, 4)

    @property
    def velocity(self) -> tuple[float, float]:
        """(x, z) m/s, rounded to 1 µm/s."""
        x, z = self.speed * math.cos(self.direction), self.speed * math.sin(self.direction)
        return round(x, 6), round(z, 6)
