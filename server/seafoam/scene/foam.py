"""Foam of a scene: where it comes from, how it looks and ages, and the flow that carries it."""

from typing import Annotated, ClassVar, Literal, TypeVar

from pydantic import Field, model_validator

from seafoam.scene.base import Angle, Downwind, Follows, InEffect, Part, Place, Share

MASKS_MOST = 2
"""Maximum number of masks of older foam in a scene."""
MASK_NAME = r"^[a-z]+(-[0-9.]+)?$|^[a-z]+:[0-9.]+:[0-9]+:[0-9]+(:[0-9.]+:[0-9.]+)?$"
"""Name in the catalogue, or the parameters of a custom mask."""
_Mask = Annotated[
    str, Field(max_length=40, pattern=MASK_NAME, json_schema_extra={"choices_from": "/api/masks"}, title="Mask")
]


class FoamLife(Part):
    """Transport and ageing of foam; applies to the filtered look only."""

    carried: bool = True
    """Waves carry the foam to and fro with the water and stretch it; false: it stays in place"""
    masks: tuple[_Mask, ...] = Field(default=("lacetorn", "streak"), max_length=MASKS_MOST)
    """Masks for ageing foam, the oldest last; each must be as large as the foam's own mask"""
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    wind_drift: Annotated[float | None, Follows("speed", alone=0.0, factor=0.02)] = Field(default=None, ge=0.0, le=2.0)
    """Drift speed of the surface with the wind, m/s; null: 2 % of the scene's wind"""
    drift_speed: ClassVar[InEffect] = InEffect("wind_drift")
    windrows: Annotated[float | None, Follows("speed", alone=0.0, factor=1.0 / 18.0, calm=4.0)] = Field(
        default=None, ge=0.0, le=1.0
    )
    """Strength with which foam gathers in windrows, rows along the wind (Langmuir 1938); 0: even; null: by the scene's
    wind, 0 up to 4 m/s and 1 from 22 m/s on"""
    row_strength: ClassVar[InEffect] = InEffect("windrows")
    windrow_spacing: float = Field(default=12.0, ge=0.5, le=500.0, description="Mean spacing of the windrows, m")


class FoamSource(Part):
    """Base class of sources of foam saturation."""


class FrontSaturation(FoamSource):
    """Foam that appears at the front of a crest and fades behind it: f = exp(−tan(θ/2 + δ))/C (Yingst et al. 2011).

    With several waves θ is the phase of their sum (its analytic signal), so one wave gives the paper's formula.
    """

    source: Literal["front"] = "front"
    constants: Literal["text", "listing"] = "text"
    """Constants of the formula. text: δ = π/2, 2π, e, from the paper's text; listing: δ = 1.07, 6.28, 2.718, from its
    code"""
    intensity: float = Field(default=4.0, ge=0.25, le=100.0)
    """C: divisor of the saturation; larger values give less foam; the paper uses 4"""
    group: tuple[Share, Annotated[float, Field(ge=0.0, le=2.0)]] = (0.0, 0.0)
    """Thresholds of the wave envelope, as fractions of the greatest possible sum of the waves: no foam below the first,
    full foam above the second, where variation exceeds 1 too; (0, 0): foam on every crest, as in the paper"""
    decay: float | None = Field(default=None, ge=0.2, le=30.0)
    """Decay time of the foam that a passing front leaves on the water, to 1/e, s; absent: foam fades over the wave
    behind the front, as in the paper"""
    variation: float = Field(default=0.0, ge=0.0, le=0.5)
    """Standard deviation by which the wave envelope counts for more or less in drifting patches; breaks up the regular
    pattern of few waves. Without decay or group it has no effect; 0: none"""
    variation_size: float = Field(default=30.0, ge=1.0, le=1000.0)
    """Size of the largest of these patches, m"""

    @model_validator(mode="after")
    def _ordered(self) -> "FrontSaturation":
        if self.group[1] < self.group[0]:
            raise ValueError("group: the second threshold must not be below the first")
        if self.decay is not None and self.constants != "text":
            raise ValueError("decay: requires constants 'text'")
        return self


class HeightSaturation(FoamSource):
    """Foam by wave height: f = (H − H0)/(Hmax − H0) (Kryachko 2005)."""

    source: Literal["height"] = "height"
    base: float = Field(default=0.3, ge=-100.0, le=100.0)
    """H0: height above the waves' troughs at which foam starts, m"""
    full: float = Field(default=0.9, ge=-100.0, le=200.0)
    """Hmax: height above these troughs at which the saturation is 1, m"""

    @model_validator(mode="after")
    def _ordered(self) -> "HeightSaturation":
        if self.full - self.base < 1e-3:
            raise ValueError("full: must be at least 0.001 m above base")
        return self


