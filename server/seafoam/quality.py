"""Quality: how exactly a scene is computed, apart from what it is."""

from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

Tier = Literal["draft", "standard", "high", "reference"]


def _no_truth_value(value: Any) -> Any:
    """``False`` equals 0 and would pass for it, which the schema does not say."""
    if isinstance(value, bool):
        raise ValueError("must be a number")
    return value


class Knobs(BaseModel):
    """Base of every group of knobs."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class SurfaceQuality(Knobs):
    """How the eye's ray finds the surface."""

    method: Literal["mesh", "march"] = Field(
        default="march",
        description="march: steps along the ray that cannot pass the surface; mesh: a grid and Newton steps",
    )
    steps: int = Field(default=192, ge=8, le=1024, description="Greatest number of steps of a march")
    tolerance: float = Field(
        default=0.05,
        ge=1e-4,
        le=1.0,
        description="A march ends this near the surface, in heights of a sample",
    )
    cells: int = Field(default=192, ge=8, le=1024, description="Cells of the mesh along each side")
    refine: int = Field(default=0, ge=0, le=8, description="Newton steps a pixel after the mesh or the march")
    filter: bool = Field(default=True, description="Turn waves smaller than a pixel into roughness")


class Quality(Knobs):
    """Everything that trades time against error."""

    surface: SurfaceQuality = SurfaceQuality()
    waves: int = Field(default=16, ge=1, le=16, description="Waves kept, the steepest first")
    mask: Literal["u8", "half", "u16"] = Field(
        default="u16", description="Format of the mask's thresholds, where a look reads single texels"
    )
    foam_taps: Literal[4, 16] = Field(
        default=16,
        description="Texels of the mask that the filtered look averages where it is minified: 2 by 2 or 4 by 4",
    )
    foam_octaves: Annotated[Literal[1, 2, 3, 4], BeforeValidator(_no_truth_value)] = Field(
        default=4, description="Octaves of the mask at most: how fine foam is near the eye"
    )
    foam_relief: bool = Field(default=False, description="Foam of a thickness shades what lies beside it")
    chop: Literal["tile", "exact"] = Field(
        default="tile", description="Ripples from a tile drawn each frame, or summed per pixel"
    )
    chop_size: int = Field(default=256, ge=32, le=1024, description="Texels along a side of the ripple tile")
    rings: Literal["map", "exact"] = Field(
        default="map", description="Rings from a map drawn each frame, or summed per pixel"
    )
    rings_size: int = Field(default=1024, ge=32, le=2048, description="Texels along a side of the map of rings")
    sea_size: Literal[64, 128, 256, 512] = Field(default=256, description="Texels along a side of a tile of open sea")
    sea_tiles: Literal[2, 3, 4] = Field(default=4, description="Tiles of an FFT sea, the largest first")
    sea_digits: Literal["half", "float"] = Field(default="half", description="Floats of the tiles of open sea")
    age_steps: Annotated[Literal[0, 4, 8], BeforeValidator(_no_truth_value)] = Field(
        default=8, description="Earlier times at which the sea's folds are looked for"
    )
    age_step: float = Field(default=0.35, ge=0.02, le=5.0, description="Seconds between them")
    shore_map: Literal[64, 128, 256, 512] = Field(
        default=256, description="Texels along a side of the map of distances to the shore"
    )
    shore_floor: Literal[64, 128, 256, 512] = Field(
        default=256, description="Texels along a side of the height field of floor and land"
    )
    shore_profile: Literal[32, 64, 128, 256] = Field(
        default=128, description="Nodes of a row of the table of shore-wave profiles"
    )
    cloud_octaves: int = Field(default=6, ge=1, le=8, description="Octaves of the clouds' noise")
    cube: Literal["map", "exact"] = Field(
        default="map", description="What stands around the water, from a cube map or found for each sample"
    )
    cube_size: Literal[32, 64, 128, 256, 512, 1024] = Field(
        default=256, description="Texels along a side of a face of the cube map"
    )
    refraction_steps: Literal[1, 2, 4, 8, 16] = Field(
        default=2, description="Steps after which the refracted ray is taken to meet a shore's floor"
    )
    drift: Literal["backward", "forward", "exact"] = Field(
        default="backward",
        description="Drifting foam from a map that each texel finds by going back along the flow, from a map that "
        "points are moved over (gaps, piles and sticking: for comparison), or gone back for at each sample",
    )
    drift_size: Literal[64, 128, 256, 512, 1024] = Field(
        default=256, description="Texels along a side of the maps of drift"
    )
    drift_window: float = Field(
        default=120.0, ge=1.0, le=120.0, description="How far back foam is followed, s; older foam is not drawn"
    )
    drift_step: float = Field(default=1.0, ge=0.05, le=10.0, description="Longest step along the flow, s")
    sparkle_cells: Annotated[Literal[1, 4], BeforeValidator(_no_truth_value)] = Field(
        default=4, description="Cells that a sample asks for sparkles: its own, or all that may reach it"
    )
    spray_count: Literal[2048, 4096, 8192, 16384] = Field(
        default=8192, description="Drops of the spray; fewer are larger, and cover as much"
    )
    caustics: Literal["grid", "photons"] = Field(
        default="grid",
        description="Caustics from a refracted grid's cells (photons where deep water spreads them far), or from "
        "photons counted where they land",
    )
    caustics_size: Literal[128, 256, 512, 1024] = Field(
        default=512, description="Texels along a side of the caustic map"
    )
    caustics_cells: Literal[64, 128, 256, 512] = Field(
        default=256, description="Cells along a side of the refracted grid"
    )
    caustics_photons: Literal[128, 256, 512, 1024] = Field(default=512, description="Photons along a side of the tile")
    wake: Literal["map", "exact"] = Field(
        default="map", description="Wakes from a map drawn each frame, or worked out per pixel"
    )
    wake_size: Literal[128, 256, 512, 1024] = Field(default=512, description="Texels along a map of a wake")
    reflection: Literal["map", "traced"] = Field(
        default="map", description="Boats mirrored from a planar mirror drawn each frame, or by rays from the water"
    )
    reflection_size: int = Field(default=256, ge=32, le=2048, description="Texels along a side of the planar mirror")
    slope_places: Annotated[Literal[1, 5], BeforeValidator(_no_truth_value)] = Field(
        default=1,
        description="Places whose slopes make blurred slope foam: five, or one whose footprint is as wide as the blur",
    )
    boat_readings: Annotated[Literal[1, 7], BeforeValidator(_no_truth_value)] = Field(
        default=7, description="Heights read round each hull point of a boat"
    )
    boat_samples: Annotated[Literal[1, 4, 9], BeforeValidator(_no_truth_value)] = Field(
        default=4, description="Rays through each sample where boats are: their edges against water and sky"
    )
    samples: Literal[1, 4, 9, 16, 25, 36, 49, 64] = Field(default=1, description="Samples a pixel, on a square grid")
    samples_max: Annotated[Literal[1, 4, 16], BeforeValidator(_no_truth_value)] = Field(
        default=1,
        description="Greatest number of samples that a pixel is given where it stands out from those round it; no more "
        "than `samples`: every pixel has as many",
    )
    samples_budget: float = Field(
        default=2.0,
        ge=0.1,
        le=3.0,
        description="Further samples that these take at most, in the mean of the pixels under the horizon",
    )
    samples_threshold: float = Field(
        default=0.004,
        ge=0.001,
        le=1.0,
        description="Contrast from which on a pixel is given more samples, white on black = 1; more contrast where the "
        "budget would not do",
    )
    target: Literal["RGBA16F", "RGBA32F"] = Field(default="RGBA16F", description="Float format of the linear frame")

    @property
    def chosen_samples(self) -> tuple[int, ...]:
        """Numbers of samples that single pixels may be given beyond ``samples``."""
        return tuple(count for count in (4, 16) if self.samples < count <= self.samples_max)

    @property
    def samples_drawn(self) -> int:
        """What is drawn into at most, samples a pixel in the mean."""
        return self.samples + (4 if self.chosen_samples else 0)


