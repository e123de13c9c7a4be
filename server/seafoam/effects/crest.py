"""Sunlight through thin crests. docs/formulae.md, section 6."""

from seafoam.effects.contribution import Bound, Contribution, Effect, SlotFile, number
from seafoam.effects.extremes import crest_limit, surface_top
from seafoam.quality import Quality
from seafoam.scene.models import Light, ParametricWave, Scene, Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light`` on translucent water."""
    if scene.light is None:
        return None
    top = surface_top(scene)
    return Contribution(
        why=f"crests up to {top:g} m against the sun",
        slots=(SlotFile("crest", "crest/translucent.glsl", needs=("shade/sun.glsl",)),),
        uniforms={
            "u_translucency": number(scene.water.translucency, "/water/translucency"),
            "u_crest_height": number(1.0 / top if top > 0.0 else 0.0),
        },
        bound=Bound(
            crest_limit(scene),
            "no crest, no sun on it, or water too dark to let it through",
            ("/light/exposure", "/water/absorption_length", "/water/translucency"),
        ),
    )


EFFECT = Effect(
    "crest light",
    contribute,
    invisible=(
        Scene(),
        Scene(waves=(ParametricWave(),), water=Water(translucency=0.0)),
        Scene(waves=(ParametricWave(),), light=Light(sun_elevation=-0.3)),
        Scene(waves=(ParametricWave(),), water=Water(absorption_length=(0.5, 0.5, 0.5))),
    ),
)
