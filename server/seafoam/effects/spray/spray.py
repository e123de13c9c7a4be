"""Spray: water in the air, as quadrilaterals whose optical depths add up. docs/formulae.md, section 13."""

import math

from seafoam.effects.boats.boat import TRACE
from seafoam.effects.effect import ABOVE, Contribution, PassSpec, QualityParameter, Resources, TextureUse, part_effect
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, HASH, PLACE, Inline, Piece, SlotRef, Source
from seafoam.effects.shore.maps import FIND_LAND
from seafoam.effects.spray.births import Births, births
from seafoam.framegraph.plan import Quads
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target, ViewportSize
from seafoam.framegraph.rules import Viewport, array, number, rounded, significant, vector
from seafoam.quality import Quality
from seafoam.scene import DROPS, Scene, Spray
from seafoam.textures.foam import STRANDS, SprayStrands

COLUMNS = 128
"""Drops in a row of their table."""
_PARTS = 3
"""Texels of the table for each drop."""
FINER = 3.7
"""Scale of the finer strands."""
WINDOW = 0.4
"""Share of the strands' texture that a drop shows across."""
_TABLE: tuple[Piece | SlotRef, ...] = (HASH, "spray/drawn.glsl@flight", "spray/births.glsl@table")


def _draw(scene: Scene, spray: Spray, quality: Quality) -> Contribution:
    quality, part = _suited(scene, quality)
    found = births(scene, quality, spray)
    if found is None:
        return Contribution.invisible("no waves break, and no bursts throw water up")
    speed, heading, count = spray.wind_speed, spray.downwind, quality.spray_count
    table = Target(size=FixedSize(width=COLUMNS, height=count // COLUMNS), format="RGBA32F", layers=_PARTS)
    size = ViewportSize(scale=math.isqrt(quality.samples), part=part)
    thick = Target(size=size, format="RGBA16F", filter="linear" if part > 1 else "nearest")
    contribution = Contribution(
        why=f"drops from {found.words}",
        consts={
            # As much water: fewer drops alone leave gaps, and are thinner for being wider.
            "SPRAY_WIDER": significant(math.pow(DROPS / count, 0.625)),
            "SPRAY_THINNER": significant(math.pow(DROPS / count, -0.25)),
            "SPRAY_COLUMNS": COLUMNS,
            "SPRAY_STRANDS": STRANDS,
            "SPRAY_WINDOW": WINDOW,
            "SPRAY_FINER": FINER,
            "SPRAY_BEAT": found.beat,
        },
        uniforms={
            "u_spray_wind": vector(rounded((speed * math.cos(heading), speed * math.sin(heading)))),
            "u_spray_size": number(spray.size, "/spray/size"),
            "u_spray_mist": number(spray.mist, "/spray/mist"),
            "u_spray_drag": number(spray.drag, "/spray/drag"),
            "u_spray_speed": number(spray.speed),
            "u_spray_threshold": number(spray.threshold),
        },
        textures={"spray_strands": TextureUse(SprayStrands(), filter=MIPMAPPED)},
        targets={"spray_births": table, "spray_air": table, "spray_thick": thick},
    )
    return contribution.joined(found, Resources(passes=_passes(scene, quality, found, part)))


def _suited(scene: Scene, quality: Quality) -> tuple[Quality, int]:
    """Return the quality, and how many pixels of the picture are as wide and as high as one of the water in the air.

    Crests of an open sea alone throw up thin veils, where rocks and bursts tear the water into strings. Beside wide
    pixels veils have half of the drops (``storm`` errs 9.17 levels instead of 8.78 at 0.97 of the frame's time, where
    rocks would 7.8 instead of 3.0), and are four times as coarse (at most seven levels of any pixel away from twice as
    coarse, in half of the time); what rocks or bursts throw up is twice as coarse beside pixels at least three wide.
    """
    veil = scene.shore is None and scene.spray is not None and not scene.spray.bursts
    if veil and quality.pixel_width > 1:
        return quality.model_copy(update={"spray_count": quality.spray_count // 2}), 4
    return quality, 2 if quality.pixel_width > 2 else 1


def _passes(scene: Scene, quality: Quality, found: Births, part: int) -> tuple[PassSpec, ...]:
    """Births, where drops are now, their optical depths, and what these hide."""
    births_files = (HASH, "spray/drawn.glsl@flight", "spray/births.glsl@thrown", *found.files, "spray/births.glsl@pass")
    return (
        PassSpec("births of drops", "spray_births", (*COMMON, *births_files), stage="after"),
        _air_pass(scene, quality),
        _water_pass(scene, quality),
        PassSpec(
            "spray",
            "spray_over",
            (*COMMON, PLACE, "spray/air.glsl@thick"),
            target=ABOVE,
            stage="after",
            blend="over",
            part=part,
        ),
    )


def _air_pass(scene: Scene, quality: Quality) -> PassSpec:
    """Where drops are now, what of them is seen, and their light."""
    files: tuple[Piece | SlotRef, ...] = (*COMMON, *map(SlotRef, ("waves", "find", "sky", "open sun")))
    lit = ("spray/drawn.glsl@unlit",) if scene.light is None else (*ILLUMINATION, "spray/drawn.glsl@lit")
    file = "spray/drawn.glsl@over_water" if scene.shore is None else "spray/drawn.glsl@over_land"
    over: tuple[Piece | SlotRef, ...] = (file,)
    if scene.boats:
        over = (*TRACE, Source(file, (("spray_hidden", "spray_hidden_openly"),)), "spray/drawn.glsl@past_boats")
    land: tuple[Piece | SlotRef, ...] = () if scene.shore is None else FIND_LAND
    rays = Viewport(of="picture", times=math.isqrt(quality.samples))
    return PassSpec(
        "drops in the air",
        "spray_air",
        (*files, *lit, *_TABLE, *land, *over, "spray/air.glsl@air"),
        # Rays are those of the picture, not of the table.
        uniforms={"u_viewport": array("vec2", (rays,), 1)},
        stage="after",
    )


def _water_pass(scene: Scene, quality: Quality) -> PassSpec:
    sun: tuple[Piece, ...] = (Inline("uniform vec3 u_sun_direction;\n"), "spray/drawn.glsl@sunward_lit")
    sunward = ("spray/drawn.glsl@sunward_none",) if scene.light is None else sun
    return PassSpec(
        "water in the air",
        "spray",
        ("spray/drawn.glsl@drop",),
        target="spray_thick",
        vertex=(
            *COMMON,
            *_TABLE,
            "spray/drawn.glsl@form",
            *sunward,
            "vertex/vertex.glsl@quad",
            "spray/drawn.glsl@vertex",
        ),
        mesh=Quads(count=quality.spray_count),
        stage="after",
        blend="add",
        clear=True,
    )


EFFECT = part_effect(
    "spray",
    _draw,
    "/spray",
    QualityParameter("/spray_count", "spray drops", (2048, 4096, 8192, 16384), "geometry"),
    fields=("/spray/bursts",),
)
