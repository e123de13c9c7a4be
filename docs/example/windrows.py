"""Example of an effect: windrows, the foam lines that Langmuir circulation lays along the wind.

CONTRIBUTING.md walks through this file and ``windrows.glsl``; a test runs both on the server and in the browser.
"""

import math
from pathlib import Path

from seafoam.effects.contribution import Contribution, Effect, Phase, SlotFile, array, number, vector
from seafoam.quality import Quality
from seafoam.scene.models import Scene

SPACING = 14.0
"""Distance from line to line, m."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for where there is foam and a wind."""
    if scene.foam is None or scene.water.chop is None:
        return None
    wind = scene.water.chop.wind_direction
    k = 2.0 * math.pi / SPACING
    across = (-k * math.sin(wind), k * math.cos(wind))
    return Contribution(
        why=f"windrows {SPACING:g} m apart",
        slots=(SlotFile("saturation", str(Path(__file__).with_name("windrows.glsl")), prefix="windrow"),),
        uniforms={
            "u_windrow_k": vector(across),
            # The eye's own place enters here, reduced in float64: the shader's p starts at the eye.
            "u_windrow_phase": array("float", [Phase(offset=0.0, rate=0.0, k=across)], 1),
            "u_windrow_strength": number(0.35),
        },
    )


EFFECT = Effect("windrows", contribute)
