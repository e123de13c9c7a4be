"""The body of the water: absorption, scattering, roughness; and the view from below its surface.

docs/formulae.md, sections 6 and 11.
"""

from seafoam.effects.effect import Contribution, Effect
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import Uniform, number, vector
from seafoam.ocean.waves.cascades import cascades, slope_heading
from seafoam.quality import Quality
from seafoam.scene.models import Scene

WATER = "water/underside.glsl@water"
"""Absorption and scattering between a camera below the surface and what it sees."""


def _slope_heading(scene: Scene) -> tuple[float, float]:
    """Return how much more of the sea's slope variance lies along its wind, at twice the wind's heading."""
    if scene.sea is None or scene.sea.wind_speed <= 0.0:
        return 0.0, 0.0
    along, aside = slope_heading(cascades(scene.sea, scene.water.depth))
    # Of so few digits that every machine gets the same bytes, and no −0.
    return round(along, 4) + 0.0, round(aside, 4) + 0.0


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a light."""
    if scene.light is None:
        return None
    water = scene.water
    uniforms: dict[str, Uniform] = {
        "u_absorption_length": vector(water.absorption_length, "/water/absorption_length"),
        "u_scattering": number(water.scattering, "/water/scattering"),
        "u_roughness": number(water.roughness, "/water/roughness"),
        "u_slope_heading": vector(_slope_heading(scene)),
    }
    return Contribution(why="the water absorbs and scatters light", uniforms=uniforms)


def underside(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene allows views from below (``water.view_below``) and has light or foam."""
    if not scene.water.view_below or (scene.light is None and scene.foam is None):
        return None
    shows, file = "shows its foam", SlotFile("below", "water/underside.glsl@flat")
    if scene.light is not None:
        shows = "transmits the sky and reflects the floor"
        file = SlotFile("below", "water/underside.glsl@main", needs=(WATER,))
    return Contribution(why=f"from below, the surface {shows}", slots=(file,))


EFFECT = Effect("water body", contribute, fields=("/water",))
UNDERSIDE = Effect("view from below", underside, fields=("/water/view_below",))
