"""Milky water: bubbles under young foam scatter light back. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import body_limit, greatest_saturation, saturation_fields
from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.framegraph.rules import number
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Foam, FrontSaturation, HeightSaturation, ParametricWave, Scene, Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.aeration`` where there is foam and light."""
    water, foam = scene.water, scene.foam
    if foam is None or scene.light is None or water.aeration == 0.0:
        return None
    most = min(greatest_saturation(foam, scene), 1.0)
    # Twice the layer and more is what light crosses, and at most three times: the refracted ray is never flatter.
    whitened = 1.0 - math.exp(-3.0 * water.aeration * water.plume_depth * most)
    bound = Bound(
        whitened * body_limit(scene),
        "next to no bubbles, no foam over them, or no light on them",
        ("/light/exposure", "/water/aeration", "/water/plume_depth", *saturation_fields(foam)),
    )
    return Contribution(
        why=f"bubbles down to {water.plume_depth:g} m under foam",
        slots=(SlotFile("plume", "plume/bubbles.glsl", needs=("shade/optics.glsl", "shade/fresnel.glsl")),),
        uniforms={
            "u_aeration": number(water.aeration, "/water/aeration"),
            "u_plume_depth": number(water.plume_depth, "/water/plume_depth"),
        },
        # Caustics make a floor brighter than any even light.
        bound=None if scene.light.caustics is not None else bound,
    )


_FOAM = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),))

EFFECT = Effect(
    "milky water",
    contribute,
    invisible=(
        Scene(waves=(ParametricWave(amplitude=0.5),), foam=Foam(), water=Water(aeration=1e-6)),
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product"),
            water=Water(aeration=1.0),
        ),
    ),
    hard_cases=(
        HardCase(
            name="milk in water as dark and as clear as it gets",
            scene=Scene(
                foam=_FOAM,
                water=Water(
                    aeration=10.0, plume_depth=20.0, scattering=0.0, absorption_length=(0.01, 1000.0, 0.01), depth=0.05
                ),
            ),
            guard="what comes back is at least none (plume/bubbles.glsl)",
            without="nothing on llvmpipe: what clear water sends back from the layer is never more than all of it",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
    ),
)
