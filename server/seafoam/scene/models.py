"""The Scene: what the sea is. SI units, right-handed, +y up, radians.

An effect that is absent is off. Unknown keys are refused. Every number states its unit and range here, and the
OpenAPI page, the panel of the web client and the validation errors all come from these descriptions.
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
    """Base of every part of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class ParametricWave(Part):
    """Periodic height field y = A((sin θ + 1)/2)^K (Van Drasek et al. 2010, in Yingst et al. 2011)."""

    model: Literal["parametric"] = "parametric"
    amplitude: float = Field(default=0.5, ge=0.0, le=50.0, description="A: height of the crest above the trough, m")
    wavelength: float = Field(default=12.0, ge=0.05, le=2000.0, description="λ: crest to crest in deep water, m")
    direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading of travel, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    exponent: float = Field(default=2.0, ge=0.1, le=100.0, description="K: 1 is a sine, more sharpens the crest")
    phase: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="θ at the origin at time 0, rad",
        json_schema_extra={"unit": "rad"},
    )
    speed: float | None = Field(
        default=None, ge=0.0, le=200.0, description="s: phase speed, m/s; absent: √(gλ/2π), deep water"
    )


class Sea(Part):
    """Open sea that a wind raises: a JONSWAP spectrum (Hasselmann et al. 1973) drawn on tiles."""

    model: Literal["gerstner", "fft"] = Field(
        default="fft",
        description="gerstner: dozens of waves on two tiles; fft: every wavevector of four tiles (Tessendorf 2001)",
    )
    wind: float = Field(default=10.0, ge=0.0, le=60.0, description="Wind speed 10 m above the sea, m/s")
    fetch: float = Field(default=2e5, ge=100.0, le=1e7, description="Way over which the wind has raised the sea, m")
    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading of the wind, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    spread: float = Field(
        default=6.0, ge=0.0, le=100.0, description="s: energy goes with cos^2s of half the angle to the wind"
    )
    against: Share = Field(default=0.3, description="Share left of the waves against the wind; 0 for rivers")
    choppiness: Share = Field(
        default=0.9, description="λ: how far water moves along as it rises; 0 sines, 1 the trochoids of deep water"
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Which sea of its kind")


Wave = ParametricWave
"""Every wave model; becomes a union, told apart by ``model``, when the second one arrives."""


class FrontSaturation(Part):
    """Foam born at the front of a crest and fading behind it: f = exp(−tan(θ/2 + δ))/C (Yingst et al. 2011).

    With several waves θ is the phase of their sum (its analytic signal), so one wave gives the paper's formula.
    """

    source: Literal["front"] = "front"
    constants: Literal["text", "listing"] = Field(
        default="text",
        description="text: δ = π/2, 2π, e, as in the paper's text; listing: δ = 1.07, 6.28, 2.718, as in its code",
    )
    intensity: float = Field(
        default=4.0, ge=0.25, le=100.0, description="C: the larger, the less foam; the paper uses 4"
    )
    group: tuple[Share, Share] = Field(
        default=(0.0, 0.0),
        description="Crests foam where the waves add up: none below the first, full above the second share of the "
        "greatest possible sum; (0, 0) foams everywhere, as in the paper",
    )
    decay: float | None = Field(
        default=None,
        ge=0.2,
        le=30.0,
        description="Foam stays on the water that a front has passed and is down to 1/e after so long, s; absent: it "
        "fades over the wave behind the front, as in the paper",
    )

    @model_validator(mode="after")
    def _ordered(self) -> "FrontSaturation":
        if self.group[1] < self.group[0]:
            raise ValueError("group: the second share must not be below the first")
        if self.decay is not None and self.constants != "text":
            raise ValueError("decay: only with the constants of the text")
        return self


class HeightSaturation(Part):
    """Foam by height: f = (H − H0)/(Hmax − H0) (Kryachko 2005)."""

    source: Literal["height"] = "height"
    base: float = Field(
        default=0.3,
        ge=-100.0,
        le=100.0,
        description="H0: height over the parametric waves' troughs where foam starts, m",
    )
    full: float = Field(
        default=0.9, ge=-100.0, le=200.0, description="Hmax: height where foam is full, counted as H0 is, m"
    )

    @model_validator(mode="after")
    def _ordered(self) -> "HeightSaturation":
        if self.full - self.base < 1e-3:
            raise ValueError("full: must be at least 0.001 m above base")
        return self


class SlopeSaturation(Part):
    """Foam where the water is steep: f = gain (1 − n.y − base), n the waves' normal (GPU ocean, 2007: base 0)."""

    source: Literal["slope"] = "slope"
    gain: float = Field(default=6.0, ge=0.1, le=1000.0, description="f over 1 − n.y − base; the larger, the more foam")
    base: float = Field(default=0.0, ge=0.0, le=0.9, description="1 − n.y where foam starts: 0.03 at 14°, 0.13 at 30°")
    blur: float = Field(
        default=0.0, ge=0.0, le=20.0, description="1 − n.y is the mean of a place and four so far around it, m"
    )


class FoldSaturation(Part):
    """Foam where the sea folds: where the Jacobian of its horizontal displacement falls, and some seconds after."""

    source: Literal["fold"] = "fold"
    coverage: float = Field(
        default=1.0,
        ge=0.0,
        le=10.0,
        description="Mean foam over the whitecaps that the wind raises (Monahan and O'Muircheartaigh 1980)",
    )
    softness: float = Field(
        default=1.2, ge=0.01, le=3.0, description="From no foam to full, in standard deviations of the Jacobian"
    )
    decay: float = Field(default=3.0, ge=0.05, le=60.0, description="Foam is down to 1/e after so long, s")
    lasting: bool = Field(
        default=False,
        description="Foam of the larger waves stays for 11 s instead of 3: trails behind breakers; as much in all",
    )


class SurfSaturation(Part):
    """Foam of the surf: born where a shore wave breaks, left behind it, draining down the beach."""

    source: Literal["surf"] = "surf"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation on a breaking front")
    life: float = Field(default=0.35, ge=0.02, le=5.0, description="Time to 1/e behind the front, in periods")
    veil: float = Field(default=0.1, ge=0.0, le=1.0, description="Saturation that stays in the surf between waves")
    line: float = Field(
        default=0.0, ge=0.0, le=4.0, description="Saturation that the swash leaves on the sand, and where it turned"
    )


class DriftSaturation(Part):
    """Patches of foam that come up everywhere on the scene's ``drift`` square, are carried by its flow, and go."""

    source: Literal["drift"] = "drift"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of a patch at the middle of its life")
    patch: float = Field(default=2.5, ge=0.05, le=500.0, description="Size of a patch when it comes up, m")
    coverage: float = Field(
        default=0.3, ge=0.01, le=0.95, description="Share of the water that patches of one age cover"
    )
    life: float = Field(default=24.0, ge=1.0, le=120.0, description="From coming up to going, s")
    seed: int = Field(default=1, ge=0, le=65535, description="Which patches of their kind")


class WakeSaturation(Part):
    """Foam of boats: the churned band that each leaves behind it, and what its bow throws aside."""

    source: Literal["wake"] = "wake"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation right behind the boat")
    life: float = Field(default=8.0, ge=0.1, le=60.0, description="Time to 1/e behind it, s")
    bow: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of the bow's wave, at hull speed")


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
    """Foam: saturation, thresholded by a halftone mask."""

    saturation: tuple[Saturation, ...] = Field(default=(FrontSaturation(),), min_length=1, max_length=4)
    combine: Literal["max", "product"] = Field(default="max", description="How several saturations join")
    look: Look = Field(
        default="filtered",
        description="textured: a texture faded by f (figure 7a); halftone: eq. 1; fading: eq. 2; halftone_textured: "
        "eq. 3; listing: the published code; filtered: the area-correct threshold",
    )
    mask: str = Field(
        default="vac-24",
        max_length=40,
        pattern=MASK_NAME,
        description="A mask of the catalogue, or family:sigma:size:seed; lace: also :aspect:age",
        json_schema_extra={"choices_from": "/api/masks"},
    )
    mask_tile: float = Field(default=12.0, ge=0.05, le=1000.0, description="Side of one tile of the mask, m")
    mask_angle: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Turn of the mask about +y, rad",
        json_schema_extra={"unit": "rad"},
    )
    cells: bool = Field(
        default=False,
        description="Turn and shift the mask anew in each hexagonal cell of a tile's size, so that it never repeats; "
        "foam that lives is carried whole and has none",
    )
    texture_tile: float = Field(default=3.0, ge=0.05, le=1000.0, description="Side of one tile of the foam texture, m")
    texture_second: float | None = Field(
        default=None,
        ge=0.05,
        le=1000.0,
        description="Side of one tile of a second copy of the foam texture, u and v swapped, m; the mean of both never "
        "repeats where the sides have no common measure (2.7 and 3.14); absent: one copy",
    )
    texture: Share = Field(default=0.0, description="How much the foam texture thins the filtered look")
    fade: Share = Field(
        default=0.0, description="Width of the filtered look's ramp: bubbles fade over it before they pop"
    )
    octaves: int = Field(
        default=1,
        ge=1,
        le=4,
        description="Times that the filtered look thresholds by the mask, each time turned and five times finer, as "
        "far as a pixel shows it: foam keeps detail near the eye",
    )
    life: FoamLife | None = Field(
        default=None,
        description="What becomes of foam in the filtered look: carried, gathered, older; absent: it lies still",
    )
    thickness: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="Height of foam over the water, m: its edges toward the sun are brighter, and it shades the water",
    )
    albedo: Share = Field(default=0.9, description="Share of light that foam scatters back")

    @model_validator(mode="after")
    def _one_of_each(self) -> "Foam":
        sources = [saturation.source for saturation in self.saturation]
        if len(set(sources)) < len(sources):
            raise ValueError("saturation: at most one of each source")
        if self.life is not None and "drift" in sources:
            raise ValueError("life: not with a drift saturation, whose flow carries the foam itself")
        return self


