"""A plunging crest: a solid on the still water, which rays meet in one pass. docs/formulae.md, section 17."""

import math

from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.effect import ABOVE, Contribution, PassSpec, PlanError, Resources, SaturationSource, part_effect
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, PERLIN_2, PLACE, Piece, SlotFile, SlotRef, Source, constant_function
from seafoam.effects.shore.maps import FIND_LAND
from seafoam.framegraph.plan import Quads
from seafoam.framegraph.rules import Constant, Wrap, array, number, rounded, significant, to_camera, vector
from seafoam.ocean.waves import plunging
from seafoam.quality import Quality
from seafoam.scene import Breaker, BreakerSaturation, Foam, Scene

STEPS = 64
"""Most steps along a ray's way through the crest's box, and steps through that of what it throws up."""
_SHAPE = "BORE LENGTH LEAN LONG XX XZ HALF_WIDTH HALF_HEIGHT VERTICAL FOREMOST THROW SHOULDER LEANING TAIL TAPER FRONT"
_LOOK = "LOWEST GENTLE LUMP SEED APRON STREAK CLOUDED RAISED FOOT CELL SOFT"
_FILE = "waves/breaker.glsl@"
_SECTION = (f"{_FILE}course", *PERLIN_2, f"{_FILE}section")
_LIT = ("lib/refraction.glsl", *ILLUMINATION, f"{_FILE}light")
_NO_FOAM = constant_function("float", "breaker_left", "vec2 on, float patches")
_NO_LAND = constant_function("bool", "crest_behind_land", "vec3 ray, float farthest", "false")
_LAND = (*FIND_LAND, Source("boats/drawn.glsl@land", (("boat_behind_land", "crest_behind_land"),)))


def _draw(scene: Scene, crest: Breaker, quality: Quality) -> Contribution:
    if crest.height == 0.0:
        return Contribution.invisible("the crest has no height")
    form = plunging.overturning(crest)
    least = max((plunging.LENGTH + plunging.FRONT) / form.advance, form.life / plunging.CRESTS) / form.rate
    if crest.every < least:
        raise PlanError("/breaker/every", f"between {least:.3g} and 600 s, so that crests stay apart")
    front = Wrap(k=(0.0, 0.0), offset=plunging.SHOULDER - form.rate * crest.start, period=form.period, rate=form.rate)
    course = Constant(value=rounded((math.cos(crest.heading), math.sin(crest.heading))))
    return Contribution(
        why=f"crests {crest.height:g} m high plunge",
        consts={
            **{f"PLUNGING_{name}": getattr(plunging, name) for name in _SHAPE.split()},
            **{f"CREST_{name}": getattr(plunging, name) for name in _LOOK.split()},
            "CREST_SIDE": 1.0 if crest.peels == "right" else -1.0,
            "CREST_STEPS": STEPS,
            "CREST_COUNT": form.crests,
        },
        uniforms={
            "u_breaker_front": array("vec2", [front, Constant(value=(form.period,))], 1),
            "u_breaker_form": vector(rounded((crest.height, form.landing, form.length, form.advance))),
            "u_breaker_place": array("vec4", [*to_camera(*crest.place), course], 1),
            "u_breaker_glow": number(scene.water.translucency, "/water/translucency"),
        },
    ).joined(left := _left(scene.foam, form.rate), Resources(passes=(_pass(scene, bool(left.slots), quality),)))


def _left(foam: Foam | None, rate: float) -> Resources:
    if foam is None or (source := foam.source(BreakerSaturation)) is None:
        return Resources()
    torn = "foam/saturation/wake.glsl@torn" if foam.look == "filtered" else "foam/saturation/wake.glsl@torn_exact"
    needs = (f"{_FILE}course", f"{_FILE}left", PERLIN_2[0], "lib/noise.glsl@value", torn)
    return Resources(
        slots=(SlotFile("saturation", f"{_FILE}saturation", prefix="breaker", needs=needs),),
        consts={"BREAKER_CAP": 1.0 if foam.look == "filtered" else SATURATION_CAP},
        uniforms={"u_breaker_foam": vector((source.amount, significant(rate * source.life)))},
    )


def left_limit(source: BreakerSaturation, scene: Scene) -> float:
    """Return the greatest saturation that crests leave: 0 without any."""
    return min(1.2 * source.amount, SATURATION_CAP) if scene.breaker and scene.breaker.height > 0.0 else 0.0


def _pass(scene: Scene, left: bool, quality: Quality) -> PassSpec:
    own: tuple[Piece, ...] = (_NO_LAND,) if scene.shore is None else _LAND
    own = (*own, f"{_FILE}left" if left else _NO_FOAM, *((f"{_FILE}dark",) if scene.light is None else _LIT))
    fragment: tuple[Piece | SlotRef, ...] = (
        *(*COMMON, PLACE, *_SECTION, constant_function("vec2", "carry", "vec2 p")),
        *map(SlotRef, ("waves", "detail", "find", "look", "over", "albedo", "sky", "mirrored", "open sun", "sunlight")),
        *(f"{_FILE}trace", f"{_FILE}look", *own),
        *map(SlotRef, ("plume", "glitter", "shade", "foam layer")),
        f"{_FILE}main",
    )
    return PassSpec(
        "plunging crest",
        "breaker",
        fragment,
        under=(*COMMON, f"{_FILE}none"),
        vertex=(*COMMON, *_SECTION, "vertex/vertex.glsl@quad", f"{_FILE}vertex"),
        mesh=Quads(count=1),
        target=ABOVE,
        stage="after",
        blend="over",
        # Where pixels are wide a quarter of the rays takes a quarter of the time.
        part=2 if quality.pixel_width > 2 else 1,
    )


EFFECT = part_effect("plunging crest", _draw, "/breaker", saturation=SaturationSource(BreakerSaturation, left_limit))
