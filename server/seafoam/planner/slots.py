"""The slots of the surface and sky shaders: which files may fill them, and how several files of a slot are joined.

A slot's files define the same functions, so the planner can pick any. Where a slot takes several files, each prefixes
its functions, and the planner writes the function that joins them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from seafoam.effects.shader import Inline, Piece, constant_function, joined

Combine = Literal["max", "product"]
"""How foam saturations are combined."""


@dataclass(frozen=True)
class Join:
    """A joining function: ``returns name(parameters)`` from ``prefix_suffix`` of each file, of the same parameters."""

    returns: str
    name: str
    parameters: str
    suffix: str
    how: Literal["sum", "max", "product"] = "sum"
    limit: str = ""
    """GLSL expression of the maximum of the joined value."""
    none: str = "0.0"
    """Value without any file."""

    @property
    def arguments(self) -> str:
        return ", ".join(parameter.split()[-1] for parameter in self.parameters.split(","))

    def glsl(self, prefixes: Sequence[str]) -> str:
        calls = [f"{prefix}_{self.suffix}({self.arguments})" for prefix in prefixes]
        if not calls:
            value = f"{self.returns}({self.none})"
        elif self.how == "max":
            value = calls[0]
            for call in calls[1:]:
                value = f"max({value}, {call})"
        else:
            value = (" + " if self.how == "sum" else " * ").join(calls)
        if self.limit and len(calls) > 1:
            value = f"min({value}, {self.limit})"
        return f"{self.returns} {self.name}({self.parameters}) {{\n    return {value};\n}}\n"


@dataclass(frozen=True)
class Slot:
    """A place in a shader that files fill.

    ``joins``: functions that join several files; ``default``: the source if no file fills the slot. ``under``: another
    slot; default and joins are included only if that one is filled.
    """

    name: str
    default: Piece | None = None
    under: str = ""
    joins: tuple[Join, ...] = ()


def _waves(height: str, shading: str) -> Slot:
    heights, seen = Join("vec3", height, "vec2 p", "waves"), Join("vec4", shading, "vec2 p, Footprint fp", "shading")
    return Slot("waves", joins=(heights, seen))


WAVES = _waves("waves", "waves_shading")
"""Height and gradient of the surface; the second function without waves smaller than the footprint."""
OPEN_WAVES = _waves("open_waves", "open_shading")
SHORE = Slot("shore")
"""With a shore, it combines the open sea's waves with its own."""
DETAIL = Slot("detail", joins=(Join("vec3", "detail", "vec2 p, Footprint fp", "detail"),))
"""Slopes without height: gradient, and the mean square slope removed by the footprint."""
MARCHED = Slot("marched")
"""Shared functions of ray marching; filled if any pass marches to the surface."""
NOW = Slot("now", "surface/bounds.glsl@now_declared", under="marched")
"""Bounds of the present surface, for the steps of ray marching."""
GENTLER = Slot("gentler", under="marched", joins=(Join("float", "surface_gentler", "vec3 ray, float from", "gentler"),))
"""By how much a ray from ``from`` times its vector on meets smaller slopes than the bound of NOW."""
_NO_SHORT = joined(Inline("const bool SHORT_WAVES = false;\n"), constant_function("vec3", "short_waves", ""))
SHORT = Slot("short", _NO_SHORT, under="marched")
"""Short waves that ray marching bounds separately: ``SHORT_WAVES`` says whether there are any."""
_NEVER = constant_function("vec3", "surface_beyond", "vec3 ray, float aside", "vec3(1e30, 0.0, 0.0)")
BEYOND = Slot("beyond", _NEVER, under="marched")
"""Distance along a ray from which the waves are less steep."""
_OPEN = "vec3 ray, float leave, float fine, vec3 now, vec2 less, float bend, inout float tau"
APPROACH = Slot("approach", constant_function("void", "march_open", _OPEN), under="marched")
"""First part of a march, over water that needs fewer of its waves."""
FIND = Slot("find")
"""Intersection of the ray with the surface; selected by the quality."""
SHORT_BOUNDS = Slot("short bounds", constant_function("vec3", "short_bounds", ""))
"""Upper bounds of height over y = 0 (m), slope and second derivative (1/m) of the short waves."""
MARCH_SLOTS = (MARCHED, NOW, GENTLER, SHORT, BEYOND, APPROACH)
BOUNDS = Slot("bounds", joins=(Join("vec3", "surface_bounds", "vec3 ray, float aside, float from", "bounds"),))
"""Upper bounds of the surface's height over y = 0 (m), slope and second derivative (1/m) along a ray from ``from``
times its vector on, and along all rays up to ``aside`` metres a unit beside it. Height and slope hold for the whole
ray."""
START = Slot("start", joins=(Join("vec3", "starts", "vec3 ray, vec3 side, vec3 top", "start"),))
"""Free distance of the rays between ray ± side ± top: r of water, g of land; each file fills a component."""