class SlopeSaturation(FoamSource):
    """Foam on steep water: f = gain (1 − n.y − base), n the normal of the waves (GPU ocean, 2007: base 0)."""

    source: Literal["slope"] = "slope"
    gain: float = Field(default=6.0, ge=0.1, le=1000.0)
    """Saturation per unit of 1 − n.y − base; larger values give more foam"""
    base: float = Field(default=0.0, ge=0.0, le=0.9)
    """Value of 1 − n.y at which foam starts: 0.03 at a tilt of 14°, 0.13 at 30°"""
    blur: float = Field(default=0.0, ge=0.0, le=20.0)
    """Distance of the four neighbours with which 1 − n.y is averaged, m; 0: no blur"""


class WhitecapSaturation(FoamSource):
    """Foam where the sea folds, i.e. the Jacobian of its horizontal displacement is small, and for seconds after."""

    source: Literal["whitecap"] = "whitecap"
    coverage: float = Field(default=1.0, ge=0.0, le=10.0)
    """Mean foam coverage, relative to the whitecap coverage for this wind (Monahan and O'Muircheartaigh 1980)"""
    softness: float = Field(default=1.2, ge=0.01, le=3.0)
    """Width of the ramp from no foam to full foam, in standard deviations of the Jacobian"""
    decay: float = Field(default=3.0, ge=0.05, le=60.0, description="Decay time of the foam, to 1/e, s")
    lasting: bool = False
    """Keep foam of the longer waves for 11 s instead of 3 s, which leaves trails behind breakers; the mean coverage
    stays the same"""


class SurfSaturation(FoamSource):
    """Foam of the surf: it appears at breaking fronts, remains behind them, and drains down the beach."""

    source: Literal["surf"] = "surf"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation at a breaking front")
    life: float = Field(default=0.35, ge=0.02, le=5.0)
    """Decay time behind the front, to 1/e, in wave periods"""
    veil: Share = Field(default=0.1, description="Saturation that remains in the surf zone between waves")
    line: float = Field(default=0.0, ge=0.0, le=4.0)
    """Saturation that the swash leaves on the sand, strongest along the line of maximum run-up"""


class DriftSaturation(FoamSource):
    """Patches of foam that appear on the scene's ``drift`` square, are carried by its flow, and disappear."""

    source: Literal["drift"] = "drift"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of a patch halfway through its life")
    patch: float = Field(default=2.5, ge=0.05, le=500.0, description="Size of a patch when it appears, m")
    coverage: float = Field(default=0.3, ge=0.01, le=0.95)
    """Fraction of the water covered by the patches of one generation"""
    life: float = Field(default=24.0, ge=1.0, le=120.0, description="Lifetime of a patch, s")
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the patches")


class WakeSaturation(FoamSource):
    """Foam of boats: the turbulent band behind each boat, and the foam of its bow wave."""

    source: Literal["wake"] = "wake"
    amount: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation directly behind the boat")
    life: float = Field(default=8.0, ge=0.1, le=60.0, description="Decay time behind the boat, to 1/e, s")
    bow: float = Field(default=1.0, ge=0.0, le=4.0, description="Saturation of the bow wave at hull speed")
    contact: float = Field(default=0.0, ge=0.0, le=4.0)
    """Saturation of the white water along the waterline of a moving hull, at the bow at hull speed; 0: none"""


class BreakerSaturation(FoamSource):
    """Foam that plunging crests leave on the water over which they have run."""

    source: Literal["breaker"] = "breaker"
    amount: float = Field(default=0.8, ge=0.0, le=4.0, description="Saturation directly behind what the jet throws up")
    life: float = Field(default=8.0, ge=0.1, le=60.0, description="Decay time behind it, to 1/e, s")


Saturation = Annotated[
    FrontSaturation
    | HeightSaturation
    | SlopeSaturation
    | WhitecapSaturation
    | SurfSaturation
    | DriftSaturation
    | WakeSaturation
    | BreakerSaturation,
    Field(discriminator="source"),
]
S = TypeVar("S", bound=FoamSource)


class FoamScattering(Part):
    """Foam as a lumpy layer of bubbles that transmits and forward-scatters light; docs/formulae.md, section 6."""

    optical_depth: float = Field(default=12.0, ge=0.5, le=1000.0)
    """Optical depth of foam of saturation 1, without what it scatters forward; foam of less saturation is thinner, and
    the water is visible through it"""
    roughness: float = Field(default=0.7, ge=0.0, le=2.0)
    """Root mean square slope of the foam's lumps; larger values catch more light of a low sun"""
    forward: Share = 0.6
    """Fraction of the sunlight that the foam scatters once, mostly forward; foam between the camera and the sun
    glows"""


Look = Literal["textured", "halftone", "fading", "halftone_textured", "listing", "filtered"]


