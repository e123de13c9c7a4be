"""Spray: drops in the air, as points. docs/formulae.md, section 13."""

import math
from dataclasses import dataclass
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
from seafoam.effects.noise import HASH
from seafoam.effects.shore.maps import FIND_LAND
from seafoam.effects.waves.parametric import max_profile_slope
from seafoam.framegraph.passes import Points
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Constant, Loop, Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.dispersion import angular_frequency
from seafoam.ocean.rocks import ROCKS, rocks
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray
from seafoam.scene.waves import ParametricWave
from seafoam.textures import SprayRocks

EPOCHS = 65536
"""Number of lives, or of surf periods, after which the same drops are emitted again."""
_DELAY = 1.5
"""Longest time between the arrival of a crest and the start of a drop, s."""


@dataclass(frozen=True)
class _Emission:
    """What throws drops up. ``fastest``: upper bound of their starting speed, m/s; ``words``: the same, to be read."""

    source: Literal["rocks", "waves", "none"]
    words: str
    fastest: float = 0.0


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has spray."""
    spray = scene.spray
    if spray is None:
        return None
    emission = _emission(scene, spray)
    uniforms = _flight_uniforms(spray)
    consts: dict[str, Const] = {"SPRAY_WIDER": math.sqrt(DROPS / quality.spray_count)}
    textures: dict[str, TextureUse] = {}
    cycle = spray.life
    if emission.source == "rocks" and scene.shore is not None:
        cycle = scene.shore.surf.period
        uniforms |= _rock_uniforms(spray, cycle)
        consts |= {"SPRAY_ROCKS": ROCKS, "SPRAY_DELAY": _DELAY}
        textures["spray_rocks"] = TextureUse(SprayRocks(shore=scene.shore, steep=spray.steep), wrap="clamp_to_edge")
    elif emission.source == "waves":
        uniforms |= _wave_uniforms(scene, spray)
    if emission.source != "none":
        uniforms["u_spray_time"] = array("float", [Loop(period=cycle), Loop(period=cycle * EPOCHS)], 2)
    invisible = emission.source == "none" or emission.fastest <= spray.threshold
    return Contribution(
        why=f"drops from {emission.source}",
        consts=consts,
        uniforms=uniforms,
        textures=textures,
        passes=() if emission.source == "none" else (_drop_pass(scene, quality, emission),),
        bound=Bound(0.0, emission.words) if invisible else None,
    )


def fastest_rise(scene: Scene) -> float:
    """Upper bound of the speed at which parametric waves raise the surface, m/s: all of them at once, in one place."""
    return sum(angular_frequency(wave) * wave.amplitude * max_profile_slope(wave.exponent) for wave in scene.waves)


def _emission(scene: Scene, spray: Spray) -> _Emission:
    shore = scene.shore
    if shore is not None:
        if shore.surf.height == 0.0 or len(rocks(shore, spray.steep)) == 0:
            return _Emission("none", "no surf breaks on any rock")
        # At the coast waves are at most 1.2 times their breaking height, by Green's law.
        fastest = spray.speed * math.sqrt(GRAVITY * 1.2 * shore.surf.height / 0.3)
        return _Emission("rocks", f"surf on rocks starts drops at {fastest:.2g} m/s at most", fastest)
    if not _raised(scene):
        return _Emission("none", "neither parametric waves nor surf to throw drops up")
    fastest = fastest_rise(scene)
    return _Emission("waves", f"the water rises at {fastest:.2g} m/s at most", fastest)


def _raised(scene: Scene) -> list[ParametricWave]:
    return [wave for wave in scene.waves if wave.amplitude > 0.0]


def _flight_uniforms(spray: Spray) -> dict[str, Uniform]:
    wind = (
        significant(spray.wind * math.cos(spray.wind_direction)),
        significant(spray.wind * math.sin(spray.wind_direction)),
    )
    return {
        "u_spray_wind": vector(wind),
        "u_spray_size": number(spray.size, "/spray/size"),
        "u_spray_mist": number(spray.mist, "/spray/mist"),
        "u_spray_drag": number(spray.drag, "/spray/drag"),
        "u_spray_life": number(spray.life),
        "u_spray_speed": number(spray.speed),
        "u_spray_threshold": number(spray.threshold),
    }


def _rock_uniforms(spray: Spray, period: float) -> dict[str, Uniform]:
    # A drop's life ends before the next crest arrives.
    return {"u_spray_life": number(min(spray.life, period - _DELAY)), "u_spray_period": number(period)}


def _wave_uniforms(scene: Scene, spray: Spray) -> dict[str, Uniform]:
    side, waves = 2.0 * spray.reach, _raised(scene)
    rates = [Constant(value=(angular_frequency(wave),)) for wave in waves]
    return {
        "u_spray_reach": number(spray.reach),
        "u_spray_eye": array("vec2", [Wrap(k=(1.0, 0.0), period=side), Wrap(k=(0.0, 1.0), period=side)], 1),
        "u_parametric_rate": array("float", rates, len(waves)),
    }


def _drop_pass(scene: Scene, quality: Quality, emission: _Emission) -> PassSpec:
    """The drops, as points blended over the picture."""
    light = ("spray/unlit.glsl",) if scene.light is None else (*ILLUMINATION, "spray/lit.glsl")
    on_rocks = emission.source == "rocks"
    hidden = (*FIND_LAND, "spray/over_land.glsl") if on_rocks else ("spray/over_water.glsl",)
    return PassSpec(
        name="spray",
        program="spray",
        vertex=(
            "lib/numbers.glsl",
            "lib/camera.glsl",
            SlotRef("waves"),
            SlotRef("find"),
            SlotRef("sky"),
            *light,
            HASH,
            "spray/flight.glsl",
            f"spray/{emission.source}.glsl",
            *hidden,
            "spray/vertex.glsl",
        ),
        fragment=("spray/drop.glsl",),
        target=ABOVE,
        mesh=Points(count=quality.spray_count),
        inputs={"u_spray_rocks": TextureInput(texture="spray_rocks")} if on_rocks else {},
        stage="after",
        blend="over",
    )


EFFECT = Effect(
    "spray",
    contribute,
    fields=("/spray",),
    knobs=(Knob("/spray_count", "spray drops", (2048, 4096, 8192, 16384), "geometry"),),
)
