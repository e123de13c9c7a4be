"""The scene model. SI units, right-handed, +y up, radians.

An effect whose part is absent is off. Unknown keys are rejected. Every number declares its unit and range here, and the
OpenAPI document, the panel of the web client and the validation errors are all generated from these descriptions.
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from seafoam.scene.boats import BOATS_MOST, Boat
from seafoam.scene.drift import Drift
from seafoam.scene.living import MASK_NAME, FoamLife
from seafoam.scene.rings import RINGS_MOST, Ring
from seafoam.scene.shore import Shore
from seafoam.scene.sky import Day, Gusts, Sky, sun_angles
from seafoam.scene.spray import Spray

Finite = Annotated[float, Field(allow_inf_nan=False)]

Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]

Rgb = tuple[Share, Share, Share]


class Part(BaseModel):
    """Base class of every part of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class ParametricWave(Part):
    """Periodic height field y = A((sin θ + 1)/2)^K (Van Drasek et al. 2010, in Yingst et al. 2011)."""

    model: Literal["parametric"] = "parametric"
    amplitude: float = Field(default=0.5, ge=0.0, le=50.0, description="A: height of the crest above the trough, m")
    wavelength: float = Field(default=12.0, ge=0.05, le=2000.0, description="λ: wavelength in deep water, m")
    direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction of travel, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    exponent: float = Field(
        default=2.0,
        ge=0.1,
        le=100.0,
        description="K: exponent of the profile; 1 is a sine, larger values sharpen the crests",
    )
    phase: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Phase θ at the origin at time 0, rad",
        json_schema_extra={"unit": "rad"},
    )
    speed: float | None = Field(
        default=None, ge=0.0, le=200.0, description="s: phase speed, m/s; absent: √(gλ/2π), the speed in deep water"
    )


