"""Foam saturation from height (Kryachko 2005). docs/formulae.md, section 4."""

from seafoam.effects.contribution import (
    Bound,
    Contribution,
    Effect,
    HardCase,
    SlotFile,
    number,
)
from seafoam.effects.extremes import height_limit
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Foam,
    FrontSaturation,
    HeightSaturation,
    ParametricWave,
    Scene,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``height``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, HeightSaturation)]
    if not found:
        return None
    index, height = found[0]
    pointer = f"/foam/saturation/{index}"
    name = "height_filtered" if scene.foam.look == "filtered" else "height"
    return Contribution(
        why=f"height saturation between {height.base:g} and {height.full:g} m",
        slots=(SlotFile("saturation", f"saturation/{name}.glsl", prefix="height"),),
        uniforms={
            "u_height_base": number(height.base, f"{pointer}/base"),
            "u_height_full": number(height.full, f"{pointer}/full"),
        },
        bound=Bound(0.0, "no crest reaches the height where foam starts", (f"{pointer}/base", f"{pointer}/full"))
        if height_limit(height, scene) == 0.0
        else None,
    )


EFFECT = Effect(
    "height foam",
    contribute,
    invisible=(
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.5, full=1.0)), look="halftone"),
        ),
    ),
    hard_cases=(
        HardCase(
            name="foam over a millimetre, a hundred metres up",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=50.0, wavelength=400.0),
                    ParametricWave(amplitude=50.0, wavelength=400.0),
                    ParametricWave(amplitude=1.0, wavelength=300.0),
                ),
                foam=Foam(saturation=(HeightSaturation(base=100.0, full=100.001),), look="halftone"),
            ),
            guard="the divisor at least 1e-3 m (saturation/height.glsl)",
            without="0/0 at H0 once a live edit puts full on base; llvmpipe's clamp makes it 0",
            camera=Camera(position=(0.0, 140.0, 0.0), pitch=-0.4),
        ),
        HardCase(
            name="foam from far below to far above",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0),),
                foam=Foam(saturation=(HeightSaturation(base=-100.0, full=200.0),), look="fading"),
            ),
            guard="f held in [0, 4] (saturation/height.glsl)",
            without="nothing: f is 1/3; the fading look clamps what follows",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="saturation a thousandfold over the cap",
            scene=Scene(foam=Foam(saturation=(HeightSaturation(base=-100.0, full=-99.999),), look="listing")),
            guard="f held in [0, 4] (saturation/height.glsl)",
            without="nothing in the frame: the listing clamps f - m at 3; f itself is 100 000",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
    ),
)
