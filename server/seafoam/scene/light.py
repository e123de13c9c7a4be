"""Light of a scene: sun or moon, sky, wind and gusts, glitter and caustics. docs/formulae.md, section 9."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from seafoam.scene.base import Angle, Downwind, Elevation, Follows, InEffect, Part, Radians, Share

TILT = math.radians(23.44)
"""Axial tilt of the earth, rad."""
Direction = tuple[float, float, float]


class Day(Part):
    """Time of day and place on earth, which determine the sun's position."""

    hour: float = Field(default=12.0, ge=0.0, le=24.0, description="Solar time, h; the sun is highest at 12")
    date: float = Field(default=172.0, ge=1.0, le=366.0, description="Day of the year; 172 is 21 June")
    latitude: Elevation = Field(default=0.8, description="Latitude, rad; positive is north")
    north: Angle = Field(default=-1.5708, description="Azimuth of north, rad from +x toward +z")


class Wind(Part):
    """The scene's wind. Every part that the wind moves follows it, but for fields in which the part has its own."""

    speed: float = Field(default=10.0, ge=0.0, le=60.0, description="U: wind speed 10 m above the water, m/s")
    direction: Angle = Field(default=0.0, description="Direction toward which the wind blows, rad from +x toward +z")


class Clouds(Part):
    """A layer of clouds: gradient noise that drifts with the wind and changes shape, lit from the lamp's side."""

    cover: Annotated[float, Field(ge=0.0, le=1.0, description="Fraction of the sky covered by clouds")] = 0.4
    thickness: float = Field(default=6.0, ge=0.0, le=50.0)
    """Optical depth of the densest cloud; larger values darken the clouds and hide the sun"""
    softness: float = Field(default=1.0, ge=0.05, le=3.0)
    """Width of the clouds' edges, in standard deviations of the noise; larger values are softer"""
    size: float = Field(default=2500.0, ge=50.0, le=50000.0, description="Size of the largest clouds, m")
    height: float = Field(default=1800.0, ge=200.0, le=15000.0, description="Altitude of the clouds' bases, m")
    depth: float = Field(default=700.0, ge=0.0, le=5000.0)
    """Height of the clouds from base to top, m; 0: a thin layer"""
    rain: float = Field(default=0.0, ge=0.0, le=10.0)
    """Optical depth of the rain below the densest clouds, seen as veils in the distance; 0: none"""
    shadows: Share = 0.0
    """Strength of the clouds' shadows and of the sunlit gaps between them; 0: their mean everywhere"""
    wind: Annotated[float | None, Follows("speed", alone=8.0, factor=1.6)] = Field(default=None, ge=0.0, le=100.0)
    """Drift speed of the clouds, m/s; null: 1.6 times the scene's wind"""
    wind_speed: ClassVar[InEffect] = InEffect("wind")
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    change: float = Field(default=400.0, ge=10.0, le=1e6, description="Time scale on which a cloud changes shape, s")
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the clouds")


class Cirrus(Part):
    """High clouds of ice: streaks that drift with the wind."""

    cover: Annotated[float, Field(ge=0.0, le=1.0, description="Fraction of the sky with streaks")] = 0.4
    thickness: float = Field(default=0.8, ge=0.0, le=5.0, description="Optical depth of the densest streaks")
    size: float = Field(default=4000.0, ge=500.0, le=50000.0, description="Width of the largest streaks, m")
    height: float = Field(default=9000.0, ge=3000.0, le=15000.0, description="Altitude of the streaks, m")
    direction: Annotated[Angle | None, Follows("direction", alone=0.6)] = None
    """Direction of the streaks and of their drift, rad from +x toward +z; null: as the scene's wind"""
    downwind: ClassVar[InEffect] = InEffect("direction")
    wind: Annotated[float | None, Follows("speed", alone=25.0, factor=2.5)] = Field(default=None, ge=0.0, le=150.0)
    """Drift speed of the streaks, m/s; null: 2.5 times the scene's wind"""
    wind_speed: ClassVar[InEffect] = InEffect("wind")
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the streaks")


class Moon(Part):
    """A moon; its phase follows from the sun's position. It lights the water when the sun is well below the horizon."""

    azimuth: Angle = Field(default=-1.2, description="Azimuth of the moon, rad from +x toward +z")
    elevation: Elevation = Field(default=0.35, description="Elevation of the moon above the horizon, rad")
    brightness: float = Field(default=1.0, ge=0.0, le=10.0)
    """Brightness of the moonlight; at 1 a full moon gives 1 % of the sun's light (in reality 1/400 000)"""
    size: float = Field(default=1.0, ge=0.5, le=20.0)
    """Angular diameter, relative to the real moon's (0.52°)"""


class Sky(Part):
    """A sky with longer light paths near the horizon; absent: a plain clear sky."""

    haze: float = Field(default=0.5, ge=0.0, le=20.0, description="Optical depth of the haze along the horizon")
    stars: float = Field(default=0.0, ge=0.0, le=10.0, description="Brightness of the stars at night; 0: none")
    clouds: Clouds | None = Field(default=None, description="Cloud layer; absent: none")
    cirrus: Cirrus | None = Field(default=None, description="High clouds; absent: none")
    moon: Moon | None = Field(default=None, description="Moon; absent: none")


