"""Light of a scene: sun or moon, sky, glitter and caustics."""

from typing import Literal

from pydantic import Field

from seafoam.scene.base import Angle, Elevation, Part
from seafoam.scene.sky import Day, Sky, sun_angles


class Sparkles(Part):
    """Sparkles in the sun's reflection (GPU ocean, 2007); their mean radiance is that of the smooth glint."""

    size: float = Field(
        default=0.0016,
        ge=2e-4,
        le=0.02,
        description="Angular diameter of a sparkle, independent of the picture's size, rad",
        json_schema_extra={"unit": "rad"},
    )
    rate: float = Field(
        default=1.0,
        ge=0.1,
        le=10000.0,
        description="Births of sparkles per second and square degree, where the glint is as bright as white "
        "paper in the sun; fewer sparkles are brighter, so that the mean stays",
    )
    life: float = Field(default=0.3, ge=0.02, le=10.0, description="Lifetime of a sparkle, s")
    share: float = Field(
        default=0.9, ge=0.05, le=1.0, description="Fraction of the glint that is drawn as sparkles; the rest is smooth"
    )


class Caustics(Part):
    """Caustics: sunlight that the ripples focus on a level floor.

    With caustics, ripples and caustics repeat every 9.3 m; without, ripples never repeat.
    """

    dispersion: float = Field(
        default=1.0,
        ge=0.0,
        le=10.0,
        description="Difference of the refractive index between red and blue, relative to that of water "
        "(0.0075); 0: no colour fringes",
    )


ToneCurve = Literal["filmic", "photographic"]


class Light(Part):
    """Sun, sky and haze. Absent: unlit, white foam on black, as in the paper's equations."""

    sun_azimuth: Angle = Field(default=0.0, description="Azimuth of the sun, rad from +x toward +z")
    sun_elevation: Elevation = Field(default=0.6, description="Elevation of the sun above the horizon, rad")
    turbidity: float = Field(default=2.5, ge=1.0, le=10.0, description="Turbidity of the air: 1 pure, 2 clear, 10 hazy")
    visibility: float = Field(
        default=20000.0, ge=50.0, le=1e6, description="Visibility: distance at which contrast has fallen to 2 %, m"
    )
    exposure: float = Field(default=0.0, ge=-10.0, le=10.0, description="Exposure, stops; +1 doubles the brightness")
    tone: ToneCurve = Field(
        default="filmic",
        description="Tone curve. filmic: contrasty, and white early; photographic: a long shoulder that holds colour "
        "around the sun",
    )
    glare: float = Field(
        default=0.0,
        ge=0.0,
        le=0.5,
        description="Fraction of the light that spreads around bright spots, as in an eye or a lens; 0: none",
    )
    day: Day | None = Field(
        default=None,
        description="Time of day and place, which set the sun's position; absent: sun_azimuth and sun_elevation do",
    )
    sky: Sky | None = Field(default=None, description="Haze, clouds, moon and stars; absent: a clear sky")
    reflection: Literal["sky", "cubemap", "planar"] = Field(
        default="sky",
        description="What the water reflects. sky: the sky only; cubemap: sky and land, seen from directly "
        "below the camera; planar: sky and boats",
    )
    specular: Literal["glint", "blinn_phong"] = Field(
        default="glint",
        description="Model of the sun's reflection. glint: Beckmann distribution of the slopes that are too "
        "small to resolve; blinn_phong: Blinn-Phong highlight whose half vector is perturbed by "
        "the ripples",
    )
    specular_power: float = Field(
        default=364.0, ge=1.0, le=2000.0, description="Exponent of blinn_phong; larger values give a smaller highlight"
    )
    specular_perturb: float = Field(
        default=0.4, ge=0.0, le=10.0, description="Perturbation of blinn_phong's half vector by the tilt of the normal"
    )
    sparkles: Sparkles | None = Field(default=None, description="Sparkles in the sun's reflection; absent: none")
    caustics: Caustics | None = Field(
        default=None,
        description="Caustics: sunlight that the ripples focus on the floor; absent: a uniformly lit floor",
    )

    @property
    def sun(self) -> tuple[float, float]:
        """Azimuth and elevation of the sun, rad."""
        return (self.sun_azimuth, self.sun_elevation) if self.day is None else sun_angles(self.day)
