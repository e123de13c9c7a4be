"""Boats that float on the drawn surface, traced in the fragment shader. docs/formulae.md, section 15."""

import math

from seafoam.effects.bounds import surface_top, surface_trough
from seafoam.effects.effect import (
    ABOVE,
    Contribution,
    Effect,
    HardCase,
    Knob,
    PassSpec,
    Piece,
    SlotRef,
    Source,
    constant_function,
)
from seafoam.effects.light.light import sky_irradiance
from seafoam.effects.water.underside import WATER
from seafoam.framegraph.passes import Ball
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import (
    Constant,
    Held,
    Phase,
    Rule,
    Uniform,
    UniformType,
    array,
    number,
    significant,
    vector,
)
from seafoam.quality import Quality
from seafoam.scene.boats import Boat
from seafoam.scene.models import Camera, Light, ParametricWave, Scene, Water
from seafoam.scene.shore import Shore, Surf

BOW, QUARTER, BEAM = 0.36, 0.3, 0.1
"""Hull points, in lengths: one so far ahead of the middle, two so far behind it and so far to each side."""
STEM = 0.42
"""The bow at the water line, ahead of the middle, in lengths."""
DRAUGHT = 0.08
"""Keel under the water line, in lengths."""
FAR = 1e8
"""Courses are held so far from the eye, m: no picture reaches there."""

COURSE = "boat/course.glsl"
TRACE = (COURSE, "boat/hull.glsl", "boat/trace.glsl")
LIGHT = ("shade/fresnel.glsl", "shade/sun.glsl", "boat/light.glsl")


def _courses(boats: tuple[Boat, ...]) -> Uniform:
    rules: list[Rule] = []
    for boat in boats:
        turn = 1.0 if boat.turn == "starboard" else -1.0
        rules += [
            Held(offset=-boat.centre[0], k=(1.0, 0.0), low=-FAR, high=FAR),
            Held(offset=-boat.centre[1], k=(0.0, 1.0), low=-FAR, high=FAR),
            Phase(offset=boat.bearing, rate=turn * boat.speed / boat.radius, k=(0.0, 0.0)),
            Constant(value=(turn * boat.radius,)),
        ]
    return array("vec4", rules, len(boats))


def _each(values: list[tuple[float, ...]]) -> Uniform:
    kind: UniformType = "vec3" if len(values[0]) == 3 else "vec4"
    return array(kind, [Constant(value=value) for value in values], len(values))


def _reach(boat: Boat, swing: float) -> Ball:
    """Where a boat can be: on its course, no further up or down than the water, which nothing of it is far from."""
    x, z = boat.centre
    course = boat.radius
    if boat.speed == 0.0:
        x, z = x + course * math.cos(boat.bearing), z + course * math.sin(boat.bearing)
        course = 0.0
    # Shaders look for it within 0.9 lengths of a place 0.4 over its middle.
    return Ball(centre=(x, 0.0, z), radius=significant(1.001 * (course + 1.3 * boat.length + swing) + 0.1))


