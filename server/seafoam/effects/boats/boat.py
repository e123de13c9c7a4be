"""Boats that float on the drawn surface, traced in the fragment shader; their shadows. docs/formulae.md, section 15."""

import math

from seafoam.effects import effect
from seafoam.effects.bounds import max_displacement
from seafoam.effects.effect import ABOVE, Contribution, PassSpec, QualityParameter, Resources, drawn_map
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, PLACE, Const, Piece, SlotFile, SlotRef, constant_function
from seafoam.effects.shore.maps import FIND_LAND
from seafoam.effects.water.water import WATER
from seafoam.framegraph.plan import BoundingSphere, Quads
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Constant, Phase, Rule, Uniform, array, constants, significant, to_camera
from seafoam.quality import Quality
from seafoam.scene import Boat, Scene

BOW, QUARTER, BEAM = 0.36, 0.3, 0.1
"""Places of the hull points, in boat lengths: one ahead of the middle, two behind it and to each side."""
STEM = 0.42
"""Distance of the bow at the water line from the middle, in boat lengths."""
DRAUGHT = 0.08
"""Depth of the keel below the water line, in boat lengths."""
HULLS: dict[str, tuple[float, float, float]] = {"sail": (0.15, 4.63, 0.1), "motor": (0.17, 2.515, 0.15)}
"""Half breadth amidships, its fall with the square of the distance from the height of the greatest breadth, and that
height, in boat lengths, as in ``boats/hull.glsl@hull``."""
UNDER_SAIL = 0.25
"""Share of the sunlight that a sail transmits."""
COURSE = "boats/pose.glsl@course"
FRAME = "boats/hull.glsl@frame"
TRACE = (COURSE, "boats/hull.glsl@hull", FRAME, "boats/hull.glsl@trace")
_MET = "boats/drawn.glsl@met"
LIGHT = ("lib/refraction.glsl", *ILLUMINATION, _MET, "boats/drawn.glsl@meet", "boats/drawn.glsl@light")


def _draw(scene: Scene, boats: tuple[Boat, ...], quality: Quality) -> Contribution:
    rigs = [(1.0 if boat.kind == "motor" else 0.0, *_direction(boat.boom)) for boat in boats]
    motors = len([boat for boat in boats if boat.kind == "motor"])
    kinds = [f"{n} {name}" for n, name in ((len(boats) - motors, "under sail"), (motors, "under power")) if n]
    return Contribution(
        why=f"boats: {', '.join(kinds)}",
        consts={**_consts(boats, quality), "BOAT_ALIKE": quality.samples == 1},
        chosen_consts={"BOAT_ALIKE": False},
        uniforms={
            "u_boat_course": _courses(boats),
            "u_boat_form": constants("vec4", [(boat.length, boat.smoothing, *_direction(boat.heel)) for boat in boats]),
            "u_boat_rig": constants("vec3", rigs),
            "u_boat_hull": constants("vec3", [boat.hull for boat in boats]),
            "u_boat_sails": constants("vec3", [boat.sails for boat in boats]),
        },
    ).joined(_pose(scene), Resources(passes=(_picture_pass(scene),)))


def shade_files(scene: Scene) -> tuple[Piece | SlotRef, ...]:
    if scene.light is None:
        return SlotRef("sky"), _MET, "boats/drawn.glsl@meet_dark", "boats/drawn.glsl@dark"
    return SlotRef("sky"), SlotRef("open sun"), *LIGHT


def _consts(boats: tuple[Boat, ...], quality: Quality) -> dict[str, Const]:
    return {
        "BOAT_COUNT": len(boats),
        "BOAT_SAILS": any(boat.kind == "sail" for boat in boats),
        "BOAT_MOTORS": any(boat.kind == "motor" for boat in boats),
        "BOAT_SIDE": math.isqrt(quality.boat_samples),
        "BOAT_READINGS": quality.boat_readings,
        "BOAT_BOW": BOW,
        "BOAT_QUARTER": QUARTER,
        "BOAT_BEAM": BEAM,
        "BOAT_STEM": STEM,
        "BOAT_DRAUGHT": DRAUGHT,
    }


