"""Spray: drops in the air, as points. docs/formulae.md, section 13."""

import math
from typing import Literal

from seafoam.effects.effect import (
    ABOVE,
    Bound,
    Const,
    Contribution,
    Effect,
    Knob,
    PassSpec,
    SlotRef,
    TextureUse,
)
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.light.noise import HASH
from seafoam.effects.shore.shore import FIND_LAND
from seafoam.effects.waves.parametric import steepest_profile
from seafoam.framegraph.passes import Points
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Constant, Loop, Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.dispersion import angular_frequency
from seafoam.ocean.rocks import ROCKS, rocks
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray
from seafoam.textures import spray_rocks_name

EPOCHS = 65536
"""After so many lives, or periods of the surf, the same drops fly again."""
_DELAY = 1.5
"""Drops start within so many seconds of a crest."""
Source = Literal["rocks", "waves", "none"]


def fastest_rise(scene: Scene) -> float:
    """Greatest speed at which single waves can raise the surface, m/s: all at once, in one place."""
    return sum(angular_frequency(wave) * wave.amplitude * steepest_profile(wave.exponent) for wave in scene.waves)


def _source(scene: Scene, spray: Spray) -> tuple[Source, str, float]:
    """What throws up drops, in words, and how fast it does so at most, m/s."""
    shore = scene.shore
    if shore is not None:
        if shore.surf.height == 0.0 or len(rocks(shore.ground, spray.steep)) == 0:
            return "none", "no surf breaks on any rock", 0.0
        # Waves are at most 1.2 times their breaking height where they reach the coast, by Green's law.
        fastest = spray.speed * math.sqrt(9.81 * 1.2 * shore.surf.height / 0.3)
        return "rocks", f"surf on rocks starts drops at {fastest:.2g} m/s at most", fastest
    waves = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if not waves:
        return "none", "neither single waves nor surf to throw it up", 0.0
    fastest = fastest_rise(scene)
    return "waves", f"no water rises faster than {fastest:.2g} m/s", fastest


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``spray``."""
    spray = scene.spray
    if spray is None:
        return None
    source, words, fastest = _source(scene, spray)
    lit = scene.light is not None
    uniforms: dict[str, Uniform] = {
        "u_spray_wind": vector(
            (
                significant(spray.wind * math.cos(spray.wind_direction)),
                significant(spray.wind * math.sin(spray.wind_direction)),
            )
        ),
        "u_spray_size": number(spray.size, "/spray/size"),
        "u_spray_mist": number(spray.mist, "/spray/mist"),
        "u_spray_drag": number(spray.drag, "/spray/drag"),
        "u_spray_life": number(spray.life),
        "u_spray_speed": number(spray.speed),
        "u_spray_threshold": number(spray.threshold),
    }
    consts: dict[str, Const] = {"SPRAY_WIDER": math.sqrt(DROPS / quality.spray_count)}
    inputs: dict[str, TextureInput] = {}
    textures: dict[str, TextureUse] = {}
    cycle = spray.life
    if source == "rocks" and scene.shore is not None:
        cycle = scene.shore.surf.period
        consts.update(SPRAY_ROCKS=ROCKS, SPRAY_DELAY=_DELAY)
        # A drop's life ends before the next crest comes.
        uniforms["u_spray_life"] = number(min(spray.life, cycle - _DELAY))
        uniforms["u_spray_period"] = number(cycle)
        inputs["u_spray_rocks"] = TextureInput(texture="spray_rocks")
        textures["spray_rocks"] = TextureUse(spray_rocks_name(scene.shore, spray.steep), wrap="clamp_to_edge")
    elif source == "waves":
        waves = [wave for wave in scene.waves if wave.amplitude > 0.0]
        side = 2.0 * spray.reach
        uniforms["u_spray_reach"] = number(spray.reach)
        uniforms["u_spray_eye"] = array("vec2", [Wrap(k=(1.0, 0.0), period=side), Wrap(k=(0.0, 1.0), period=side)], 1)
        uniforms["u_parametric_rate"] = array(
            "float", [Constant(value=(angular_frequency(wave),)) for wave in waves], len(waves)
        )
    if source != "none":
        uniforms["u_spray_time"] = array("float", [Loop(period=cycle), Loop(period=cycle * EPOCHS)], 2)
    land = (*FIND_LAND, "spray/over_land.glsl") if source == "rocks" else ("spray/over_water.glsl",)
    drawn = PassSpec(
        name="spray",
        program="spray",
        vertex=(
            "lib/numbers.glsl",
            "lib/camera.glsl",
            SlotRef("waves"),
            SlotRef("find"),
            SlotRef("sky"),
            *((*ILLUMINATION, "spray/lit.glsl") if lit else ("spray/unlit.glsl",)),
            HASH,
            "spray/flight.glsl",
            f"spray/{source}.glsl",
            *land,
            "spray/vertex.glsl",
        ),
        fragment=("spray/drop.glsl",),
        target=ABOVE,
        mesh=Points(count=quality.spray_count),
        inputs=dict(inputs),
        stage="after",
        blend="over",
    )
    return Contribution(
        why=f"drops from {source}",
        consts=consts,
        uniforms=uniforms,
        textures=textures,
        passes=() if source == "none" else (drawn,),
        bound=Bound(0.0, words) if source == "none" or fastest <= spray.threshold else None,
    )


EFFECT = Effect(
    "spray",
    contribute,
    knobs=(Knob("/spray_count", "spray drops", (2048, 4096, 8192, 16384), "geometry"),),
)
