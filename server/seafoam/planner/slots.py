"""The slots of the surface and sky shaders: which files may fill them, and how several files of a slot are joined.

A slot's files define the same functions, so the planner can pick any. Where a slot takes several files, each prefixes
its functions, and the planner writes the function that joins them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from seafoam.effects.shader import Piece
from seafoam.planner import defaults


@dataclass(frozen=True)
class Join:
    """A joining function: ``returns name(parameters)`` from ``prefix_suffix(arguments)`` of each file."""

    returns: str
    name: str
    parameters: str
    suffix: str
    arguments: str
    how: Literal["sum", "max", "product"] = "sum"
    limit: str = ""
    """GLSL expression of the maximum of the joined value."""
    none: str = "0.0"
    """Value without any file."""

    def glsl(self, prefixes: Sequence[str]) -> str:
        """Return the function's source."""
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


WAVES = Slot(
    "waves",
    joins=(
        Join("vec3", "waves", "vec2 p", "waves", "p"),
        Join("vec4", "waves_shading", "vec2 p, Footprint fp", "shading", "p, fp"),
    ),
)
"""Height and gradient of the surface; the second function without waves smaller than the footprint."""

OPEN_WAVES = Slot(
    "waves",
    joins=(
        Join("vec3", "open_waves", "vec2 p", "waves", "p"),
        Join("vec4", "open_shading", "vec2 p, Footprint fp", "shading", "p, fp"),
    ),
)
SHORE = Slot("shore")
"""With a shore, it combines the open sea's waves with its own."""

DETAIL = Slot("detail", joins=(Join("vec3", "detail", "vec2 p, Footprint fp", "detail", "p, fp"),))
"""Slopes without height: gradient, and the mean square slope removed by the footprint."""

MARCHED = Slot("marched")
"""Shared functions of ray marching; filled if any pass marches to the surface."""
NOW = Slot("now", default="surface/bounds.glsl@now_declared", under="marched")
"""Bounds of the present surface, for the steps of ray marching."""
GENTLER = Slot(
    "gentler",
    under="marched",
    joins=(Join("float", "surface_gentler", "vec3 ray, float from", "gentler", "ray, from"),),
)
"""By how much a ray from ``from`` times its vector on meets smaller slopes than the bound of NOW."""
SHORT = Slot("short", default=defaults.NO_SHORT_WAVES, under="marched")
"""Short waves that ray marching bounds separately: ``SHORT_WAVES`` says whether there are any."""
BEYOND = Slot("beyond", default=defaults.NO_BEYOND, under="marched")
"""Distance along a ray from which the waves are less steep."""
APPROACH = Slot("approach", default=defaults.NO_APPROACH, under="marched")
"""First part of a march, over water that needs fewer of its waves."""
FIND = Slot("find")
"""Intersection of the ray with the surface; selected by the quality."""
SHORT_BOUNDS = Slot("short bounds", default=defaults.NO_SHORT_BOUNDS)
"""Upper bounds of height over y = 0 (m), slope and second derivative (1/m) of the short waves."""
MARCH_SLOTS = (MARCHED, NOW, GENTLER, SHORT, BEYOND, APPROACH)

BOUNDS = Slot(
    "bounds",
    joins=(Join("vec3", "surface_bounds", "vec3 ray, float aside, float from", "bounds", "ray, aside, from"),),
)
"""Upper bounds of the surface's height over y = 0 (m), slope and second derivative (1/m) along a ray from ``from``
times its vector on, and along all rays up to ``aside`` metres a unit beside it. Height and slope hold for the whole
ray."""

START = Slot(
    "start",
    joins=(Join("vec3", "starts", "vec3 ray, vec3 side, vec3 top", "start", "ray, side, top"),),
)
"""Free distance of the rays between ray ± side ± top: r of water, g of land; each file fills a component."""

