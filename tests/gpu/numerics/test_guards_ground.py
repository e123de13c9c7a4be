"""Guards on land, floors and mirrors that hard cases name and whose pictures cannot show here that they guard."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.shader import Inline
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.textures.shore import FRONT, shore_profiles
from support.exact import EXACT
from support.hard.guarded import Guarded
from support.pictures import draw_target, samples
from support.probe import Probe, stand_in
from support.scenes import Boat, Camera, Caustics, Light, ParametricWave, Ripples, Scene, Shore, Surf, Water
from support.scenes.coasts import map_of, on_shore

RAYS = ("lib/numbers.glsl", "lib/rays.glsl@camera", "lib/texels.glsl@texel")


SPAN = ("shore/ground.glsl@square",)
SIDE = {"u_shore_size": 160.0}
GUARDED = (
    Guarded("span along the square's edge", SPAN, "y.xy = shore_span(x.xy, x.zw);", ((-80, 0, 0, 1), (0, 80)), SIDE),
    Guarded("span from inside", SPAN, "y.xy = shore_span(x.xy, x.zw);", ((10, 0, 1, 0.5), (0, 70)), SIDE),
    Guarded(
        "glow over still water",
        (
            *RAYS,
            Inline("uniform vec3 u_sun_direction;\n"),
            "light/shade.glsl@optics",
            "light/shade.glsl@irradiance",
            "water/underside.glsl@water",
        ),
        "vec3 level = below_glow(0.0, x.y, x.z);\ny.x = below_glow(x.x, x.y, x.z).r / level.r;",
        ((-1.0, 1.0, 5.0), (1.0, 0.0)),
        {"u_absorption_length": [0.01] * 3, "u_scattering": 0.5, "u_sky_irradiance": [1.0] * 3},
    ),
    Guarded(
        "way through ripples that face the eye",
        (*RAYS, "lib/refraction.glsl", stand_in("deep"), "shore/floor.glsl@body", "shore/floor.glsl@through"),
        "vec2 at;\ny.x = floor_path(vec2(0.0), 0.0, normalize(vec3(1.0, -0.01, 0.0)), normalize(x.xyz), at);",
        ((-3.0, 1.0, 0.0), (10.0, 0.0)),
        {"REFRACTION_STEPS": 4},
    ),
    Guarded(
        "search that ends before it starts",
        (*RAYS, stand_in("ground_over"), "shore/land.glsl@find_land"),
        "float tau;\nvec4 ground;\ny.x = find_land(x.xyz, 1e5, tau, ground) ? 1.0 : 0.0;",
        ((2.0, 1.0, 0.0), (0.0, 0.0)),
        {"REFINE": 4},
    ),
    Guarded(
        "texels of a cube",
        (
            *RAYS,
            "lib/texels.glsl@bilinear",
            "lib/texels.glsl@cube_face",
            "reflection/cube.glsl@cube",
            stand_in("counted_texels"),
            "reflection/cube.glsl@cubemap",
        ),
        "reflected_light(vec3(0.0), normalize(x.xyz), vec3(0.0));\ny.x = outside;",
        ((1.0, 1.0, 1.0), (0.0, 0.0)),
        {"CUBE_SIZE": 8},
    ),
    # The map of heights is the probe's own texel of inputs.
    Guarded(
        "sun along an axis, beside the square",
        (
            *RAYS,
            Inline("uniform sampler2D u_land_maxima;\nvec2 shore_place(vec2 p) { return p; }\n"),
            "shore/ground.glsl@square",
            "shore/ground.glsl@spline",
            "shore/sunlit.glsl@sunlit",
        ),
        "y.x = land_sunlit(x.xyz, Footprint(vec2(0.0), vec2(0.0)));",
        ((0.0, 5.0, -200.0), (1.0, 0.0)),
        {"LAND_CELLS": 1, "u_land_sun": [1.0, 1e-37, 0.1, 0.09], **SIDE},
    ),
    # The map is the probe's own texel of inputs, whose last number is its coverage.
    Guarded(
        "mirror of what is behind",
        (*RAYS, stand_in("no_sky"), "reflection/mirror.glsl@planar"),
        "vec3 seen;\nfloat way;\ny.x = mirror_toward(x.xyz, seen, way).a;",
        ((0.0, -2.0, 5.0, 1.0), (0.0, 0.0)),
        {
            "MIRROR_SIZE": 1,
            "MIRROR_MARGIN": 1.25,
            "MIRROR_STEPS": 1,
            "MIRROR_LOOKS": 0,
            "MIRROR_FAR": 0.0,
            "u_eye_height": 2.0,
            "u_ray_x": [1, 0, 0],
            "u_ray_y": [0, 1, 0],
            "u_ray_z": [0, 0, -1],
        },
    ),
)


@pytest.mark.whole
@pytest.mark.parametrize("one", [pytest.param(one, id=one.name) for one in GUARDED])
def test_functions_are_guarded(probe: Probe, one: Guarded) -> None:
    one.check(probe)


@pytest.mark.parametrize(("name", "end"), [("roughness", "minimum"), ("absorption_length", "maximum")])
def test_water_at_the_ends_of_its_fields(executor: Executor, name: str, end: str) -> None:
    found = Water.model_json_schema()["properties"][name]
    value = [part[end] for part in found["prefixItems"]] if "prefixItems" in found else found[end]
    water = Water.model_validate({"scattering": 0.0, name: value})
    camera = Camera(position=(0.0, 0.5, 0.0), pitch=0.0)
    got = samples(executor, Scene(water=water), EXACT, camera, time=0.0, size=(48, 27))
    assert np.isfinite(got).all()
    assert got.max() < 6e4


def test_a_grid_is_no_brighter_in_a_focus_than_photons(executor: Executor) -> None:
    scene = Scene(
        water=Water(depth=4.0, ripples=Ripples(slope=0.08)),
        light=Light(sun_elevation=1.0, caustics=Caustics(dispersion=0.0)),
    )
    kinds = {"grid": TIERS["standard"], "photons": EXACT}
    brightest = {
        kind: draw_target(executor, make_plan(scene, quality), "caustics", 2.0)[..., :3].max()
        for kind, quality in kinds.items()
    }
    assert brightest["grid"] < 1.5 * brightest["photons"]


def test_a_shore_without_surf_has_a_finite_map(executor: Executor) -> None:
    shore = Shore(size=160.0, radius=25.0, depth=0.5, height=0.1, slope=0.01, smoothing=3.0, surf=Surf(height=0.0))
    assert np.isfinite(map_of(executor, make_plan(Scene(shore=shore), EXACT), "shore_map")).all()


def test_fronts_are_no_steeper_than_a_smoothed_step() -> None:
    nodes = 256
    profiles = shore_profiles(nodes, 0.0, 0.15).astype(np.float64)
    steepest = nodes * np.abs(np.roll(profiles, -1, axis=1) - profiles).max()
    assert steepest <= 1.0 / (math.sqrt(2.0 * math.pi) * FRONT)


@pytest.mark.parametrize(("elevation", "away"), [(0.004, 2e4), (0.05, 2e3)])
def test_shadows_of_land_end(executor: Executor, elevation: float, away: float) -> None:
    """At a distance down the sun from an island 14 m high, beyond its square."""
    light = Light(sun_elevation=elevation, sun_azimuth=0.0)
    shore = Shore(kind="island", size=160.0, radius=25.0, height=14.0, slope=0.3, shadows=True)
    x, _, z = lamp(light)

    def lit(metres: float) -> float:
        place = f"vec3({-metres * x:.3f}, 0.0, {-metres * z:.3f})"
        body = f"o_color = vec4(sunlit({place}, Footprint(vec2(0.0), vec2(0.0))), 0.0, 0.0, 0.0);"
        return float(on_shore(executor, Scene(shore=shore, light=light), body)[0, 0])

    assert lit(100.0) < 0.5
    assert lit(away) == 1.0


def test_an_eye_under_the_mirror_sees_nothing_behind_it(executor: Executor) -> None:
    scene = Scene(
        light=Light(reflection="planar"),
        boats=(Boat(centre=(0.0, -1.0), radius=15.0, bearing=1.6, speed=0.0),),
        waves=(ParametricWave(amplitude=0.8, wavelength=40.0, phase=-1.5708),),
    )

    def mirror(height: float, yaw: float) -> NDArray[np.float32]:
        camera = Camera(position=(0.0, height, 0.0), yaw=yaw, pitch=-0.05)
        return draw_target(executor, make_plan(scene, TIERS["standard"]), "mirror", camera=camera)[..., 3]

    assert mirror(0.5, np.pi).max() > 0.0
    assert mirror(-0.5, 0.0).max() == 0.0
