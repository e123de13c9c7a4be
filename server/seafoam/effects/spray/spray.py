"""Spray: drops in the air, as points. docs/formulae.md, section 13."""

import math
from typing import Literal

from seafoam.effects.effect import (
    ABOVE,
    Bound,
    Const,
    Contribution,
    Effect,
    HardCase,
    Knob,
    PassSpec,
    SlotRef,
    TextureUse,
)
from seafoam.effects.light.noise import HASH
from seafoam.effects.waves.parametric import steepest_profile
from seafoam.framegraph.passes import Points
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Constant, Loop, Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.dispersion import angular_frequency
from seafoam.ocean.rocks import ROCKS, rocks
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Light, ParametricWave, Scene
from seafoam.scene.shore import Shore, Surf
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
    land = (
        ("shore/ground.glsl", "surface/begin.glsl", "shore/maxima.glsl", "shore/find_land.glsl", "spray/over_land.glsl")
        if source == "rocks"
        else ("spray/over_water.glsl",)
    )
    drawn = PassSpec(
        name="spray",
        program="spray",
        vertex=(
            "common/numbers.glsl",
            "common/camera.glsl",
            SlotRef("waves"),
            SlotRef("find"),
            SlotRef("sky"),
            *(("shade/sun.glsl", "spray/lit.glsl") if lit else ("spray/unlit.glsl",)),
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


_ROCK = Shore(
    kind="island",
    size=120.0,
    radius=11.0,
    depth=9.0,
    height=7.0,
    slope=0.9,
    smoothing=3.0,
    surf=Surf(height=2.6, period=8.0),
)
_LIGHT = Light(sun_elevation=0.5, sun_azimuth=-1.5, exposure=-2.0)
_WAVES = (
    ParametricWave(amplitude=1.5, wavelength=20.0, direction=1.6, exponent=2.0),
    ParametricWave(amplitude=0.6, wavelength=9.0, direction=2.1, exponent=1.5),
)
_VIEW = Camera(position=(-33.0, 4.6, 15.0), yaw=1.12, pitch=0.03, fov=0.62)


EFFECT = Effect(
    "spray",
    contribute,
    invisible=(
        Scene(spray=Spray()),
        Scene(waves=(ParametricWave(amplitude=0.1),), spray=Spray()),
        Scene(shore=Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0), spray=Spray()),
        Scene(shore=_ROCK.model_copy(update={"surf": Surf(height=0.0)}), spray=Spray(), light=None),
    ),
    knobs=(Knob("/spray_count", "drops of the spray", (2048, 4096, 8192, 16384), "geometry"),),
    hard_cases=(
        HardCase(
            name="spray under the camera",
            scene=Scene(shore=_ROCK, spray=Spray(size=0.1, mist=0.5), light=_LIGHT),
            guard="drops fade out from 1 m to 0.3 m before the eye (spray/vertex.glsl)",
            without="discs over the whole picture: off by 13 levels in the mean",
            times=(0.9, 1.6),
            camera=Camera(position=(-13.3, 2.5, 2.1), pitch=-math.pi / 2, fov=2.0),
        ),
        HardCase(
            name="spray of waves ten thousand kilometres away, after thirty years",
            scene=Scene(waves=_WAVES, spray=Spray(threshold=0.5), light=_LIGHT),
            guard="lives and the eye's place reduced in float64 (framegraph/evaluation.py)",
            without="in float32: drops born in steps of 64 s and of a metre",
            times=(-1e9, 1e9),
            camera=Camera(position=(1e7, 5.0, -1e7), pitch=-0.15),
        ),
        HardCase(
            name="spray on rocks ten thousand kilometres away, after thirty years",
            scene=Scene(
                shore=_ROCK.model_copy(update={"place": (-9999900.0, 9999900.0)}), spray=Spray(life=6.0), light=_LIGHT
            ),
            guard="periods and the eye's place reduced in float64 (framegraph/evaluation.py)",
            without="in float32: bursts in steps of 64 s, eight of the surf's periods",
            times=(-1e9, 1e9),
            camera=_VIEW.model_copy(update={"position": (-9999933.0, 4.6, 9999915.0)}),
        ),
        HardCase(
            name="spray from crests and troughs, where waves have no slope",
            scene=Scene(waves=_WAVES, spray=Spray(threshold=0.0, life=0.2, size=0.1), light=_LIGHT),
            guard="the square of the slope at least 0.02 (spray/waves.glsl)",
            without="drops shot off without end from crests: up to 3.9 levels off",
            camera=Camera(position=(0.0, 5.0, 0.0), pitch=-0.15),
        ),
        HardCase(
            name="spray against the strongest drag and wind",
            scene=Scene(shore=_ROCK, spray=Spray(drag=0.05, wind=40.0, speed=10.0, life=8.0), light=_LIGHT),
            guard="none needed: exp(-267) is 0 (spray/flight.glsl)",
            without="nothing to leave out",
            times=(1.2,),
            camera=_VIEW,
        ),
        HardCase(
            name="drops of a thousandth of a sample",
            scene=Scene(shore=_ROCK, spray=Spray(size=0.002, mist=0.0), light=_LIGHT),
            guard="a disc is at least a sample and a half wide, and thinner by as much (spray/vertex.glsl)",
            without="drops seen or not by where samples fall: up to 0.9 levels off",
            times=(1.2,),
            camera=_VIEW,
        ),
        HardCase(
            name="spray before the brightest sun, ten stops up",
            scene=Scene(shore=_ROCK, spray=Spray(), light=_LIGHT.model_copy(update={"exposure": 10.0})),
            guard="none needed: scattered sun and sky are 12 000 at most (spray/lit.glsl)",
            without="nothing to leave out; 2139 here",
            times=(1.2,),
            camera=_VIEW,
        ),
    ),
)