class Chop(Part):
    """Wind ripples, too small for the mesh: they tilt the surface and leave its height alone."""

    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading of the wind, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    slope: float = Field(default=0.12, ge=0.0, le=0.6, description="Root mean square slope of all ripples")
    spread: float = Field(
        default=1.0,
        ge=0.0,
        le=3.1416,
        description="Standard deviation of their headings, rad",
        json_schema_extra={"unit": "rad"},
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Which ripples of their kind")
    gusts: Gusts | None = Field(default=None, description="Patches of rougher ripples; absent: all alike")


class Water(Part):
    """The body of the water, and the ripples on it."""

    absorption_length: tuple[
        Annotated[float, Field(ge=0.01, le=1000.0)],
        Annotated[float, Field(ge=0.01, le=1000.0)],
        Annotated[float, Field(ge=0.01, le=1000.0)],
    ] = Field(default=(7.0, 30.0, 70.0), description="Distance to 1/e for red, green, blue, m (Outerra: 7, 30, 70)")
    scattering: float = Field(default=0.005, ge=0.0, le=0.5, description="Scattering coefficient, 1/m (Outerra: 0.005)")
    depth: float | None = Field(
        default=None, ge=0.05, le=11000.0, description="Depth of the floor under still water, m; absent: deep water"
    )
    floor_albedo: Rgb = Field(default=(0.62, 0.54, 0.40), description="Reflectance of the floor")
    floor_tile: float | None = Field(
        default=None, ge=0.05, le=100.0, description="Side of the tiles that the floor is laid with, m; absent: bare"
    )
    view_below: bool = Field(
        default=True,
        description="What an eye under the surface sees: Snell's window, total reflection, floor and water",
    )
    translucency: float = Field(
        default=0.25, ge=0.0, le=2.0, description="How strongly a thin crest lets the sun through"
    )
    aeration: float = Field(
        default=0.0,
        ge=0.0,
        le=10.0,
        description="Scattering coefficient of the bubbles in the water under foam, 1/m; 0: the water stays clear",
    )
    plume_depth: float = Field(
        default=1.5,
        ge=0.01,
        le=20.0,
        description="How deep bubbles reach where the saturation is 1, m; less foam, the shallower",
    )
    roughness: float = Field(
        default=0.05, ge=0.03, le=0.5, description="Root mean square slope of what is smaller than a ripple"
    )
    chop: Chop | None = Field(default=None, description="Wind ripples; absent: none")


class Sparkles(Part):
    """Small sparks in the sun's reflection (GPU ocean, 2007); their mean light is that of the smooth glint."""

    size: float = Field(
        default=0.0016,
        ge=2e-4,
        le=0.02,
        description="Angle that a sparkle takes up, whatever the picture's size, rad",
        json_schema_extra={"unit": "rad"},
    )
    rate: float = Field(
        default=1.0,
        ge=0.1,
        le=10000.0,
        description="Sparkles a second in a square degree of glint that is as bright as white paper in the sun; the "
        "fewer, the brighter each",
    )
    life: float = Field(default=0.3, ge=0.02, le=10.0, description="How long a sparkle lasts, s")
    share: float = Field(
        default=0.9, ge=0.05, le=1.0, description="Share of the glint that sparkles; the rest is smooth"
    )


class Caustics(Part):
    """Sunlight that the ripples focus on a level floor.

    With it the ripples repeat: every 9.3 m instead of never, and so does their light.
    """

    dispersion: float = Field(
        default=1.0,
        ge=0.0,
        le=10.0,
        description="Spread of the index between red and blue, in that of water (0.0075); 0: all colours alike",
    )


class Light(Part):
    """Sun, sky and haze. Absent: no light at all, foam white on black as the paper's equations have it."""

    sun_azimuth: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Where the sun stands, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    sun_elevation: float = Field(
        default=0.6,
        ge=-1.5708,
        le=1.5708,
        description="Height of the sun over the horizon, rad",
        json_schema_extra={"unit": "rad"},
    )
    turbidity: float = Field(default=2.5, ge=1.0, le=10.0, description="Haze of the air: 1 pure air, 2 clear, 10 hazy")
    visibility: float = Field(
        default=20000.0, ge=50.0, le=1e6, description="Distance at which contrast has fallen to 2 %, m"
    )
    exposure: float = Field(default=0.0, ge=-10.0, le=10.0, description="Exposure, stops")
    day: Day | None = Field(
        default=None, description="Time of day, which moves the sun; absent: it stands as said above"
    )
    sky: Sky | None = Field(default=None, description="Haze, clouds, moon and stars; absent: a plain clear sky")
    reflection: Literal["sky", "cubemap", "planar"] = Field(
        default="sky",
        description="What the water mirrors. sky: the sky alone; cubemap: sky and land as seen from right under the "
        "eye; planar: sky and boats",
    )
    specular: Literal["glint", "blinn_phong"] = Field(
        default="glint",
        description="The sun on the water. glint: facets with the slopes that the picture cannot show (Beckmann); "
        "blinn_phong: the lake shader's highlight, its half vector pushed aside by the ripples",
    )
    specular_power: float = Field(
        default=364.0, ge=1.0, le=2000.0, description="Exponent of blinn_phong; the greater, the smaller the highlight"
    )
    specular_perturb: float = Field(
        default=0.4, ge=0.0, le=10.0, description="How far blinn_phong's half vector follows the normal's tilt"
    )
    sparkles: Sparkles | None = Field(default=None, description="Sparks in the sun's reflection; absent: none")
    caustics: Caustics | None = Field(
        default=None, description="Sunlight focused by the ripples on the floor; absent: evenly lit"
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
    ] = Field(default=(0.0, 6.0, 0.0), description="Eye, m; y is counted from still water")
    yaw: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading, rad from −z toward +x",
        json_schema_extra={"unit": "rad"},
    )
    pitch: float = Field(
        default=-0.15,
        ge=-1.5708,
        le=1.5708,
        description="Elevation of the view, rad",
        json_schema_extra={"unit": "rad"},
    )
    roll: float = Field(
        default=0.0, ge=-3.1416, le=3.1416, description="Turn about the view, rad", json_schema_extra={"unit": "rad"}
    )
    fov: float = Field(
        default=0.8727, ge=0.01, le=2.6, description="Vertical field of view, rad", json_schema_extra={"unit": "rad"}
    )


class Scene(Part):
    """What the sea is."""

    waves: tuple[Wave, ...] = Field(default=(), max_length=16)
    rings: tuple[Ring, ...] = Field(default=(), max_length=RINGS_MOST, description="Rings of stones, drops and blasts")
    sea: Sea | None = Field(default=None, description="Open sea from a wind; absent: none")
    foam: Foam | None = Field(default=None, description="Absent: no foam")
    water: Water = Field(default_factory=Water)
    shore: Shore | None = Field(default=None, description="Sea floor, land and surf; absent: open sea")
    drift: Drift | None = Field(
        default=None, description="What carries the foam of a drift saturation; absent: nothing"
    )
    spray: Spray | None = Field(default=None, description="Drops that the water throws up; absent: none")
    boats: tuple[Boat, ...] = Field(default=(), max_length=BOATS_MOST, description="Boats on the water")
    light: Light | None = Field(default_factory=Light, description="null: unlit, foam white on black")
    camera: Camera = Field(default_factory=Camera)