class Foam(Part):
    """Foam: a saturation, thresholded by a halftone mask."""

    saturation: tuple[Saturation, ...] = Field(default=(FrontSaturation(),), min_length=1, max_length=4)
    combine: Literal["max", "product"] = "max"
    """How the saturations of several sources are combined: maximum or product"""
    look: Look = "filtered"
    """How saturation becomes foam. textured: a texture faded by f (figure 7a); halftone: eq. 1; fading: eq. 2;
    halftone_textured: eq. 3; listing: the paper's published code; filtered: antialiased threshold with exact area
    coverage"""
    mask: str = Field(
        default="vac-24", max_length=40, pattern=MASK_NAME, json_schema_extra={"choices_from": "/api/masks"}
    )
    """Name of a mask in the catalogue, or family:sigma:size:seed, for lace also :aspect:age"""
    mask_tile: float = Field(default=12.0, ge=0.05, le=1000.0)
    """Side of one tile of the mask, m; smaller gives finer bubbles"""
    mask_angle: Angle = Field(default=0.0, description="Rotation of the mask about +y, rad")
    cells: bool = False
    """Rotate and shift the mask at random in hexagonal cells of one tile's size, so that it does not visibly repeat;
    has no effect with `life`"""
    texture_tile: float = Field(default=3.0, ge=0.05, le=1000.0, description="Side of one tile of the foam texture, m")
    texture_second: float | None = Field(default=None, ge=0.05, le=1000.0)
    """Side of one tile of a second copy of the foam texture, with u and v swapped, m. The mean of both does not repeat
    if the two sides are incommensurable (2.7 and 3.14); absent: one copy"""
    texture: Share = Field(default=0.0, description="Weight of the foam texture in the filtered look; 0: none")
    fade: Share = 0.0
    """Width of the threshold ramp of the filtered look: bubbles fade over it before they disappear; 0: a hard
    threshold"""
    octaves: int = Field(default=1, ge=1, le=4)
    """Number of octaves of the mask in the filtered look, each rotated and five times finer than the last; more keep
    detail near the camera"""
    life: FoamLife | None = None
    """How foam of the filtered look moves and ages: carried by waves, gathered by wind, worn by age; absent: it does
    none of these"""
    thickness: Share = 0.0
    """Height of foam above the water, m; brightens edges that face the sun and shades the water beside them; 0: flat"""
    scattering: FoamScattering | None = None
    """Foam as a layer of bubbles that transmits and forward-scatters light; absent: opaque and matt, as in the
    papers"""
    albedo: Share = Field(default=0.9, description="Albedo of foam: fraction of light that it scatters back")

    @model_validator(mode="after")
    def _one_of_each(self) -> "Foam":
        sources = [saturation.source for saturation in self.saturation]
        if len(set(sources)) < len(sources):
            raise ValueError("saturation: at most one entry per source")
        if self.life is not None and "drift" in sources:
            raise ValueError("life: cannot be combined with a drift saturation, whose flow already carries the foam")
        return self

    def source(self, kind: type[S]) -> S | None:
        """Return the saturation of a kind; None where there is none."""
        return next((source for source in self.saturation if isinstance(source, kind)), None)

    def pointer(self, source: FoamSource) -> str:
        """Return the JSON pointer of one of the saturations in a scene. Raises ``ValueError`` for any other."""
        return f"/foam/saturation/{self.saturation.index(source)}"


VORTICES_MOST = 12
"""Maximum number of vortices in a scene."""
_Speed = Annotated[float, Field(ge=-20.0, le=20.0)]


class Vortex(Part):
    """A stationary vortex: fastest at its radius, at rest at its centre and beyond six radii."""

    place: tuple[Place, Place] = Field(default=(0.0, -30.0), description="Centre (x, z), m")
    radius: float = Field(default=2.0, ge=0.05, le=500.0)
    """Distance from the centre at which the flow is fastest, m"""
    speed: float = Field(default=1.0, ge=-20.0, le=20.0)
    """Maximum speed, m/s; positive turns from +x toward +z, negative the other way"""


class Drift(Part):
    """A steady flow over a square, which carries the foam of a ``drift`` saturation."""

    place: tuple[Place, Place] = Field(default=(0.0, -30.0), description="Centre of the square (x, z), m")
    size: float = Field(default=60.0, ge=1.0, le=5000.0)
    """Side of the square, m; drifting foam exists only inside it"""
    current: tuple[_Speed, _Speed] = Field(default=(0.3, 0.0), description="Velocity of the current (x, z), m/s")
    waves: float = Field(default=1.0, ge=0.0, le=4.0)
    """Factor on the Stokes drift of the waves; 0: waves do not carry foam (Stokes 1847)"""
    vortices: tuple[Vortex, ...] = Field(default=(), max_length=VORTICES_MOST, description="Stationary vortices")
