"""The slots of the surface and sky shaders: what may fill them, and how several files of one slot join.

A slot's files define the same functions, so the planner can pick any. Where a slot takes several files, each prefixes
its functions, and the planner writes the function that joins them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from seafoam.effects.effect import Piece
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
    """GLSL expression that the joined value may not exceed."""

    def glsl(self, prefixes: Sequence[str]) -> str:
        """The function's text; no file at all gives zero."""
        calls = [f"{prefix}_{self.suffix}({self.arguments})" for prefix in prefixes]
        if not calls:
            value = f"{self.returns}(0.0)"
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
    """A place in a shader. ``joins``: where it takes several files; ``default``: what
    stands there where nothing fills it.

    ``under``: a slot; default and joins go in only where that one is filled.
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
"""Height and gradient of the surface; the second function with what is smaller than the footprint taken out."""

OPEN_WAVES = Slot(
    "waves",
    joins=(
        Join("vec3", "open_waves", "vec2 p", "waves", "p"),
        Join("vec4", "open_shading", "vec2 p, Footprint fp", "shading", "p, fp"),
    ),
)
SHORE = Slot("shore")
"""Where there is a shore, it joins the open sea's waves with its own."""

DETAIL = Slot("detail", joins=(Join("vec3", "detail", "vec2 p, Footprint fp", "detail", "p, fp"),))
"""Slopes that have no height: gradient, and the mean square slope taken out."""

MARCHED = Slot("marched")
"""What marches share; filled where something marches to the surface."""
NOW = Slot("now", default="surface/now_declared.glsl", under="marched")
"""Bounds of the surface as it is now, for a march's steps."""
SHORT = Slot("short", default=defaults.NO_SHORT_WAVES, under="marched")
"""Waves that a march tells apart from those they ride on: ``SHORT_WAVES`` says whether there are any."""
BEYOND = Slot("beyond", default=defaults.NO_BEYOND, under="marched")
"""From where on a ray meets less steep waves."""
FIND = Slot("find")
"""How the ray finds the surface; filled by the quality."""
SHORT_BOUNDS = Slot("short bounds", default=defaults.NO_SHORT_BOUNDS)
"""Height over y = 0 (m), slope and second derivative (1/m) of the short waves at most."""
MARCH_SLOTS = (MARCHED, NOW, SHORT, BEYOND)

BOUNDS = Slot(
    "bounds",
    joins=(Join("vec3", "surface_bounds", "vec3 ray, float aside, float from", "bounds", "ray, aside, from"),),
)
"""The most that the surface's height over y = 0 (m), slope and second derivative (1/m) can be where a ray goes on from
``from`` times itself, and all rays up to ``aside`` metres a unit beside it. Height and slope hold wherever it goes."""