TIERS: dict[Tier, Quality] = {
    "draft": Quality(
        surface=SurfaceQuality(tolerance=0.2),
        foam_taps=4,
        chop_size=128,
        sea_size=128,
        sea_tiles=3,
        age_steps=4,
        age_step=0.7,
        shore_map=128,
        cloud_octaves=5,
        cube_size=128,
        drift_size=128,
        sparkle_cells=1,
        spray_count=4096,
        caustics_size=256,
        caustics_cells=128,
        wake_size=256,
        reflection_size=128,
        boat_samples=1,
    ),
    "standard": Quality(),
    "high": Quality(
        surface=SurfaceQuality(steps=384, tolerance=0.02),
        foam_relief=True,
        rings_size=2048,
        sea_size=512,
        cube_size=512,
        refraction_steps=8,
        drift_size=512,
        drift_step=0.25,
        spray_count=16384,
        caustics_cells=512,
        wake_size=1024,
        reflection_size=512,
        samples=4,
        samples_max=16,
    ),
    "reference": Quality(
        surface=SurfaceQuality(steps=512, tolerance=0.02),
        foam_relief=True,
        rings_size=2048,
        sea_size=512,
        sea_digits="float",
        shore_floor=512,
        shore_profile=256,
        cube="exact",
        slope_places=5,
        refraction_steps=16,
        drift_size=512,
        drift_step=0.25,
        spray_count=16384,
        caustics="photons",
        caustics_photons=1024,
        wake_size=1024,
        reflection_size=512,
        samples=25,
        target="RGBA32F",
    ),
}

assert set(TIERS) == set(get_args(Tier))
