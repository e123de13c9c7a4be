"""Sunlight through thin crests. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import crest_limit, surface_top, surface_trough
from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Chop,
    Light,
    ParametricWave,
    Scene,
    Water,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light`` on translucent water."""
    if scene.light is None:
        return None
    top, trough = surface_top(scene), surface_trough(scene)
    return Contribution(
        why=f"crests up to {top:g} m against the sun",
        slots=(SlotFile("crest", "crest/translucent.glsl", needs=("shade/sun.glsl",)),),
        uniforms={
            "u_translucency": number(scene.water.translucency, "/water/translucency"),
            "u_crest_trough": number(significant(trough)),
            "u_crest_height": number(1.0 / (top - trough) if top - trough > 1e-37 else 0.0),
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
    hard_cases=(
        HardCase(
            name="crests of a millionth of a metre",
            scene=Scene(
                waves=(ParametricWave(amplitude=1e-6, wavelength=3.0),),
                light=Light(sun_elevation=0.1),
                water=Water(chop=Chop()),
            ),
            guard="the share of the greatest height, 1/height in float64 (effects/light/subsurface.py)",
            without="nothing here; 0/0 where nothing is high is NaN",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="the thickest crest in the clearest water",
            scene=Scene(
                waves=(ParametricWave(amplitude=50.0, wavelength=300.0),) * 4,
                light=Light(sun_elevation=0.05),
                water=Water(translucency=2.0, absorption_length=(1000.0, 1000.0, 0.01)),
            ),
            guard="lengths of absorption at least 0.01 m (scene/models.py), the height's share squared at "
            "most 1 (crest/translucent.glsl)",
            without="nothing: light of 9 at most, which half floats hold",
            camera=Camera(position=(0.0, 210.0, 0.0), yaw=math.pi / 2, pitch=-0.2),
        ),
        HardCase(
            name="no crest at all",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0),), water=Water(translucency=2.0), light=Light(sun_elevation=0.1)
            ),
            guard="1/height taken as 0 where it is flat (effects/light/subsurface.py)",
            without="0 times 1/0: NaN in every sample toward the sun",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
    ),
)
