"""Example of an effect: windrows, the foam lines that Langmuir circulation lays along the wind.

CONTRIBUTING.md walks through this file and ``windrows.glsl``; a test runs both on the server and in the browser.
"""

import math
from pathlib import Path

from seafoam.effects.effect import Bound, Contribution, Effect, SlotFile
from seafoam.framegraph.rules import Phase, array, number, vector
from seafoam.quality import Quality
from seafoam.scene.models import Scene

SPACING = 14.0
"""Distance from line to line, m."""
STRENGTH = 3.0
"""Saturation on a line for each unit of the ripples' slope, up to 0.35."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has foam and wind ripples."""
    if scene.foam is None or scene.water.chop is None:
        return None
    wind = scene.water.chop.wind_direction
    strength = min(STRENGTH * scene.water.chop.slope, 0.35)
    k = 2.0 * math.pi / SPACING
    across = (-k * math.sin(wind), k * math.cos(wind))
    return Contribution(
        why=f"windrows {SPACING:g} m apart",
        slots=(SlotFile("saturation", str(Path(__file__).with_name("windrows.glsl")), prefix="windrow"),),
        uniforms={
            "u_windrow_k": vector(across),
            # The camera position enters here, reduced in float64: the shader's p is relative to the camera.
            "u_windrow_phase": array("float", [Phase(offset=0.0, rate=0.0, k=across)], 1),
            "u_windrow_strength": number(strength),
        },
        bound=None if strength > 0.0 else Bound(0.0, "no wind"),
    )


EFFECT = Effect("windrows", contribute)