def shade_files(scene: Scene) -> tuple[Piece | SlotRef, ...]:
    """What gives a boat its light, in a program that has no water."""
    return (SlotRef("sky"), "boat/dark.glsl") if scene.light is None else (SlotRef("sky"), *LIGHT)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any boat."""
    boats = scene.boats
    if not boats:
        return None
    count = len(boats)
    ashore = scene.shore is not None
    motors = sum(boat.kind == "motor" for boat in boats)
    kinds = [f"{n} {name}" for n, name in ((count - motors, "under sail"), (motors, "under power")) if n]
    lit: dict[str, Uniform] = {}
    if scene.light is not None:
        lit = {
            "u_boat_ambient": vector(sky_irradiance(scene.light)),
            "u_boat_visibility": number(scene.light.visibility, "/light/visibility"),
        }
    pose = PassSpec(
        name="how boats float",
        program="boat_pose",
        fragment=(
            "common/numbers.glsl",
            SlotRef("waves"),
            COURSE,
            "boat/aground.glsl" if ashore else "boat/afloat.glsl",
            "boat/pose_pass.glsl",
        ),
        target="boat_pose",
    )
    seen = (
        "common/numbers.glsl",
        "common/camera.glsl",
        "common/place.glsl",
        SlotRef("waves"),
        SlotRef("find"),
        *TRACE,
        *shade_files(scene),
        *(
            ("shore/ground.glsl", "surface/begin.glsl", "shore/maxima.glsl", "shore/find_land.glsl", "boat/land.glsl")
            if ashore
            else (constant_function("bool", "boat_behind_land", "vec3 ray, float farthest", "false"),)
        ),
    )
    over = Source(
        "boat/over.glsl",
        (
            ("boat_hidden", "boat_hidden_over"),
            ("boat_before", "boat_before_over"),
        ),
    )
    under = (over, "shade/optics.glsl", SlotRef("ceiling"), WATER, SlotRef("reach"), "boat/under.glsl")
    swing = max(surface_top(scene), -surface_trough(scene))
    picture = PassSpec(
        name="boats",
        program="boat",
        fragment=(*seen, "boat/over.glsl", "boat/main.glsl"),
        under=() if scene.light is None else (*seen, *under, "boat/main.glsl"),
        target=ABOVE,
        stage="after",
        blend="over",
        # Land would carry it higher.
        view="any" if ashore else tuple(_reach(boat, swing) for boat in boats),
    )
    return Contribution(
        why=f"boats: {', '.join(kinds)}",
        consts={
            "BOAT_COUNT": count,
            "BOAT_SAILS": any(boat.kind == "sail" for boat in boats),
            "BOAT_MOTORS": any(boat.kind == "motor" for boat in boats),
            "BOAT_SIDE": math.isqrt(quality.boat_samples),
            "BOAT_READINGS": quality.boat_readings,
            "BOAT_BOW": BOW,
            "BOAT_QUARTER": QUARTER,
            "BOAT_BEAM": BEAM,
            "BOAT_STEM": STEM,
            "BOAT_DRAUGHT": DRAUGHT,
        },
        uniforms={
            "u_boat_course": _courses(boats),
            "u_boat_form": _each(
                [
                    (
                        boat.length,
                        boat.smoothing,
                        significant(math.cos(boat.heel)),
                        significant(math.sin(boat.heel)),
                    )
                    for boat in boats
                ]
            ),
            "u_boat_rig": _each(
                [
                    (
                        1.0 if boat.kind == "motor" else 0.0,
                        significant(math.cos(boat.boom)),
                        significant(math.sin(boat.boom)),
                    )
                    for boat in boats
                ]
            ),
            **lit,
            "u_boat_hull": _each([boat.hull for boat in boats]),
            "u_boat_sails": _each([boat.sails for boat in boats]),
        },
        inputs={"u_boat_pose": TargetInput(target="boat_pose")},
        targets={"boat_pose": Target(size=FixedSize(width=count, height=1), format="RGBA32F")},
        passes=(pose, picture),
    )


_NEAR = Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.6, speed=0.0)
_VIEW = Camera(position=(0.0, 3.0, 12.0), pitch=-0.12)
_BEACH = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0, surf=Surf(height=1.5))

EFFECT = Effect(
    "boats",
    contribute,
    always_visible="a boat stands over the water and before it",
    knobs=(
        Knob("/boat_samples", "rays a sample where boats are", (1, 4, 9), "filtering"),
        Knob("/boat_readings", "heights read round each hull point", (1, 7), "geometry"),
    ),
    hard_cases=(
        HardCase(
            name="a boat on a breaking crest",
            scene=Scene(
                waves=(ParametricWave(amplitude=6.0, wavelength=12.0, exponent=6.0, direction=1.2),),
                boats=(_NEAR.model_copy(update={"smoothing": 0.0, "length": 4.0, "bearing": 1.45}),),
            ),
            guard="no boat tilts over 45 degrees (boat/pose_pass.glsl)",
            without="2.5 levels off in the mean, the worst sample by 252: a boat on its side",
            times=(0.0, 0.7, 1.4),
            camera=Camera(position=(0.0, 9.0, 16.0), pitch=-0.2),
        ),
        HardCase(
            name="a boat on dry land",
            scene=Scene(
                shore=_BEACH,
                boats=(Boat(centre=(-10.0, 0.0), radius=9.0, bearing=0.5, speed=0.0, length=6.0),),
                light=Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0),
                water=Water(scattering=0.01),
            ),
            guard="under its keel the ground carries it (boat/aground.glsl)",
            without="sunk into the hill: 1.7 % of samples off by more than 2 levels, the worst by 163",
            camera=Camera(position=(-30.0, 7.0, 9.0), yaw=1.4, pitch=-0.2),
        ),
        HardCase(
            name="a boat ten thousand kilometres away, after thirty years",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.3, wavelength=9.0),),
                boats=(_NEAR.model_copy(update={"centre": (-9999990.0, 9999980.0), "speed": 3.0}),),
            ),
            guard="bearing and way from the centre of the course reduced in float64 (framegraph/evaluation.py)",
            without="in float32 at 1e9 s bearings are 16 rad apart, and places 1 m: the boat is anywhere on its circle",
            times=(-1e9, 1e9),
            camera=Camera(position=(-9999990.0, 9.0, 10000000.0), pitch=-0.2),
        ),
        HardCase(
            name="eye in a boat",
            scene=Scene(boats=(Boat(centre=(0.0, -50.0), radius=50.0, length=30.0, bearing=1.57, speed=0.0),)),
            guard="what is behind the eye is cut away (boat/hull.glsl)",
            without="10 % of samples off by more than 2 levels: what is behind the eye stands before it",
            camera=Camera(position=(0.0, 1.0, 1.0), pitch=-0.2),
        ),
        HardCase(
            name="rays along a boat's own axes",
            scene=Scene(boats=(_NEAR.model_copy(update={"bearing": 0.0, "centre": (-15.0, -12.0)}),), light=Light()),
            guard="squares of at least 1e-7, planes met at 1e-9 or more (boat/hull.glsl)",
            without="nothing on llvmpipe: no ray of the frame is along an axis to its last bit",
            camera=Camera(position=(0.0, 0.7, 0.0), pitch=0.0, fov=0.6),
        ),
    ),
)