SATURATION_MAX = Slot(
    "saturation",
    joins=(
        Join("float", "saturation", "vec2 p, float height, Footprint fp", "saturation", "p, height, fp", "max", "4.0"),
    ),
)
SATURATION_PRODUCT = Slot(
    "saturation",
    joins=(
        Join(
            "float", "saturation", "vec2 p, float height, Footprint fp", "saturation", "p, height, fp", "product", "4.0"
        ),
    ),
)
"""Foam saturation, in [0, 4]."""

CARRY = Slot("carry", under="carry", joins=(Join("vec2", "carry", "vec2 p", "carry", "p"),))
"""Vector from a place to the rest position of the water there, m; called after that place was shaded."""
OPEN_CARRY = Slot("carry", under="carry", joins=(Join("vec2", "open_carry", "vec2 p", "carry", "p"),))
SHORE_CARRY = Slot("shore carry", under="carry")
"""With a shore, it combines the open sea's orbits with its own."""
LOOK = Slot("look", default=defaults.NO_FOAM)
"""Foam amount from saturation."""
OVER = Slot("over", default="foam/shading.glsl@over")
"""Composition of foam and water."""
ALBEDO = Slot("albedo", default=defaults.NO_ALBEDO, under="shade")
LAYERED = Slot("layered")
MOON = Slot("moon", default=defaults.NO_MOON, under="layered")
CIRRUS = Slot("cirrus", default=defaults.NO_CIRRUS, under="layered")
CLOUDS = Slot("clouds", default=defaults.NO_CLOUDS, under="layered")
RAIN = Slot("rain", default=defaults.NO_RAIN, under="layered")
SKY = Slot("sky", default=defaults.BLACK_SKY)
"""Light of the sky; a layered sky is combined from air, moonlight and clouds."""
MOON_DISC = Slot("moon disc", default=defaults.NO_MOON_DISC, under="layered")
STARS = Slot("stars", default=defaults.NO_STARS, under="layered")
SKY_MAIN = Slot("sky main", default="light/sky.glsl@main")
DISC = Slot("disc", default=defaults.NO_SUN_DISC)
OPEN_SUN = Slot(
    "open sun",
    joins=(Join("float", "open_sun", "vec3 place, Footprint fp", "sunlit", "place, fp", "product", none="1.0"),),
)
"""Share of the direct sunlight that reaches a place past land and clouds: a factor of the sun's light on boats and
drops."""
SUNLIGHT = Slot("sunlight", default=defaults.NO_BOAT_SHADOW)
"""The same past boats too: a factor of the sun's light on water, foam, floor and land."""
BODY = Slot("body", default="water/body.glsl@deep", under="shade")
CREST = Slot("crest", default=defaults.NO_CREST_LIGHT, under="shade")
PLUME = Slot("plume", default=defaults.NO_BUBBLES, under="shade")
"""Bubbles in the water under foam."""
GLITTER = Slot("glitter", default=defaults.NO_GLITTER, under="shade")
REFLECTION = Slot("reflection", default="reflection/mirror.glsl@sky", under="shade")
"""Light reflected by the water."""
SHADE = Slot("shade", default="light/shade.glsl@flat")
RELIEF = Slot("relief", default=defaults.NO_RELIEF)
"""Called before water and foam are lit: fraction of the sun that foam beside the place blocks."""
FOAM_LAYER = Slot("foam layer", default=defaults.MATT_FOAM)
"""Light of foam over water, and its opacity."""
CAUSTICS = Slot("caustics", default="water/seafloor.glsl@even", under="bed")
"""Distribution of the sun's light on a level floor."""
BED = Slot("bed")
"""Light of a level floor, if single points of it are visible from above the surface."""
UNDERSIDE = Slot("underside")
"""Intersection of a ray from below with the surface; filled like FIND."""
REACH = Slot("reach", default=defaults.NO_FLOOR_BELOW, under="below")
UNDER_BED = Slot("under bed", default=defaults.NO_FLOOR_LIGHT, under="below")
"""The floor as seen from below the surface: its distance and its light."""
THROUGH = Slot("through", default=defaults.NO_FLOOR)
"""Called before the water is shaded: what is visible through it."""
LAND = Slot("land", default=defaults.NO_LAND)
"""Objects in front of the water."""
LAND_FOAM = Slot("land foam", default=defaults.NO_FOAM_ON_LAND, under="land color")
"""Foam on the land."""
LAND_COLOR = Slot("land color")
"""Colour of the land; none without land."""
FIRST = Slot("first", default="surface/met.glsl@first")
"""What a ray meets first, water or land."""
MAIN = Slot("main", default="surface/main.glsl")
BELOW = Slot("below")
"""Main function for a camera under the surface."""
ONLY_OVER = (
    GENTLER,
    SHORT,
    BEYOND,
    APPROACH,
    FIND,
    RELIEF,
    FOAM_LAYER,
    THROUGH,
    LAND,
    LAND_FOAM,
    LAND_COLOR,
    FIRST,
    MAIN,
)
"""Slots that the shader for such a camera leaves out."""
UNDER_SLOTS = (UNDERSIDE, REACH, UNDER_BED, BELOW)
"""Slots that it has besides."""
GLARE = Slot("glare", default=defaults.NO_GLARE)
TONE = Slot("tone", default="output/tone.glsl@clamp")