START = Slot(
    "start",
    joins=(Join("vec3", "starts", "vec3 ray, vec3 side, vec3 top", "start", "ray, side, top"),),
)
"""How far the rays between ray ± side ± top are free: r of water, g of land; each file fills a component."""

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
"""The way from a place to where the water that is there rests, m; called after that place was shaded."""
OPEN_CARRY = Slot("carry", under="carry", joins=(Join("vec2", "open_carry", "vec2 p", "carry", "p"),))
SHORE_CARRY = Slot("shore carry", under="carry")
"""Where there is a shore, it joins the open sea's orbits with its own."""
LOOK = Slot("look", default=defaults.NO_FOAM)
"""Foam amount from saturation."""
OVER = Slot("over", default="foam/over.glsl")
"""How foam meets water."""
ALBEDO = Slot("albedo", default=defaults.NO_ALBEDO, under="shade")
LAYERED = Slot("layered")
MOON = Slot("moon", default=defaults.NO_MOON, under="layered")
CLOUDS = Slot("clouds", default=defaults.NO_CLOUDS, under="layered")
SKY = Slot("sky", default=defaults.BLACK_SKY)
"""Light of the sky; a layered one is joined from air, moonlight and clouds."""
MOON_DISC = Slot("moon disc", default=defaults.NO_MOON_DISC, under="layered")
STARS = Slot("stars", default=defaults.NO_STARS, under="layered")
SKY_MAIN = Slot("sky main", default="sky/main.glsl")
DISC = Slot("disc", default=defaults.NO_SUN_DISC)
BODY = Slot("body", default="body/deep.glsl", under="shade")
CREST = Slot("crest", default=defaults.NO_CREST_LIGHT, under="shade")
PLUME = Slot("plume", default=defaults.NO_BUBBLES, under="shade")
"""Bubbles in the water under foam."""
GLITTER = Slot("glitter", default=defaults.NO_GLITTER, under="shade")
REFLECTION = Slot("reflection", default="reflection/sky.glsl", under="shade")
"""What the water mirrors."""
SHADE = Slot("shade", default="shade/flat.glsl")
RELIEF = Slot("relief", default=defaults.NO_RELIEF)
"""Called before water and foam are lit: what foam takes from the sun beside it."""
CAUSTICS = Slot("caustics", default="bed/even.glsl", under="bed")
"""How the sun's light lies on a level floor."""
BED = Slot("bed")
"""A level floor as it is lit, where the eye over the surface tells its places apart."""
CEILING = Slot("ceiling")
"""How a ray from under the surface finds it; filled as FIND is."""
REACH = Slot("reach", default=defaults.NO_FLOOR_BELOW, under="below")
UNDER_BED = Slot("under bed", default=defaults.NO_FLOOR_LIGHT, under="below")
"""The floor as an eye under the surface sees it: how far it is, and its light."""
THROUGH = Slot("through", default=defaults.NO_FLOOR)
"""Called before the water is shaded: what is seen through it."""
LAND = Slot("land", default=defaults.NO_LAND)
"""What stands before the water."""
LAND_FOAM = Slot("land foam", default=defaults.NO_FOAM_ON_LAND, under="land color")
"""Foam on the land."""
LAND_COLOR = Slot("land color")
"""What it looks like; none where no land is."""
MAIN = Slot("main", default="surface/main.glsl")
BELOW = Slot("below")
"""What an eye under the surface sees; it calls the main function of an eye over it ``seen_from_above``."""
UNDER_SLOTS = (CEILING, REACH, UNDER_BED, BELOW)
"""Slots of the shader for eyes that crests may cover, beyond those of the surface's own."""
TONE = Slot("tone", default="tone/clamp.glsl")


SKY_SLOTS = (LAYERED, MOON, CLOUDS, SKY)
"""What ``sky_light`` is made of, in the order of the text."""
SKY_PASS_SLOTS = (*SKY_SLOTS, DISC, MOON_DISC, STARS, SKY_MAIN)
"""The slots of the sky's fragment shader, in the order of the text."""


def _foam_slots(combine: Literal["max", "product"], shore: bool) -> tuple[Slot, ...]:
    """What foam is made of, in the order of the text."""
    saturation = SATURATION_MAX if combine == "max" else SATURATION_PRODUCT
    carry = (OPEN_CARRY, SHORE_CARRY) if shore else (CARRY,)
    return (saturation, *carry, LOOK, OVER, ALBEDO)


def surface_slots(combine: Literal["max", "product"], shore: bool = False) -> tuple[Slot, ...]:
    """The slots of the surface's fragment shader, in the order of the text."""
    waves = (OPEN_WAVES, SHORE) if shore else (WAVES,)
    lit = (*SKY_SLOTS, BODY, CREST, PLUME, GLITTER, REFLECTION, SHADE, RELIEF, CAUSTICS, BED)
    foam = _foam_slots(combine, shore)
    land = (LAND, LAND_FOAM, LAND_COLOR)
    return (*waves, DETAIL, *MARCH_SLOTS, FIND, *foam, *lit, THROUGH, *land, MAIN)


def land_slots(combine: Literal["max", "product"], foam: bool) -> tuple[Slot, ...]:
    """The slots of the fragment shader that draws land where rays meet it, in the order of the text.

    ``foam``: whether any lies on it.
    """
    lit = (*SKY_SLOTS, BODY, CREST, PLUME, GLITTER, REFLECTION, SHADE)
    own = _foam_slots(combine, True) if foam else (OVER, ALBEDO)
    return (OPEN_WAVES, SHORE, *own, *lit, LAND_FOAM, LAND_COLOR)


def slots_named(name: str, shore: bool = False) -> tuple[Slot, ...]:
    """The slots of the surface's shader that have a name. Raises ``KeyError``.

    ``waves`` brings the shore's with it, ``find`` what a march asks, ``sky`` all that a layered sky is joined from.
    """
    together = {
        "waves": {"waves", "shore"},
        "find": {"find", *(slot.name for slot in MARCH_SLOTS)},
        "sky": {slot.name for slot in SKY_SLOTS},
    }.get(name, {name})
    every = (*surface_slots("max", shore), *UNDER_SLOTS, BOUNDS, SHORT_BOUNDS, START)
    found = tuple(slot for slot in every if slot.name in together)
    if not found:
        raise KeyError(name)
    return found
