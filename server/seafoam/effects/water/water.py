"""The body of the water: absorption, scattering, roughness. docs/formulae.md, section 6."""

from seafoam.effects.effect import Contribution, Effect
from seafoam.framegraph.rules import Uniform, number, vector
from seafoam.ocean.cascades import cascades, slope_heading
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def _slope_heading(scene: Scene) -> tuple[float, float]:
    """Return how much more of the sea's slope variance lies along its wind, at twice the wind's heading."""
    if scene.sea is None or scene.sea.wind <= 0.0:
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


EFFECT = Effect("water body", contribute, fields=("/water",))