SKY_SLOTS = (LAYERED, MOON, CIRRUS, CLOUDS, RAIN, SKY)
"""Components of ``sky_light``, in source order."""
SUN_SLOTS = (*SKY_SLOTS, OPEN_SUN, SUNLIGHT)
"""Slots of sky and direct sunlight, in source order."""
SKY_PASS_SLOTS = (*SKY_SLOTS, DISC, MOON_DISC, STARS, SKY_MAIN)
"""Slots of the sky's fragment shader, in source order."""


def _foam_slots(combine: Literal["max", "product"], shore: bool) -> tuple[Slot, ...]:
    """Slots of foam, in source order."""
    saturation = SATURATION_MAX if combine == "max" else SATURATION_PRODUCT
    carry = (OPEN_CARRY, SHORE_CARRY) if shore else (CARRY,)
    return (saturation, *carry, LOOK, OVER, ALBEDO)


def surface_slots(combine: Literal["max", "product"], shore: bool = False) -> tuple[Slot, ...]:
    """Slots of the surface's fragment shader, in source order."""
    waves = (OPEN_WAVES, SHORE) if shore else (WAVES,)
    lit = (*SUN_SLOTS, BODY, CREST, PLUME, GLITTER, REFLECTION, SHADE, RELIEF, FOAM_LAYER, CAUSTICS, BED)
    foam = _foam_slots(combine, shore)
    land = (LAND, LAND_FOAM, LAND_COLOR)
    return (*waves, DETAIL, *MARCH_SLOTS, FIND, *foam, *lit, THROUGH, *land, FIRST, MAIN)


def land_slots(combine: Literal["max", "product"], foam: bool) -> tuple[Slot, ...]:
    """Slots of the fragment shader that draws land, in source order.

    ``foam``: whether there is foam on it.
    """
    lit = (*SUN_SLOTS, BODY, CREST, PLUME, GLITTER, REFLECTION, SHADE)
    own = _foam_slots(combine, True) if foam else (OVER, ALBEDO)
    return (OPEN_WAVES, SHORE, *own, *lit, LAND_FOAM, LAND_COLOR)


def slots_named(name: str, shore: bool = False) -> tuple[Slot, ...]:
    """Return the slots of the surface's shader with a name. Raises ``KeyError``.

    ``waves`` includes the shore's slot, ``find`` those of ray marching, ``sky`` those of a layered sky.
    """
    names = {
        "waves": {"waves", "shore"},
        "find": {"find", *(slot.name for slot in MARCH_SLOTS)},
        "sky": {slot.name for slot in SKY_SLOTS},
    }.get(name, {name})
    every = (*surface_slots("max", shore), *UNDER_SLOTS, BOUNDS, SHORT_BOUNDS, START)
    slots = tuple(slot for slot in every if slot.name in names)
    if not slots:
        raise KeyError(name)
    return slots