class Sea(Part):
    """Wind-driven open sea: a JONSWAP spectrum (Hasselmann et al. 1973) on tiles."""

    model: Literal["gerstner", "fft"] = Field(
        default="fft",
        description="gerstner: dozens of waves on two tiles; fft: the whole spectrum on four tiles (Tessendorf 2001)",
    )
    wind: float = Field(
        default=10.0,
        ge=0.0,
        le=60.0,
        description="U: wind speed 10 m above the sea, m/s; sets wave height and peak period",
    )
    fetch: float = Field(
        default=2e5,
        ge=100.0,
        le=1e7,
        description="Fetch: distance over which the wind blows across the sea, m; longer gives higher and longer waves",
    )
    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction toward which the wind blows, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    spread: float = Field(
        default=6.0,
        ge=0.0,
        le=100.0,
        description="s: exponent of the directional spreading cos^2s(θ/2), θ the angle to the wind; larger "
        "values align the waves",
    )
    against: Share = Field(
        default=0.3,
        description="Factor on the energy of waves that travel against the wind; 0 removes them, as in rivers",
    )
    choppiness: Share = Field(
        default=0.9,
        description="λ: horizontal displacement of the water, as a fraction of that of trochoids in deep "
        "water; 0 gives rounded crests, 1 sharp ones",
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the wave amplitudes and phases")


Wave = ParametricWave
"""All wave models; becomes a union discriminated by ``model`` when there is a second one."""


class FrontSaturation(Part):
    """Foam that appears at the front of a crest and fades behind it: f = exp(−tan(θ/2 + δ))/C (Yingst et al. 2011).

    With several waves θ is the phase of their sum (its analytic signal), so one wave gives the paper's formula.
    """

    source: Literal["front"] = "front"
    constants: Literal["text", "listing"] = Field(
        default="text",
        description="Constants of the formula. text: δ = π/2, 2π, e, from the paper's text; listing: δ = "
        "1.07, 6.28, 2.718, from its code",
    )
    intensity: float = Field(
        default=4.0,
        ge=0.25,
        le=100.0,
        description="C: divisor of the saturation; larger values give less foam; the paper uses 4",
    )
    group: tuple[Share, Share] = Field(
        default=(0.0, 0.0),
        description="Thresholds of the wave envelope, as fractions of the greatest possible sum of the waves: "
        "no foam below the first, full foam above the second; (0, 0): foam on every crest, as in "
        "the paper",
    )
    decay: float | None = Field(
        default=None,
        ge=0.2,
        le=30.0,
        description="Decay time of the foam that a passing front leaves on the water, to 1/e, s; absent: foam "
        "fades over the wave behind the front, as in the paper",
    )

    @model_validator(mode="after")
    def _ordered(self) -> "FrontSaturation":
        if self.group[1] < self.group[0]:
            raise ValueError("group: the second threshold must not be below the first")
        if self.decay is not None and self.constants != "text":
            raise ValueError("decay: requires constants 'text'")
        return self


class HeightSaturation(Part):
    """Foam by wave height: f = (H − H0)/(Hmax − H0) (Kryachko 2005)."""

    source: Literal["height"] = "height"
    base: float = Field(
        default=0.3,
        ge=-100.0,
        le=100.0,
        description="H0: height above the waves' troughs at which foam starts, m",
    )
    full: float = Field(
        default=0.9, ge=-100.0, le=200.0, description="Hmax: height above these troughs at which the saturation is 1, m"
    )

    @model_validator(mode="after")
    def _ordered(self) -> "HeightSaturation":
        if self.full - self.base < 1e-3:
            raise ValueError("full: must be at least 0.001 m above base")
        return self


class SlopeSaturation(Part):
    """Foam on steep water: f = gain (1 − n.y − base), n the normal of the waves (GPU ocean, 2007: base 0)."""

    source: Literal["slope"] = "slope"
    gain: float = Field(
        default=6.0,
        ge=0.1,
        le=1000.0,
        description="Saturation per unit of 1 − n.y − base; larger values give more foam",
    )
    base: float = Field(
        default=0.0,
        ge=0.0,
        le=0.9,
        description="Value of 1 − n.y at which foam starts: 0.03 at a tilt of 14°, 0.13 at 30°",
    )
    blur: float = Field(
        default=0.0,
        ge=0.0,
        le=20.0,
        description="Distance of the four neighbours with which 1 − n.y is averaged, m; 0: no blur",
    )


class FoldSaturation(Part):
    """Foam where the sea folds, i.e. the Jacobian of its horizontal displacement is small, and for seconds after."""

    source: Literal["fold"] = "fold"
    coverage: float = Field(
        default=1.0,
        ge=0.0,
        le=10.0,
        description="Mean foam coverage, relative to the whitecap coverage for this wind (Monahan and "
        "O'Muircheartaigh 1980)",
    )
    softness: float = Field(
        default=1.2,
        ge=0.01,
        le=3.0,
        description="Width of the ramp from no foam to full foam, in standard deviations of the Jacobian",
    )
    decay: float = Field(default=3.0, ge=0.05, le=60.0, description="Decay time of the foam, to 1/e, s")
    lasting: bool = Field(
        default=False,
        description="Keep foam of the longer waves for 11 s instead of 3 s, which leaves trails behind "
        "breakers; the mean coverage stays the same",
    )


class SurfSaturation(Part):
    """Foam of the surf: it appears at breaking fronts, remains behind them, and drains down the beach."""

    source: Literal["surf"] = "surf"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation at a breaking front")
    life: float = Field(
        default=0.35, ge=0.02, le=5.0, description="Decay time behind the front, to 1/e, in wave periods"
    )
    veil: float = Field(
        default=0.1, ge=0.0, le=1.0, description="Saturation that remains in the surf zone between waves"
    )
    line: float = Field(
        default=0.0,
        ge=0.0,
        le=4.0,
        description="Saturation that the swash leaves on the sand, strongest along the line of maximum run-up",
    )


class DriftSaturation(Part):
    """Patches of foam that appear on the scene's ``drift`` square, are carried by its flow, and disappear."""

    source: Literal["drift"] = "drift"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of a patch halfway through its life")
    patch: float = Field(default=2.5, ge=0.05, le=500.0, description="Size of a patch when it appears, m")
    coverage: float = Field(
        default=0.3, ge=0.01, le=0.95, description="Fraction of the water covered by the patches of one generation"
    )
    life: float = Field(default=24.0, ge=1.0, le=120.0, description="Lifetime of a patch, s")
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the patches")


class WakeSaturation(Part):
    """Foam of boats: the turbulent band behind each boat, and the foam of its bow wave."""

    source: Literal["wake"] = "wake"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation directly behind the boat")
    life: float = Field(default=8.0, ge=0.1, le=60.0, description="Decay time behind the boat, to 1/e, s")
    bow: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of the bow wave at hull speed")


Saturation = Annotated[
    FrontSaturation
    | HeightSaturation
    | SlopeSaturation
    | FoldSaturation
    | SurfSaturation
    | DriftSaturation
    | WakeSaturation,
    Field(discriminator="source"),
]

Look = Literal["textured", "halftone", "fading", "halftone_textured", "listing", "filtered"]


class Foam(Part):
    """Foam: a saturation, thresholded by a halftone mask."""

    saturation: tuple[Saturation, ...] = Field(default=(FrontSaturation(),), min_length=1, max_length=4)
    combine: Literal["max", "product"] = Field(
        default="max", description="How the saturations of several sources are combined: maximum or product"
    )
    look: Look = Field(
        default="filtered",
        description="How saturation becomes foam. textured: a texture faded by f (figure 7a); halftone: eq. "
        "1; fading: eq. 2; halftone_textured: eq. 3; listing: the paper's published code; "
        "filtered: antialiased threshold with exact area coverage",
    )
    mask: str = Field(
        default="vac-24",
        max_length=40,
        pattern=MASK_NAME,
        description="Name of a mask in the catalogue, or family:sigma:size:seed, for lace also :aspect:age",
        json_schema_extra={"choices_from": "/api/masks"},
    )
    mask_tile: float = Field(
        default=12.0, ge=0.05, le=1000.0, description="Side of one tile of the mask, m; smaller gives finer bubbles"
    )
    mask_angle: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Rotation of the mask about +y, rad",
        json_schema_extra={"unit": "rad"},
    )
    cells: bool = Field(
        default=False,
        description="Rotate and shift the mask at random in hexagonal cells of one tile's size, so that it "
        "does not visibly repeat; has no effect with `life`",
    )
    texture_tile: float = Field(default=3.0, ge=0.05, le=1000.0, description="Side of one tile of the foam texture, m")
    texture_second: float | None = Field(
        default=None,
        ge=0.05,
        le=1000.0,
        description="Side of one tile of a second copy of the foam texture, with u and v swapped, m. The mean "
        "of both does not repeat if the two sides are incommensurable (2.7 and 3.14); absent: one "
        "copy",
    )
    texture: Share = Field(default=0.0, description="Weight of the foam texture in the filtered look; 0: none")
    fade: Share = Field(
        default=0.0,
        description="Width of the threshold ramp of the filtered look: bubbles fade over it before they "
        "disappear; 0: a hard threshold",
    )
    octaves: int = Field(
        default=1,
        ge=1,
        le=4,
        description="Number of octaves of the mask in the filtered look, each rotated and five times finer "
        "than the last; more keep detail near the camera",
    )
    life: FoamLife | None = Field(
        default=None,
        description="How foam of the filtered look moves and ages: carried by waves, gathered by wind, worn "
        "by age; absent: it does none of these",
    )
    thickness: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="Height of foam above the water, m; brightens edges that face the sun and shades the "
        "water beside them; 0: flat",
    )
    albedo: Share = Field(default=0.9, description="Albedo of foam: fraction of light that it scatters back")

    @model_validator(mode="after")
    def _one_of_each(self) -> "Foam":
        sources = [saturation.source for saturation in self.saturation]
        if len(set(sources)) < len(sources):
            raise ValueError("saturation: at most one entry per source")
        if self.life is not None and "drift" in sources:
            raise ValueError("life: cannot be combined with a drift saturation, whose flow already carries the foam")
        return self

    def lying_still(self) -> "Foam":
        """The same foam without what becomes of it after its birth: born anew at each moment, uncarried, flat."""
        made: list[Saturation] = []
        for source in self.saturation:
            match source:
                case FrontSaturation():
                    made.append(source.model_copy(update={"decay": None}))
                case FoldSaturation():
                    made.append(source.model_copy(update={"lasting": False}))
                case SurfSaturation():
                    made.append(source.model_copy(update={"line": 0.0}))
                case _:
                    made.append(source)
        return self.model_copy(update={"saturation": tuple(made), "life": None, "thickness": 0.0})


