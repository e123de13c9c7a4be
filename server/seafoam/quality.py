"""Quality: how exactly a scene is computed."""

from typing import Annotated, Any, Literal, get_args

from pydantic import BeforeValidator, ConfigDict, Field

from seafoam.described import Described
from seafoam.extensions import Extensible, Extensions

Tier = Literal["fast", "standard", "high", "reference"]


def _no_truth_value(value: Any) -> Any:
    """Reject ``False``, which equals 0 and would otherwise pass, against the schema."""
    if isinstance(value, bool):
        raise ValueError("must be a number")
    return value


class QualityParameters(Described):
    """Base class of groups of quality settings."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class SurfaceQuality(QualityParameters):
    """Settings of the intersection of view rays with the surface."""

    method: Literal["mesh", "march"] = "march"
    """How the view ray is intersected with the surface. march: conservative ray marching, which cannot step over a
    crest; mesh: a polar grid, then Newton steps"""
    steps: int = Field(default=96, ge=8, le=1024, description="Maximum number of ray-marching steps")
    tolerance: float = Field(default=0.1, ge=1e-4, le=1.0)
    """Distance from the surface at which ray marching stops, as a fraction of the height of one sample's footprint;
    smaller is more exact and slower"""
    cells: int = Field(default=192, ge=8, le=1024, description="Cells along each side of the mesh")
    refine: int = Field(default=0, ge=0, le=8, description="Newton steps per sample after the mesh or the ray march")
    filter: bool = True
    """Convert waves smaller than the sampling footprint into roughness; false: they alias"""


class QualityExtensions(Extensions):
    """Settings of effects outside the package, by name; absent: their defaults, in every tier."""


class Quality(Extensible, QualityParameters):
    """Settings that trade time against error."""

    surface: SurfaceQuality = SurfaceQuality()
    waves: int = Field(default=16, ge=1, le=16, description="Maximum number of parametric waves, the steepest first")
    mask: Literal["u8", "half", "u16"] = "u16"
    """Storage format of the mask's thresholds, for looks that read single texels"""
    foam_taps: Literal[4, 16] = 16
    """Mask texels that the filtered look averages under minification: 4 (2 × 2) or 16 (4 × 4); fewer is faster and
    noisier"""
    foam_octaves: Annotated[Literal[1, 2, 3, 4], BeforeValidator(_no_truth_value)] = 4
    """Maximum number of octaves of the foam mask; more show finer foam near the camera"""
    foam_texture: Literal["sampler", "texels"] = "sampler"
    """How the foam texture is filtered. sampler: by the GL, from 8 bits, with weights of some 8 bits; texels: in
    float32"""
    foam_relief: bool = False
    """Shade the water and the foam edges around foam that has a thickness"""
    ripples: Literal["tile", "exact"] = "tile"
    """Wind ripples. tile: read from a tile that is drawn each frame; exact: summed for each sample"""
    ripples_size: int = Field(default=256, ge=32, le=1024, description="Side of the ripple tile, texels")
    rings: Literal["map", "exact"] = "map"
    """Rings. map: read from a displacement map that is drawn each frame; exact: summed for each sample"""
    rings_size: int = Field(default=512, ge=32, le=2048, description="Side of the rings' displacement map, texels")
    sea_size: Literal[64, 128, 256, 512] = Field(default=512, description="Side of each tile of the open sea, texels")
    sea_tiles: Literal[2, 3, 4] = 4
    """Number of tiles of an FFT sea, the largest first; fewer leave out the shortest waves"""
    sea_digits: Literal["half", "float"] = "half"
    """Floating-point format of the tiles of the open sea: 16-bit (half) or 32-bit (float)"""
    age_steps: Annotated[Literal[0, 4, 8], BeforeValidator(_no_truth_value)] = 8
    """Number of earlier times at which the folds of the sea are evaluated, for foam left by past breakers"""
    age_step: float = Field(default=0.35, ge=0.02, le=5.0, description="Interval between these times, s")
    shore_map: Literal[64, 128, 256, 512] = 256
    """Side of the map of distances to the shore, texels"""
    shore_floor: Literal[64, 128, 256, 512] = 256
    """Side of the height field of sea floor and land, texels"""
    shore_profile: Literal[32, 64, 128, 256] = 128
    """Nodes per row of the table of shore wave profiles"""
    land_octaves: int = Field(default=7, ge=1, le=7)
    """Octaves of the land's detail, the largest first; more show finer detail"""
    shadow_steps: Literal[32, 64, 128, 256] = 128
    """Steps toward the sun in which the land's shadows are found"""
    cloud_octaves: int = Field(default=6, ge=1, le=8, description="Octaves of the cloud noise; more show finer clouds")
    cloud_shadow_octaves: Literal[1, 2, 3, 4] = 4
    """Octaves of the cloud noise in the clouds' shadows; more show finer shadows"""
    clouds_mirrored: Literal["map", "exact"] = "map"
    """Clouds that the water mirrors. map: read from a small map that is drawn each frame, where a wind sea or ripples
    blur what is mirrored; exact: evaluated for each sample"""
    cube: Literal["map", "exact"] = "map"
    """Reflected surroundings. map: read from a cube map; exact: traced for each sample"""
    cube_size: Literal[32, 64, 128, 256, 512, 1024] = 128
    """Side of each face of the cube map, texels"""
    refraction_steps: Literal[1, 2, 4, 8, 16] = 2
    """Iterations of the intersection of the refracted ray with a shore's floor"""
    drift: Literal["backward", "forward", "exact"] = "backward"
    """Advection of drifting foam. backward: a map whose texels trace the flow back in time; forward: a map in which
    cells of foam are moved along the flow (leaves gaps and piles, for comparison); exact: traced back for each
    sample"""
    drift_size: Literal[64, 128, 256, 512, 1024] = Field(default=256, description="Side of the drift maps, texels")
    drift_window: float = Field(default=120.0, ge=1.0, le=120.0)
    """Maximum age of drifting foam, s; older foam is not drawn"""
    drift_step: float = Field(default=1.0, ge=0.05, le=10.0)
    """Maximum time step of the integration along the flow, s"""
    sparkle_cells: Annotated[Literal[1, 4], BeforeValidator(_no_truth_value)] = 4
    """Sparkle cells evaluated per sample: 1 (its own) or 4 (all that can reach it)"""
    spray_count: Literal[2048, 4096, 8192, 16384] = 16384
    """Number of spray drops, over an open sea half as many where pixels are wide; fewer drops are drawn larger, so that
    they cover the same area"""
    caustics: Literal["grid", "photons"] = "grid"
    """Caustics. grid: area ratios of a refracted grid (photons where deep water spreads the light far); photons:
    photons counted where they land"""
    caustics_size: Literal[128, 256, 512, 1024] = Field(default=512, description="Side of the caustic map, texels")
    caustics_cells: Literal[64, 128, 256, 512] = 256
    """Cells along each side of the refracted grid"""
    caustics_photons: Literal[128, 256, 512, 1024] = 512
    """Photons along each side of the caustic tile"""
    wake: Literal["map", "exact"] = "map"
    """Wakes. map: read from a displacement map; exact: evaluated for each sample"""
    wake_size: Literal[128, 256, 512, 1024] = Field(default=512, description="Side of each wake map, texels")
    reflection: Literal["map", "traced"] = "map"
    """Reflection of boats. map: from a planar mirror that is drawn each frame; traced: by rays from the water"""
    reflection_size: int = Field(default=256, ge=32, le=2048)
    """Side of the planar mirror, texels; of land alone in water with ripples at most 128"""
    slope_places: Annotated[Literal[1, 5], BeforeValidator(_no_truth_value)] = 1
    """Points at which the slope for blurred slope foam is read: 5, or 1 with a footprint as wide as the blur"""
    boat_readings: Annotated[Literal[1, 7], BeforeValidator(_no_truth_value)] = 7
    """Wave heights read around each hull point of a boat"""
    boat_samples: Annotated[Literal[1, 4, 9], BeforeValidator(_no_truth_value)] = 4
    """Rays per sample where boats and stones are, to antialias their edges against water and sky"""
    boat_shadows: bool = Field(default=True, description="Shadows of boats on water, foam and a floor")
    samples: Literal[1, 4, 9, 16, 25, 36, 49, 64] = 1
    """Samples per pixel, on a square grid; without light, where they cost little, 49 instead of 25"""
    samples_max: Annotated[Literal[1, 4, 16], BeforeValidator(_no_truth_value)] = 1
    """Maximum number of samples for a pixel that stands out from its neighbours (adaptive sampling); a value not above
    `samples` turns it off"""
    samples_budget: float = Field(default=2.0, ge=0.1, le=3.0)
    """Maximum number of additional adaptive samples per pixel, averaged over the pixels below the horizon"""
    samples_threshold: float = Field(default=0.004, ge=0.001, le=1.0)
    """Contrast with its neighbours above which a pixel gets more samples; white on black is 1. Raised automatically
    where the budget would be exceeded"""
    pixel_width: Annotated[Literal[1, 2, 3, 4], BeforeValidator(_no_truth_value)] = 2
    """Width of a drawn pixel, in pixels of the picture. 2 to 4: water, land and sky are drawn at full height and a part
    of the width, along which water that is seen from near its level has the least detail, and then enlarged. Half of
    it, rounded up, with drifting foam, on calm water and where the camera looks down by more than 0.5 rad; at most 3
    with boats, mirrored land or surf on rocks; at least 3 without sun or moon; 1 with more than one sample per pixel"""
    target: Literal["RGBA16F", "RGBA32F"] = "RGBA16F"
    """Floating-point format of the linear frame"""

    extensions: QualityExtensions = Field(default=QualityExtensions(), exclude_if=lambda given: not dict(given))
    """Settings of effects outside the package, by name; absent: their defaults"""

    @property
    def chosen_samples(self) -> tuple[int, ...]:
        """Sample counts above ``samples`` that adaptive sampling can give to single pixels."""
        return tuple(count for count in (4, 16) if self.samples < count <= self.samples_max)

    @property
    def samples_drawn(self) -> int:
        """Upper bound of the samples drawn, per pixel in the mean."""
        return self.samples + (4 if self.chosen_samples else 0)