def saturation(combine: Combine) -> Slot:
    """Return the slot of foam saturation, in [0, 4]."""
    join = Join("float", "saturation", "vec2 p, float height, Footprint fp", "saturation", combine, "4.0")
    return Slot("saturation", joins=(join,))


CARRY = Slot("carry", under="carry", joins=(Join("vec2", "carry", "vec2 p", "carry"),))
"""Vector from a place to the rest position of the water there, m; called after that place was shaded."""
OPEN_CARRY = Slot("carry", under="carry", joins=(Join("vec2", "open_carry", "vec2 p", "carry"),))
SHORE_CARRY = Slot("shore carry", under="carry")
"""With a shore, it combines the open sea's orbits with its own."""
LOOK = Slot("look", constant_function("float", "foam_amount", "float f, vec2 p, Footprint fp"))
"""Foam amount from saturation."""
OVER = Slot("over", "foam/shading.glsl@over")
"""Composition of foam and water."""
ALBEDO = Slot("albedo", constant_function("float", "foam_albedo", ""), under="shade")
LAYERED = Slot("layered")
_NO_MOON = (
    constant_function("vec3", "moon_glow", "vec3 d"),
    constant_function("vec3", "moon_glow_rim", "vec2 level, vec3 d"),
)
MOON = Slot("moon", joined(*_NO_MOON), under="layered")
_SEEN = "vec3 d, vec2 spread, out float hidden"
CIRRUS = Slot("cirrus", constant_function("vec4", "cirrus", _SEEN, before="hidden = 0.0;"), under="layered")
_NO_CLOUDS = constant_function("vec4", "clouds", _SEEN, before="hidden = 0.0;")
CLOUDS = Slot("clouds", joined(constant_function("vec4", "clouds_along_horizon", ""), _NO_CLOUDS), under="layered")
_DRY = constant_function("vec4", "in_rain", "vec4 light, vec3 d, vec2 spread, inout float hidden", "light")
RAIN = Slot("rain", _DRY, under="layered")
_DARK = (
    *(constant_function("vec3", name, "vec3 d") for name in ("sky_light", "horizon_light")),
    constant_function("vec3", "mirrored_sky", "vec3 r, vec3 spread"),
    constant_function("float", "exposure", "", "1.0"),
)
SKY = Slot("sky", joined(*_DARK))
"""Light of the sky; a layered sky is combined from air, moonlight and clouds."""
MIRRORED = Slot("mirrored", "light/sky.glsl@mirrored", under="layered")
"""A layered sky as water mirrors it."""
MOON_DISC = Slot("moon disc", constant_function("vec4", "moon_disc", "vec3 d"), under="layered")
STARS = Slot("stars", constant_function("vec3", "star_light", "vec3 d, float pixel"), under="layered")
SKY_MAIN = Slot("sky main", "light/sky.glsl@main")
DISC = Slot("disc", constant_function("vec3", "sun_disc", "vec3 d"))
_SUN = Join("float", "open_sun", "vec3 place, Footprint fp", "sunlit", "product", none="1.0")
OPEN_SUN = Slot("open sun", joins=(_SUN,))
"""Share of the direct sunlight that reaches a place past land and clouds: a factor of the sun's light on boats and
drops."""
SUNLIGHT = Slot("sunlight", constant_function("float", "sunlit", "vec3 place, Footprint fp", "open_sun(place, fp)"))
"""The same past boats too: a factor of the sun's light on water, foam, floor and land."""
BODY = Slot("body", "water/body.glsl@deep", under="shade")
CREST = Slot("crest", constant_function("vec3", "crest_light", "vec3 d, vec3 absorption, float height"), under="shade")
_LIGHTS = "vec3 body, vec3 deep, vec3 below, vec3 extinction, float cv, float f"
PLUME = Slot("plume", constant_function("vec3", "aerated", _LIGHTS, "body"), under="shade")
"""Bubbles in the water under foam."""
_DULL = constant_function("vec3", "glitter_light", "vec3 d, vec3 n, float sigma2, float cv")
GLITTER = Slot("glitter", _DULL, under="shade")
REFLECTION = Slot("reflection", "reflection/mirror.glsl@sky", under="shade")
"""Light reflected by the water."""
SHADE = Slot("shade", "light/shade.glsl@flat")
RELIEF = Slot("relief", constant_function("void", "foam_relief", "float f, float amount, vec2 p, Footprint fp"))
"""Called before water and foam are lit: fraction of the sun that foam beside the place blocks."""
_OPAQUE = constant_function("vec4", "foam_layer", "vec3 n, vec3 d, float f", "vec4(foam_light(n), 1.0)")
FOAM_LAYER = Slot("foam layer", _OPAQUE)
"""Light of foam over water, and its opacity."""
CAUSTICS = Slot("caustics", "water/seafloor.glsl@even", under="bed")
"""Distribution of the sun's light on a level floor."""
BED = Slot("bed")
"""Light of a level floor, if single points of it are visible from above the surface."""
UNDERSIDE = Slot("underside")
"""Intersection of a ray from below with the surface; filled like FIND."""
REACH = Slot("reach", constant_function("float", "bed_reach", "vec2 p, float y, vec3 d", "1e6"), under="below")
_NO_BED = constant_function("vec3", "bed_light", "vec2 at, float down, Footprint fp")
UNDER_BED = Slot("under bed", _NO_BED, under="below")
"""The floor as seen from below the surface: its distance and its light."""
_LOOK = "vec2 p, float height, vec3 d, vec3 normal, float unresolved, Footprint fp"
THROUGH = Slot("through", constant_function("void", "look_through", _LOOK))
"""Called before the water is shaded: what is visible through it."""
_AHEAD, _NONE = "vec3 ray, out float land_tau, out vec4 ground", "land_tau = 0.0;\nground = vec4(0.0);"
_NO_LAND = (
    constant_function("bool", "find_land_ahead", _AHEAD, "false", _NONE),
    constant_function("vec4", "land_color", "vec3 ray, vec3 d, float tau, vec4 ground"),
)
LAND = Slot("land", joined(*_NO_LAND))
"""Objects in front of the water."""
_CLEAN = constant_function("float", "land_foam", "vec2 p, float ground, Footprint fp")
LAND_FOAM = Slot("land foam", _CLEAN, under="land color")
"""Foam on the land."""
LAND_SOIL = Slot("land soil")
"""What a sample of land is."""
SOIL_KEPT = Slot("soil struct", "shore/soil.glsl@soil_struct"), Slot("soil kept", "shore/floor.glsl@soil_kept")
"""The same, found by a pass before."""
LAND_COLOR = Slot("land color")
"""Colour of the land; none without land."""
FIRST = Slot("first", "surface/met.glsl@first")
"""What a ray meets first, water or land."""
_MAIN = "surface/main.glsl@"
_SAMPLE, _SAMPLED = Slot("sample", f"{_MAIN}sample"), Slot("sampled", f"{_MAIN}sampled")
FOUND = (_SAMPLE, _SAMPLED, Slot("found", f"{_MAIN}found"))
"""A sample of the water, found by the program."""
FOUND_BELOW = tuple(
    Slot(f"{part} below", f"{_MAIN}{part}", under="shade") for part in ("sample", "sampled", "found_below")
)
KEPT = (_SAMPLE, Slot("kept", f"{_MAIN}kept"))
"""The same, found by a pass before."""
SAMPLES_PASS = f"{_MAIN}samples_pass"
"""File of that pass."""
MAIN = Slot("main", f"{_MAIN}main")
BELOW = Slot("below")
"""Main function for a camera under the surface."""
GLARE = Slot("glare", constant_function("vec3", "with_glare", "vec3 light", "light"))
TONE = Slot("tone", "output/tone.glsl@clamp")
BLOCK_MEAN = Slot("block mean", "output/glare.glsl@mean")
"""Mean of the finished frame over a block of 4 x 4 pixels."""
FINISHED = Slot("finished", "output/frame.glsl@finished")
"""The finished frame in linear light, at a pixel."""
SKY_SLOTS = (LAYERED, MOON, CIRRUS, CLOUDS, RAIN, SKY)
"""Components of ``sky_light``, in source order."""
SKY_PASS_SLOTS = (*SKY_SLOTS, DISC, MOON_DISC, STARS, SKY_MAIN)
"""Slots of the sky's fragment shader, in source order."""
_LIT = (*SKY_SLOTS, MIRRORED, OPEN_SUN, SUNLIGHT, BODY, CREST, PLUME, GLITTER, REFLECTION, SHADE)
"""Slots of light on water and land, in source order."""
LIGHT_SLOTS = (OVER, ALBEDO, *_LIT, RELIEF, FOAM_LAYER, CAUSTICS, BED, THROUGH)
"""Slots of light on water, in source order."""
_LAND = (LAND, LAND_FOAM, LAND_SOIL, LAND_COLOR)
ONLY_OVER = (GENTLER, SHORT, BEYOND, APPROACH, FIND, RELIEF, FOAM_LAYER, THROUGH, *_LAND, FIRST, *FOUND, MAIN)
"""Slots that the shader for a camera under the surface leaves out."""
UNDER_SLOTS = (UNDERSIDE, REACH, UNDER_BED, *FOUND_BELOW, BELOW)
"""Slots that it has besides."""


