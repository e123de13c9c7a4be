"""The quality at which samples are held to the truth: nothing from maps, no footprints, float32 throughout."""

from seafoam.quality import Quality, SurfaceQuality

UNFILTERED = Quality(
    surface=SurfaceQuality(steps=512, tolerance=2e-4, refine=4, filter=False),
    foam_relief=True,
    ripples="exact",
    rings="exact",
    sea_size=512,
    sea_digits="float",
    shore_floor=512,
    shore_profile=256,
    shadow_steps=256,
    cloud_shadow_octaves=4,
    cube="exact",
    cube_size=512,
    slope_places=5,
    refraction_steps=16,
    drift="exact",
    drift_step=0.2,
    spray_count=16384,
    caustics="photons",
    caustics_photons=1024,
    wake="exact",
    reflection="traced",
    boat_samples=1,
    samples=16,
    target="RGBA32F",
)

EXACT = UNFILTERED.model_copy(update={"samples": 1})
"""The same with one sample a pixel."""
