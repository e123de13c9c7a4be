"""Foam saturation from height (Kryachko 2005). docs/formulae.md, section 4."""

import math

import numpy as np

from seafoam.effects.bounds import height_limit
from seafoam.effects.effect import Bound, Const, Contribution, Effect, HardCase, SlotFile
from seafoam.effects.waves.parametric import steepest_profile
from seafoam.framegraph.rules import Constant, Uniform, array, number, significant, vector
from seafoam.ocean.dispersion import wavevector
from seafoam.ocean.levels import paper_level
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Foam,
    FrontSaturation,
    HeightSaturation,
    ParametricWave,
    Scene,
)

NODES = 17
"""Entries of the table of seen heights."""
_LENGTHS, _PLACES = 61, 384
"""Wavelengths of the highest wave over which that table is taken, and places in each."""


def seen_heights(scene: Scene) -> tuple[float, float, list[tuple[float, float]]]:
    """Mean height of the parametric waves over their troughs (m), their greatest slope, and what falling rays see.

    Entry i: mean and deviation (m) of the heights that rays see which fall by (i / (NODES - 1))^2 of the greatest
    slope, all waves running one way. A place is seen if it stands over every ray that came over the places before it:
    if h + slope x is greater there than anywhere before; what it takes of the picture is by how much.
    """
    waves = [(wave, math.hypot(*wavevector(wave, scene.water.depth))) for wave in scene.waves if wave.amplitude > 0.0]
    first = max(waves, key=lambda one: one[0].amplitude)[1]
    x = np.arange(_LENGTHS * _PLACES) * (2.0 * math.pi / (first * _PLACES))
    h = np.zeros_like(x)
    for wave, k in waves:
        h += wave.amplitude * np.power(0.5 + 0.5 * np.cos(k * x), wave.exponent)
    steepest = sum(k * wave.amplitude * steepest_profile(wave.exponent) for wave, k in waves)
    seen = [(float(h.mean()), float(h.std()))] * NODES
    for i in range(NODES - 1):
        over = h + steepest * (i / (NODES - 1)) ** 2 * x
        # From the highest crest on: before it stands what the line does not begin with.
        share = np.maximum(np.diff(np.maximum.accumulate(over)), 0.0)
        total = float(share.sum())
        if total > 1e-9 * float(h.max()):
            mean = float((share * h[1:]).sum()) / total
            seen[i] = (mean, math.sqrt(float((share * (h[1:] - mean) ** 2).sum()) / total))
        else:
            seen[i] = (float(h.max()), 0.0)
    return float(h.mean()), steepest, seen


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
    consts: dict[str, Const] = {}
    uniforms: dict[str, Uniform] = {}
    needs: tuple[str, ...] = ()
    # Shores bend waves, and an open sea has its heights until its largest waves are smaller than a pixel.
    if scene.foam.look == "filtered" and scene.sea is None and scene.shore is None:
        raised = [wave for wave in scene.waves if wave.amplitude > 0.0]
        if raised:
            name, needs = "height_seen", ("saturation/level.glsl",)
            mean, steepest, seen = seen_heights(scene)
            kx, kz = wavevector(max(raised, key=lambda wave: wave.amplitude), scene.water.depth)
            consts["HEIGHT_NODES"] = NODES
            uniforms["u_height_wave"] = vector((kx, kz, significant(mean), significant(1.0 / max(steepest, 1e-30))))
            pairs = [Constant(value=(significant(mean), significant(deviation))) for mean, deviation in seen]
            uniforms["u_height_seen"] = array("vec2", pairs, NODES)
    return Contribution(
        why=f"height saturation between {height.base:g} and {height.full:g} m",
        slots=(SlotFile("saturation", f"saturation/{name}.glsl", prefix="height", needs=needs),),
        consts=consts,
        uniforms={
            **uniforms,
            "u_height_level": number(significant(paper_level(scene))),
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
        HardCase(
            name="heights that the eye sees, from as high as the crests and along them",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=1.0, wavelength=9.0, exponent=3.0),
                    ParametricWave(amplitude=1e-12, wavelength=0.05, exponent=0.3),
                ),
                foam=Foam(saturation=(HeightSaturation(base=0.2, full=0.201),)),
            ),
            guard="lengths divided by at least 1e-6, the way along the waves at least 1e-3 of all, heights spread by "
            "at least a thousandth of the ramp (saturation/height_seen.glsl, saturation/level.glsl)",
            without="nothing on llvmpipe; right along the crests, right under the eye and where nothing is lost 0/0",
            times=(0.0, 1e9),
            camera=Camera(position=(0.0, 0.6875, 0.0), yaw=1.5707963, pitch=-0.05),
        ),
    ),
)