def _courses(boats: tuple[Boat, ...]) -> Uniform:
    """Of each boat: vector from the centre of its course to the camera (m), bearing on it (rad), signed radius (m)."""
    rules: list[Rule] = []
    for boat in boats:
        turn = 1.0 if boat.turn == "starboard" else -1.0
        bearing = Phase(offset=boat.bearing, rate=turn * boat.speed / boat.radius, k=(0.0, 0.0))
        rules += [*to_camera(*boat.centre), bearing, Constant(value=(turn * boat.radius,))]
    return array("vec4", rules, len(boats))


def _direction(angle: float) -> tuple[float, float]:
    return significant(math.cos(angle)), significant(math.sin(angle))


def _pose(scene: Scene) -> Resources:
    """Height and slope of each boat's water line, from the drawn surface around its hull points, and its axes."""
    support = "boats/pose.glsl@afloat" if scene.shore is None else "boats/pose.glsl@aground"
    files = ("lib/numbers.glsl", SlotRef("waves"), COURSE, support, "boats/pose.glsl@pass")
    target = Target(size=FixedSize(width=len(scene.boats), height=1), format="RGBA32F", layers=3)
    return drawn_map(PassSpec("how boats float", "boat_pose", files), target)


def _picture_pass(scene: Scene) -> PassSpec:
    no_land = constant_function("bool", "boat_behind_land", "vec3 ray, float farthest", "false")
    common: tuple[Piece | SlotRef, ...] = (
        *(*COMMON, PLACE, SlotRef("waves"), SlotRef("find"), *TRACE),
        *shade_files(scene),
        *((no_land,) if scene.shore is None else (*FIND_LAND, "boats/drawn.glsl@land")),
    )
    under = ("light/shade.glsl@optics", SlotRef("underside"), WATER, SlotRef("reach"), "boats/drawn.glsl@under")
    swing = max_displacement(scene)
    return PassSpec(
        "boats",
        "boat",
        (*common, "boats/drawn.glsl@over", "boats/drawn.glsl@main"),
        under=() if scene.light is None else (*common, *under, "boats/drawn.glsl@main"),
        vertex=(*COMMON, COURSE, FRAME, "vertex/vertex.glsl@quad", "boats/drawn.glsl@vertex"),
        mesh=Quads(count=1),
        target=ABOVE,
        stage="after",
        blend="over",
        # Boats on land stand higher than these spheres reach.
        view="any" if scene.shore is not None else tuple(_bounding_sphere(boat, swing) for boat in scene.boats),
    )


def _bounding_sphere(boat: Boat, swing: float) -> BoundingSphere:
    """Sphere around a boat anywhere on its course. ``swing``: greatest distance of the water surface from 0, m."""
    x, z = boat.centre
    course = boat.radius
    if boat.speed == 0.0:
        x, z = x + course * math.cos(boat.bearing), z + course * math.sin(boat.bearing)
        course = 0.0
    # Shaders search within 0.9 lengths of a point 0.4 lengths above the middle of the hull.
    return BoundingSphere(centre=(x, 0.0, z), radius=significant(1.001 * (course + 1.3 * boat.length + swing) + 0.1))


def _shadows(scene: Scene, boats: tuple[Boat, ...], quality: Quality) -> Contribution | None:
    if scene.light is None or not quality.boat_shadows:
        return None
    return Contribution(
        why="rays to the sun from the water around boats",
        slots=(SlotFile("sunlight", "boats/drawn.glsl@shadow", needs=TRACE),),
        consts={"SUN_UNDER_SAIL": UNDER_SAIL},
    )


EFFECT = effect.part_effect(
    "boats",
    _draw,
    "/boats",
    QualityParameter("/boat_samples", "rays per sample at boats", (1, 4, 9), "filtering"),
    QualityParameter("/boat_readings", "heights read around each hull point", (1, 7), "geometry"),
)
SHADOWS = effect.part_effect(
    "boat shadows",
    _shadows,
    "/boats",
    QualityParameter("/boat_shadows", "shadows of boats on the water", (False, True), "geometry"),
)