class Gusts(Part):
    """Gusts: moving patches of rougher and smoother ripples."""

    strength: Share = Field(default=0.6, description="Relative variation of the ripples' slope about its mean")
    size: float = Field(default=25.0, ge=0.5, le=5000.0, description="Size of the largest patches, m")
    speed: Annotated[float | None, Follows("speed", alone=3.0, factor=0.8)] = Field(default=None, ge=0.0, le=60.0)
    """Speed at which the patches move with the wind, m/s; null: 0.8 times the scene's wind"""
    wind_speed: ClassVar[InEffect] = InEffect("speed")
    change: float = Field(default=12.0, ge=0.5, le=1e5, description="Time scale on which a patch changes shape, s")
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the gusts")


def direction(azimuth: float, elevation: float) -> Direction:
    """Return the unit vector toward azimuth and elevation, rad."""
    level = math.cos(elevation)
    return level * math.cos(azimuth), math.sin(elevation), level * math.sin(azimuth)


def sun_angles(day: Day) -> tuple[float, float]:
    """Return azimuth and elevation of the sun, rad (declination after Cooper 1969).

    At the zenith its azimuth is south or north, depending on rounding.
    """
    declination = TILT * math.sin(2.0 * math.pi * (284.0 + day.date) / 365.0)
    turn = math.pi * (day.hour - 12.0) / 12.0
    up = math.sin(day.latitude) * math.sin(declination)
    up += math.cos(day.latitude) * math.cos(declination) * math.cos(turn)
    north = math.cos(day.latitude) * math.sin(declination)
    north -= math.sin(day.latitude) * math.cos(declination) * math.cos(turn)
    east = -math.cos(declination) * math.sin(turn)
    # x runs east where z runs south: from north toward east is from +x toward +z.
    azimuth = day.north + math.atan2(east, north)
    return math.remainder(azimuth, 2.0 * math.pi), math.asin(min(max(up, -1.0), 1.0))


class Sparkles(Part):
    """Sparkles in the sun's reflection (GPU ocean, 2007); their mean radiance is that of the smooth glint."""

    size: Radians = Field(default=0.0016, ge=2e-4, le=0.02)
    """Angular diameter of a sparkle, independent of the picture's size, rad"""
    rate: float = Field(default=1.0, ge=0.1, le=10000.0)
    """Births of sparkles per second and square degree, where the glint is as bright as white paper in the sun; fewer
    sparkles are brighter, so that the mean stays"""
    life: float = Field(default=0.3, ge=0.02, le=10.0, description="Lifetime of a sparkle, s")
    share: float = Field(default=0.9, ge=0.05, le=1.0)
    """Fraction of the glint that is drawn as sparkles; the rest is smooth"""


class Caustics(Part):
    """Caustics: sunlight that the ripples focus on a level floor.

    With caustics, ripples and caustics repeat every 9.3 m; without, ripples never repeat.
    """

    dispersion: float = Field(default=1.0, ge=0.0, le=10.0)
    """Difference of the refractive index between red and blue, relative to that of water (0.0075); 0: no colour
    fringes"""


ToneCurve = Literal["filmic", "photographic"]


class Light(Part):
    """Sun, sky and haze. Absent: unlit, white foam on black, as in the paper's equations."""

    sun_azimuth: Angle = Field(default=0.0, description="Azimuth of the sun, rad from +x toward +z")
    sun_elevation: Elevation = Field(default=0.6, description="Elevation of the sun above the horizon, rad")
    turbidity: float = Field(default=2.5, ge=1.0, le=10.0, description="Turbidity of the air: 1 pure, 2 clear, 10 hazy")
    visibility: float = Field(default=20000.0, ge=50.0, le=1e6)
    """Visibility: distance at which contrast has fallen to 2 %, m"""
    exposure: float = Field(default=0.0, ge=-10.0, le=10.0, description="Exposure, stops; +1 doubles the brightness")
    tone: ToneCurve = "filmic"
    """Tone curve. filmic: contrasty, and white early; photographic: a long shoulder that holds colour around the sun"""
    glare: float = Field(default=0.0, ge=0.0, le=0.5)
    """Fraction of the light that spreads around bright spots, as in an eye or a lens; 0: none"""
    day: Day | None = None
    """Time of day and place, which set the sun's position; absent: sun_azimuth and sun_elevation do"""
    sky: Sky | None = Field(default=None, description="Haze, clouds, moon and stars; absent: a clear sky")
    reflection: Literal["sky", "cubemap", "planar"] = "sky"
    """What the water reflects. sky: the sky only; cubemap: sky and land, seen from directly below the camera; planar:
    sky and boats"""
    specular: Literal["glint", "blinn_phong"] = "glint"
    """Model of the sun's reflection. glint: Beckmann distribution of the slopes that are too small to resolve;
    blinn_phong: Blinn-Phong highlight whose half vector is perturbed by the ripples"""
    specular_power: float = Field(default=364.0, ge=1.0, le=2000.0)
    """Exponent of blinn_phong; larger values give a smaller highlight"""
    specular_perturb: float = Field(default=0.4, ge=0.0, le=10.0)
    """Perturbation of blinn_phong's half vector by the tilt of the normal"""
    sparkles: Sparkles | None = Field(default=None, description="Sparkles in the sun's reflection; absent: none")
    caustics: Caustics | None = None
    """Caustics: sunlight that the ripples focus on the floor; absent: a uniformly lit floor"""

    @property
    def sun(self) -> tuple[float, float]:
        """Azimuth and elevation of the sun, rad."""
        return (self.sun_azimuth, self.sun_elevation) if self.day is None else sun_angles(self.day)