class Chop(Part):
    """Wind ripples: they tilt the surface normal but do not change the surface height."""

    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction toward which the wind blows, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    slope: float = Field(default=0.12, ge=0.0, le=0.6, description="Root mean square slope of the ripples")
    spread: float = Field(
        default=1.0,
        ge=0.0,
        le=3.1416,
        description="Standard deviation of the ripples' directions, rad",
        json_schema_extra={"unit": "rad"},
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the ripples")
    gusts: Gusts | None = Field(
        default=None, description="Moving patches of rougher and smoother ripples; absent: uniform ripples"
    )


class Water(Part):
    """Optical properties of the water, its floor, and its ripples."""

    absorption_length: tuple[
        Annotated[float, Field(ge=0.01, le=1000.0)],
        Annotated[float, Field(ge=0.01, le=1000.0)],
        Annotated[float, Field(ge=0.01, le=1000.0)],
    ] = Field(
        default=(7.0, 30.0, 70.0),
        description="Distance after which absorption leaves 1/e of red, green and blue light, m (Outerra: 7, 30, 70)",
    )
    scattering: float = Field(
        default=0.005,
        ge=0.0,
        le=0.5,
        description="Scattering coefficient, 1/m (Outerra: 0.005); larger values give brighter, murkier water",
    )
    depth: float | None = Field(
        default=None, ge=0.05, le=11000.0, description="Depth of the floor below still water, m; absent: deep water"
    )
    floor_albedo: Rgb = Field(default=(0.62, 0.54, 0.40), description="Albedo of the floor, linear RGB")
    floor_tile: float | None = Field(
        default=None, ge=0.05, le=100.0, description="Side of the square tiles on the floor, m; absent: no tiles"
    )
    view_below: bool = Field(
        default=True,
        description="Draw the view from below the surface: Snell's window, total reflection, floor and water",
    )
    translucency: float = Field(
        default=0.25, ge=0.0, le=2.0, description="Strength of the sunlight that shines through thin crests"
    )
    aeration: float = Field(
        default=0.0,
        ge=0.0,
        le=10.0,
        description="Scattering coefficient of the air bubbles below foam, 1/m; makes the water there milky; 0: clear",
    )
    plume_depth: float = Field(
        default=1.5,
        ge=0.01,
        le=20.0,
        description="Depth of the bubble plume where the saturation is 1, m; shallower in proportion to the saturation",
    )
    roughness: float = Field(
        default=0.05,
        ge=0.03,
        le=0.5,
        description="Root mean square slope of the surface detail below ripple scale; larger values widen the "
        "sun's glint",
    )
    chop: Chop | None = Field(default=None, description="Wind ripples; absent: none")


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


class Light(Part):
    """Sun, sky and haze. Absent: unlit, white foam on black, as in the paper's equations."""

    sun_azimuth: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Azimuth of the sun, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    sun_elevation: float = Field(
        default=0.6,
        ge=-1.5708,
        le=1.5708,
        description="Elevation of the sun above the horizon, rad",
        json_schema_extra={"unit": "rad"},
    )
    turbidity: float = Field(default=2.5, ge=1.0, le=10.0, description="Turbidity of the air: 1 pure, 2 clear, 10 hazy")
    visibility: float = Field(
        default=20000.0, ge=50.0, le=1e6, description="Visibility: distance at which contrast has fallen to 2 %, m"
    )
    exposure: float = Field(default=0.0, ge=-10.0, le=10.0, description="Exposure, stops; +1 doubles the brightness")
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


class Camera(Part):
    """A pinhole camera. Yaw 0 looks toward −z, a positive yaw turns toward +x, a positive pitch looks up."""

    position: tuple[
        Annotated[float, Field(ge=-1e7, le=1e7)],
        Annotated[float, Field(ge=-1000.0, le=1e5)],
        Annotated[float, Field(ge=-1e7, le=1e7)],
    ] = Field(default=(0.0, 6.0, 0.0), description="Position of the camera, m; y is measured from still water")
    yaw: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Yaw, rad from −z toward +x",
        json_schema_extra={"unit": "rad"},
    )
    pitch: float = Field(
        default=-0.15,
        ge=-1.5708,
        le=1.5708,
        description="Pitch, rad; positive looks up",
        json_schema_extra={"unit": "rad"},
    )
    roll: float = Field(
        default=0.0,
        ge=-3.1416,
        le=3.1416,
        description="Roll about the view axis, rad",
        json_schema_extra={"unit": "rad"},
    )
    fov: float = Field(
        default=0.8727, ge=0.01, le=2.6, description="Vertical field of view, rad", json_schema_extra={"unit": "rad"}
    )


class Scene(Part):
    """A scene: water, foam, shore, objects, light and camera."""

    waves: tuple[Wave, ...] = Field(default=(), max_length=16)
    rings: tuple[Ring, ...] = Field(
        default=(), max_length=RINGS_MOST, description="Circular waves from stones, drops and blasts"
    )
    sea: Sea | None = Field(default=None, description="Wind-driven open sea; absent: none")
    foam: Foam | None = Field(default=None, description="Foam; absent: none")
    water: Water = Field(default_factory=Water)
    shore: Shore | None = Field(default=None, description="Sea floor, land and surf; absent: open sea")
    drift: Drift | None = Field(
        default=None, description="Flow that carries the foam of a drift saturation; absent: no flow"
    )
    spray: Spray | None = Field(default=None, description="Drops thrown up by waves and surf; absent: none")
    boats: tuple[Boat, ...] = Field(default=(), max_length=BOATS_MOST, description="Boats on the water")
    light: Light | None = Field(
        default_factory=Light, description="Sun, sky and haze; null: unlit, white foam on black"
    )
    camera: Camera = Field(default_factory=Camera)