def _foam_slots(combine: Combine, shore: bool) -> tuple[Slot, ...]:
    carry = (OPEN_CARRY, SHORE_CARRY) if shore else (CARRY,)
    return (saturation(combine), *carry, LOOK)


def sample_slots(combine: Combine, shore: bool) -> tuple[Slot, ...]:
    """Slots of what a sample of the water is, in source order."""
    waves = (OPEN_WAVES, SHORE) if shore else (WAVES,)
    return (*waves, DETAIL, *MARCH_SLOTS, FIND, *_foam_slots(combine, shore))


def surface_slots(combine: Combine, shore: bool = False) -> tuple[Slot, ...]:
    """Slots of the surface's fragment shader, in source order."""
    return (*sample_slots(combine, shore), *LIGHT_SLOTS, *_LAND, FIRST, *FOUND, MAIN)


def land_slots(combine: Combine, foam: bool) -> tuple[tuple[Slot, ...], tuple[Slot, ...]]:
    """Slots of what a sample of land is, and of its light, in source order, both after those of the shore.

    ``foam``: whether there is foam on it.
    """
    return (*(_foam_slots(combine, True) if foam else ()), LAND_FOAM, LAND_SOIL), (OVER, ALBEDO, *_LIT)


def slots_named(name: str, shore: bool = False) -> tuple[Slot, ...]:
    """Return the slots of the surface's shader with a name. Raises ``KeyError``.

    ``waves`` includes the shore's slot, ``find`` those of ray marching, ``sky`` those of a layered sky.
    """
    names = {
        "waves": {"waves", "shore"},
        "find": {"find", *(slot.name for slot in MARCH_SLOTS)},
        "sky": {slot.name for slot in SKY_SLOTS},
    }.get(name, {name})
    every = (*surface_slots("max", shore), *UNDER_SLOTS, BOUNDS, SHORT_BOUNDS, START, BLOCK_MEAN, FINISHED)
    slots = tuple(slot for slot in every if slot.name in names)
    if not slots:
        raise KeyError(name)
    return slots