_FINEST: dict[str, Any] = {
    "foam_relief": True,
    "sea_digits": "float",
    "shore_floor": 512,
    "shore_profile": 256,
    "shadow_steps": 256,
    "clouds_mirrored": "exact",
    "cube": "exact",
    "slope_places": 5,
    "refraction_steps": 16,
    "caustics": "photons",
    "caustics_photons": 1024,
    "pixel_width": 1,
    "target": "RGBA32F",
}
"""What the tier ``reference`` and :data:`EXACT` have in common."""

TIERS: dict[Tier, Quality] = {
    "fast": Quality(
        surface=SurfaceQuality(tolerance=0.2),
        ripples_size=128,
        sea_size=256,
        age_steps=4,
        age_step=0.7,
        sparkle_cells=1,
        caustics_size=256,
        caustics_cells=128,
        wake_size=256,
        reflection_size=128,
        boat_samples=1,
        pixel_width=4,
    ),
    "standard": Quality(),
    "high": Quality(
        surface=SurfaceQuality(steps=384, tolerance=0.02),
        foam_relief=True,
        rings_size=2048,
        clouds_mirrored="exact",
        cube_size=512,
        refraction_steps=8,
        drift_size=512,
        drift_step=0.25,
        caustics_cells=512,
        wake_size=1024,
        reflection_size=512,
        samples=4,
        samples_max=16,
        pixel_width=1,
    ),
    "reference": Quality(
        **_FINEST,
        surface=SurfaceQuality(steps=512, tolerance=0.02),
        rings_size=2048,
        drift_size=512,
        drift_step=0.25,
        wake_size=1024,
        reflection_size=512,
        samples=25,
    ),
}

assert set(TIERS) == set(get_args(Tier))

EXACT = Quality(
    **_FINEST,
    surface=SurfaceQuality(steps=512, tolerance=2e-4, refine=4, filter=False),
    foam_texture="texels",
    ripples="exact",
    rings="exact",
    cube_size=512,
    drift="exact",
    drift_step=0.2,
    wake="exact",
    reflection="traced",
    boat_samples=1,
)
"""The formulas alone: nothing from maps, no footprints, one sample a pixel, float32 throughout. It aliases, and agrees
with :func:`seafoam.reference.render` of the same samples; for formulas to be checked, not for pictures."""
