"""Boats that float on the drawn surface, traced in the fragment shader. docs/formulae.md, section 15."""

import math

from seafoam.effects.bounds import surface_top, surface_trough
from seafoam.effects.effect import (
    ABOVE,
    Contribution,
    Effect,
    Knob,
    PassSpec,
    Piece,
    SlotRef,
    Source,
    constant_function,
)
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shore.shore import FIND_LAND
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
    significant,
)
from seafoam.quality import Quality
from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene

BOW, QUARTER, BEAM = 0.36, 0.3, 0.1
"""Hull points, in lengths: one so far ahead of the middle, two so far behind it and so far to each side."""
STEM = 0.42
"""The bow at the water line, ahead of the middle, in lengths."""
DRAUGHT = 0.08
"""Keel under the water line, in lengths."""
FAR = 1e8
"""Courses are held so far from the eye, m: no picture reaches there."""

COURSE = "boats/hull/course.glsl"
TRACE = (COURSE, "boats/hull/hull.glsl", "boats/hull/trace.glsl")
LIGHT = ("lib/refraction.glsl", *ILLUMINATION, "boats/hull/light.glsl")


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
    return (SlotRef("sky"), "boats/hull/dark.glsl") if scene.light is None else (SlotRef("sky"), *LIGHT)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any boat."""
    boats = scene.boats
    if not boats:
        return None
    count = len(boats)
    ashore = scene.shore is not None
    motors = sum(boat.kind == "motor" for boat in boats)
    kinds = [f"{n} {name}" for n, name in ((count - motors, "under sail"), (motors, "under power")) if n]
    pose = PassSpec(
        name="how boats float",
        program="boat_pose",
        fragment=(
            "lib/numbers.glsl",
            SlotRef("waves"),
            COURSE,
            "boats/hull/aground.glsl" if ashore else "boats/hull/afloat.glsl",
            "boats/hull/pose_pass.glsl",
        ),
        target="boat_pose",
    )
    seen = (
        "lib/numbers.glsl",
        "lib/camera.glsl",
        "lib/place.glsl",
        SlotRef("waves"),
        SlotRef("find"),
        *TRACE,
        *shade_files(scene),
        *(
            (
                *FIND_LAND,
                "boats/hull/land.glsl",
            )
            if ashore
            else (constant_function("bool", "boat_behind_land", "vec3 ray, float farthest", "false"),)
        ),
    )
    over = Source(
        "boats/hull/over.glsl",
        (
            ("boat_hidden", "boat_hidden_over"),
            ("boat_before", "boat_before_over"),
        ),
    )
    under = (over, "light/shade/optics.glsl", SlotRef("ceiling"), WATER, SlotRef("reach"), "boats/hull/under.glsl")
    swing = max(surface_top(scene), -surface_trough(scene))
    picture = PassSpec(
        name="boats",
        program="boat",
        fragment=(*seen, "boats/hull/over.glsl", "boats/hull/main.glsl"),
        under=() if scene.light is None else (*seen, *under, "boats/hull/main.glsl"),
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
            "u_boat_hull": _each([boat.hull for boat in boats]),
            "u_boat_sails": _each([boat.sails for boat in boats]),
        },
        inputs={"u_boat_pose": TargetInput(target="boat_pose")},
        targets={"boat_pose": Target(size=FixedSize(width=count, height=1), format="RGBA32F")},
        passes=(pose, picture),
    )


_VIEW = Camera(position=(0.0, 3.0, 12.0), pitch=-0.12)

EFFECT = Effect(
    "boats",
    contribute,
    knobs=(
        Knob("/boat_samples", "rays per sample at boats", (1, 4, 9), "filtering"),
        Knob("/boat_readings", "heights read around each hull point", (1, 7), "geometry"),
    ),
)
