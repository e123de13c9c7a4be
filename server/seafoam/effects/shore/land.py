"""The land's look: its soil in detail or smooth, and how wet it is. docs/formulae.md, section 8."""

from seafoam.effects.noise import SLOPES
from seafoam.effects.shader import Const, Source
from seafoam.framegraph.rules import Uniform, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.shore import Shore

LAND_LIGHT = {False: "shore/land.glsl@land_lit", True: "shore/land.glsl@land_film"}
"""The file that lights land, by whether it has detail."""

FILM_DRIES, SAND_DRIES = 4.0, 40.0
"""Times in which the film of water on sand and the sand dry to 1/e, s."""


def soil_files(shore: Shore) -> tuple[str, ...]:
    """Files of the land's material; the noise library and shore/ground.glsl@ground come before them."""
    if shore.detail <= 0.0:
        return ("shore/soil.glsl@soil_struct", "shore/soil.glsl@soil_plain")
    return (*SLOPES, "shore/soil.glsl@soil_struct", "shore/soil.glsl@soil")


def wet_files(shore: Shore) -> tuple[str, ...]:
    """Files of the wetness that the swash leaves on land."""
    swash = shore.detail > 0.0 and shore.surf.height > 0.0
    return ("shore/soil.glsl@wet",) if swash else ("shore/soil.glsl@wet_still",)


def shallow_files(shore: Shore) -> tuple[str | Source, ...]:
    """Files of the floor's colour; shore/ground.glsl@ground comes before them."""
    if shore.detail <= 0.0:
        return ("shore/floor.glsl@shallow_plain",)
    return (*soil_files(shore), "shore/floor.glsl@shallow")


def soil_consts(shore: Shore, quality: Quality) -> dict[str, Const]:
    return {"LAND_OCTAVES": quality.land_octaves} if shore.detail > 0.0 else {}


def soil_uniforms(shore: Shore) -> dict[str, Uniform]:
    if shore.detail <= 0.0:
        return {}
    period = shore.surf.period
    return {
        "u_land_detail": number(shore.detail),
        "u_land_strand": number(significant(0.4 * shore.surf.height + 0.12)),
        "u_land_dries": vector((significant(FILM_DRIES / period), significant(SAND_DRIES / period))),
    }
