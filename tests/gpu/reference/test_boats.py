"""Boats: how they float, their hulls, wakes and mirror against float64 (docs/boats.md)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.boats import boat as effect
from seafoam.effects.boats.wake import ASIDE
from seafoam.effects.effect import Inline
from seafoam.framegraph.visibility import everywhere
from seafoam.ocean.wakes import Wake, wake_height, wake_slope
from seafoam.planner import FramePlan, make_plan
from seafoam.planner.glsl import assemble
from seafoam.quality import TIERS, Quality
from seafoam.reference import render
from seafoam.reference.boats import boat as reference
from seafoam.reference.boats import floating
from seafoam.reference.boats import wake as wakes_of
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect as surfaces
from seafoam.reference.renderer.shade import Shader
from seafoam.render.gl.executor import Executor
from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.rings import Ring
from seafoam.scene.shore import Shore
from seafoam.scene.water import Water
from seafoam.scene.waves import ParametricWave, Sea
from support.exact import EXACT, UNFILTERED
from support.probe import WHOLE, Probe
from support.report import Report

SKYWARD = Camera(position=(3.0, 8.0, -4.0), pitch=1.57, fov=0.01)
WATER_LINE = 5e-3
"""The water line is so near the drawn surface under the hull points, m."""
SEAS = {
    "parametric": Scene(
        waves=(
            ParametricWave(amplitude=0.8, wavelength=9.0, direction=0.7, exponent=2.0),
            ParametricWave(amplitude=0.3, wavelength=3.1, direction=2.0, exponent=4.0),
        )
    ),
    "storm": Scene(sea=Sea(wind=22.0, fetch=2.5e5, seed=9)),
    "gerstner": Scene(sea=Sea(model="gerstner", wind=9.0)),
    "rings": Scene(rings=(Ring(place=(0.0, -20.0), amplitude=0.5, decay=0.1),)),
    "shore": Scene(
        shore=Shore(kind="island", place=(60.0, -10.0), size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)
    ),
    "level": Scene(),
}
BOATS = (
    Boat(centre=(0.0, -30.0), radius=25.0, bearing=1.2, speed=3.0, smoothing=0.0, length=9.0),
    Boat(
        centre=(10.0, -30.0),
        radius=40.0,
        bearing=-2.1,
        speed=5.0,
        smoothing=0.0,
        length=16.0,
        kind="motor",
        turn="port",
    ),
)


def poses(executor: Executor, plan: FramePlan, time: float, camera: Camera) -> NDArray[np.float64]:
    """What the pass wrote: height amidships and the slopes of each boat, (n, 3)."""
    executor.render(everywhere(plan), time=time, camera=camera, width=16, height=9, output="samples")
    target = plan.targets["boat_pose"]
    raw = executor._target("boat_pose", target, 16, 9)[0].read(components=4, dtype="f4")
    return np.frombuffer(raw, np.float32).reshape(-1, 4)[:, :3].astype(np.float64)


def drawn_heights(
    executor: Executor, plan: FramePlan, time: float, camera: Camera, places: list[tuple[float, float]]
) -> NDArray[np.float64]:
    """Heights of the surface at places from the eye, by the program that draws it: its ``main`` alone is another."""
    shader = plan.programs["surface"].fragment
    table = ", ".join(f"vec2({x:.9g}, {z:.9g})" for x, z in places)
    text = shader.text.replace("void main() {", "void drawn() {") + (
        f"\nvoid main() {{\n    vec2 at[{len(places)}] = vec2[{len(places)}]({table});\n"
        f"    o_color = vec4(waves(at[min(int(gl_FragCoord.x), {len(places) - 1})]).x);\n}}\n"
    )
    changed = plan.programs["surface"].model_copy(
        update={
            "vertex": WHOLE,
            "fragment": shader.model_copy(update={"text": text, "sha256": assemble([Inline(text)], {}).sha256}),
        }
    )
    # Drawn for any eye, whether crests may cover it or not.
    other = everywhere(plan).model_copy(update={"programs": {**plan.programs, "surface": changed}, "top": -1e9})
    seen = executor.render(other, time=time, camera=camera, width=len(places), height=1, output="samples")
    return seen.pixels[0, :, 0].astype(np.float64)


def water_lines(
    scene: Scene, found: NDArray[np.float64], time: float, camera: Camera
) -> tuple[list[tuple[float, float]], NDArray[np.float64]]:
    """Every boat's hull points, m from the eye, and its water line's height there."""
    origin = (camera.position[0], camera.position[2])
    places, heights = [], []
    for boat, (middle, slope_x, slope_z) in zip(scene.boats, found, strict=True):
        at = floating.course(boat, time, origin)
        for x, z in floating.hull_points(boat, at):
            places.append((x, z))
            heights.append(middle + slope_x * (x - at.place[0]) + slope_z * (z - at.place[1]))
    return places, np.array(heights)


@pytest.mark.parametrize("sea", SEAS)
def test_the_water_line_lies_on_the_drawn_surface(executor: Executor, report: Report, sea: str) -> None:
    """Without smoothing, at every hull point, at any time and place, at every quality."""
    worst = {}
    scene = SEAS[sea].model_copy(update={"boats": BOATS})
    for tier, base in TIERS.items():
        surface = base.surface.model_copy(update={"method": "march"})
        plan = make_plan(scene, base.model_copy(update={"surface": surface, "target": "RGBA32F", "samples": 1}))
        off = 0.0
        for time in (2.7, 1000003.5):
            places, lines = water_lines(scene, poses(executor, plan, time, SKYWARD), time, SKYWARD)
            off = max(off, np.abs(drawn_heights(executor, plan, time, SKYWARD, places) - lines).max())
        worst[tier] = off
    report.add(
        "Water line over the drawn surface under hull points, smoothing 0, 2 boats, 2 times",
        sea=sea,
        **{tier: f"{1000 * off:.3f} mm" for tier, off in worst.items()},
    )
    assert max(worst.values()) <= WATER_LINE


@pytest.mark.parametrize("sea", ["parametric", "storm", "rings", "level"])
@pytest.mark.parametrize("smoothing", [0.0, 2.0])
def test_boats_float_as_in_float64(executor: Executor, report: Report, sea: str, smoothing: float) -> None:
    """Against the float64 surface, and its mean over discs: height, pitch and roll together, at the hull points."""
    boats = tuple(boat.model_copy(update={"smoothing": smoothing}) for boat in BOATS)
    scene = SEAS[sea].model_copy(update={"boats": boats})
    plan = make_plan(scene, EXACT)
    off = 0.0
    for time in (1000003.5,) if scene.sea else (0.0, 1000003.5):
        found = poses(executor, plan, time, SKYWARD)
        places, lines = water_lines(scene, found, time, SKYWARD)
        shader = Shader(scene, time, cameras.view(SKYWARD, 16, 9), 16, 9, 1, "same-samples", None)
        want = [floating.felt(shader.relief.height, place, smoothing) for place in places]
        off = max(off, float(np.abs(lines - np.array(want)).max()))
    report.add(
        "Water line against the float64 surface, reference quality",
        sea=sea,
        smoothing=f"{smoothing:g} m",
        worst=f"{1000 * off:.3f} mm",
    )
    assert off <= WATER_LINE


def test_smoothing_is_the_mean_over_a_disc() -> None:
    """Radon's seven points against 2 J1(kR)/(kR), the mean of a wave over a disc: exact to the fifth degree."""
    for k_r, allowed in ((0.5, 1e-5), (1.0, 4e-4), (2.0, 0.03)):
        reach = 1.5
        k = k_r / reach
        turns = np.linspace(0.0, math.pi, 20001)
        bessel = np.trapezoid(np.cos(turns - k_r * np.sin(turns)), turns) / math.pi
        for heading in (0.0, 0.3, 0.5):
            wave = floating.felt(
                lambda x, z, h=heading, n=k: np.cos(n * (x * math.cos(h) + z * math.sin(h))), (0.0, 0.0), reach
            )
            assert abs(wave - 2.0 * bessel / k_r) <= allowed


def rays(seed: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """A place round a boat, as near as every ray is brought first, and directions past it."""
    rng = np.random.default_rng(seed)
    angle, height, far = rng.uniform(0.0, 2.0 * math.pi), rng.uniform(-0.3, 1.2), rng.uniform(0.7, 0.9)
    eye = np.array([far * math.cos(angle), height, far * math.sin(angle)])
    toward = rng.uniform((-0.5, -0.1, -0.2), (0.5, 1.1, 0.2), (count, 3))
    d = toward - eye
    return np.float64(np.float32(eye)), (d / np.linalg.norm(d, axis=1)[:, None]).astype(np.float32)


@pytest.mark.parametrize("kind", ["sail", "motor"])
def test_hulls_equal_their_float64_form(probe: Probe, report: Report, kind: str) -> None:
    """Where rays meet a boat, with which normal, and what part of it."""
    boat = Boat(kind=kind, boom=0.5)  # type: ignore[arg-type]
    motor = "true" if kind == "motor" else "false"
    body = (
        "BoatHit hit = BoatHit(1e9, vec3(0.0), vec3(0.0), PART_HULL);\n"
        f"hit_boat(u_eye, x.xyz, {motor}, u_rig, 0.0, hit);\n"
        "y = vec4(min(hit.t, 1e3), hit.normal.xy, float(hit.part));"
    )
    apart, worst, off, met = 0, 0.0, 0.0, 0
    for seed in range(12):
        eye, d = rays(seed, 4000)
        got = probe(
            (Inline("uniform vec3 u_eye;\nuniform vec2 u_rig;\n"), "boats/hull/hull.glsl"),
            body,
            d,
            consts={"BOAT_SAILS": True, "BOAT_MOTORS": True},
            uniforms={"u_eye": eye, "u_rig": (math.cos(boat.boom), math.sin(boat.boom))},
        ).astype(np.float64)
        want = reference._Boat(np.repeat(eye[None], len(d), 0), d.astype(np.float64), np.zeros(len(d)), boat)
        same = (got[:, 0] < 999.0) == np.isfinite(want.t)
        both = same & np.isfinite(want.t)
        near = np.abs(got[:, 0] - np.where(both, want.t, 0.0)) <= 1e-3
        agree = both & near & (got[:, 3] == want.part)
        apart += int(np.count_nonzero(~same | (both & ~agree)))
        met += int(np.count_nonzero(both))
        # At a skim, and where a side curls under, digits are lost to the root.
        worst = max(worst, float(np.quantile(np.abs(got[agree, 0] - want.t[agree]), 0.99)))
        off = max(off, float(np.quantile(np.abs(got[agree, 1:3] - want.normal[agree][:, :2]).max(axis=1), 0.99)))
    report.add(
        "Hulls against float64, 48 000 rays, in boat's lengths",
        kind=kind,
        met=str(met),
        other_part=f"{apart}",
        way=f"{worst:.1e}",
        normal=f"{off:.1e}",
    )
    assert met > 5000
    # Rays along an edge may meet either side of it.
    assert apart <= 24
    assert worst <= 2e-4
    assert off <= 5e-3


WAKES = (
    Boat(),
    Boat(speed=6.0, length=15.0, radius=200.0, wake=0.4),
    Boat(speed=2.0, length=4.0, radius=10.0, turn="port"),
    Boat(speed=20.0, length=5.0, radius=500.0),
)


def around(boat: Boat, seed: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places over a boat's wake at time 0, and beside it."""
    rng = np.random.default_rng(seed)
    wake, at = Wake(boat), floating.course(boat, 0.0, (0.0, 0.0))
    angle = at.bearing - at.turn * (rng.random(count) * 1.2 * wake.length / boat.radius - 0.05)
    far = boat.radius + rng.uniform(-1.0, 1.0, count) * min(0.45 * boat.radius, ASIDE * wake.length)
    return boat.centre[0] + far * np.cos(angle), boat.centre[1] + far * np.sin(angle)


@pytest.mark.parametrize("boat", WAKES, ids=lambda boat: f"{boat.speed:g} m/s")
def test_wakes_stay_within_their_bounds_and_slope_as_they_rise(boat: Boat) -> None:
    x, z = around(boat, 1, 40000)
    wake = wakes_of.wake_set(Scene(boats=(boat,)), 0.0, (0.0, 0.0))
    height, slope, step = wake.height(x, z), wake.gradient(x, z), 1e-6
    assert np.ptp(height) > 0.3 * boat.wake
    assert (np.abs(height) <= wake_height((boat,))).all()
    assert np.hypot(*slope).max() <= wake_slope((boat,))
    numeric = (
        (wake.height(x + step, z) - wake.height(x - step, z)) / (2.0 * step),
        (wake.height(x, z + step) - wake.height(x, z - step)) / (2.0 * step),
    )
    assert max(float(np.abs(a - b).max()) for a, b in zip(slope, numeric, strict=True)) < 1e-6


def test_a_wake_is_kelvins() -> None:
    """Waves across run as fast as the boat: behind it they stand 2 pi v^2/g apart; all lie inside 19.47 degrees."""
    boat = Boat(speed=4.0, length=3.0, radius=2000.0)
    wake = Wake(boat)
    x = np.linspace(3.0 * wake.wavelength, 5.0 * wake.wavelength, 4001)
    height = wakes_of.pattern(wake, x, np.zeros_like(x))[0]
    crests = x[1:-1][(height[1:-1] > height[:-2]) & (height[1:-1] > height[2:])]
    assert np.diff(crests) == pytest.approx(2.0 * math.pi * 16.0 / 9.81, rel=0.01)
    outside = wakes_of.pattern(wake, x, x * math.tan(math.asin(1.0 / 3.0)) * 1.0001)[0]
    assert (outside == 0.0).all()


def test_wakes_equal_their_float64_form(probe: Probe, report: Report) -> None:
    for boat in WAKES:
        wake = Wake(boat)
        rng = np.random.default_rng(5)
        at = (rng.random((20000, 2)) * (1.05 * wake.length, 1.1 * ASIDE * wake.length)).astype(np.float32)
        at[:100, 1] = 0.0
        got = probe(
            ("lib/numbers.glsl", Inline("uniform vec4 u_wake;\nuniform vec2 u_form;\n"), "boats/wake/pattern.glsl"),
            "y = wake_pattern(x.xy, u_wake, u_form.x, u_form.y);",
            at,
            uniforms={
                "u_wake": (wake.k, boat.wake, wake.length, wake.shortest),
                "u_form": (boat.length, boat.radius),
            },
        ).astype(np.float64)
        want = np.stack(wakes_of.pattern(wake, *at.astype(np.float64).T), axis=-1)
        off = np.abs(got[:, :3] - want).max(axis=0)
        report.add(
            "Wakes against float64, 20 000 places",
            speed=f"{boat.speed:g} m/s",
            height=f"{1e6 * off[0]:.1f} µm of {boat.wake:g} m",
            slope=f"{1e6 * off[1:].max():.1f} millionths of {wake_slope((boat,)):.2f}",
        )
        assert np.isfinite(got).all()
        assert off[0] <= 2e-4 * boat.wake
        assert off[1:].max() <= 1e-3


def picture(
    executor: Executor, scene: Scene, time: float = 0.0, size: tuple[int, int] = (160, 90), **knobs: object
) -> NDArray[np.float64]:
    quality = UNFILTERED.model_copy(update={"samples": 1, **knobs})
    plan = make_plan(scene, Quality.model_validate(quality.model_dump()))
    seen = executor.render(plan, time=time, camera=scene.camera, width=size[0], height=size[1], output="samples")
    return np.clip(seen.pixels[..., :3].astype(np.float64), 0.0, 1.0)


def rmse(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    return float(255.0 * np.sqrt(np.mean((a - b) ** 2)))


MIRRORED = Scene(
    boats=(
        Boat(centre=(0.0, -40.0), radius=20.0, bearing=1.7, speed=0.0, heel=0.15),
        Boat(centre=(-30.0, -30.0), radius=20.0, bearing=0.3, speed=0.0, kind="motor", length=11.0),
    ),
    light=Light(reflection="planar", sun_elevation=0.5, sun_azimuth=2.4, exposure=-1.2),
    camera=Camera(position=(0.0, 3.0, 0.0), pitch=-0.12, fov=0.7),
)
SIZES = (64, 128, 256, 512, 1024)


def test_the_planar_mirror_is_the_traced_one(executor: Executor, report: Report) -> None:
    """Still water: the map against rays from the water in float64; its error falls as the map grows."""
    truth = np.clip(render(MIRRORED, time=0.0, width=160, height=90).rgb, 0.0, 1.0)
    traced = 255.0 * float(np.abs(picture(executor, MIRRORED) - truth).mean())
    blind = MIRRORED.model_copy(update={"light": MIRRORED.light.model_copy(update={"reflection": "sky"})})  # type: ignore[union-attr]
    without = 255.0 * float(np.abs(picture(executor, blind) - truth).mean())
    maps = [picture(executor, MIRRORED, reflection="map", reflection_size=size) for size in SIZES]
    errors = [255.0 * float(np.abs(one - truth).mean()) for one in maps]
    order = -np.polyfit(np.log2(SIZES), np.log2(errors), 1)[0]
    report.add(
        "Planar mirror against a float64 ray trace, still water, 160 × 90, mean error in levels",
        **{f"{size}": f"{error:.3f}" for size, error in zip(SIZES, errors, strict=True)},
        order=f"{order:.2f}",
        traced=f"{traced:.3f}",
        sky_alone=f"{without:.3f}",
    )
    assert traced < 0.05
    assert without > 1.0
    assert errors[-1] < 0.1 * without
    # Edges of boats are a texel wide: order 1.
    assert order > 0.6
    assert all(b < a for a, b in zip(errors, errors[2:], strict=False))


def test_ripples_perturb_the_mirror(executor: Executor, report: Report) -> None:
    """On waves the map knows only what the mirrored eye sees: it errs, and less than a mirror of the sky alone."""
    scene = MIRRORED.model_copy(
        update={
            "waves": (ParametricWave(amplitude=0.12, wavelength=5.0, direction=1.1),),
            "camera": MIRRORED.camera.model_copy(update={"position": (0.0, 3.1, 0.0)}),
        }
    )
    truth = np.clip(render(scene, time=0.0, width=160, height=90).rgb, 0.0, 1.0)
    blind = scene.model_copy(update={"light": scene.light.model_copy(update={"reflection": "sky"})})  # type: ignore[union-attr]
    errors = {
        "map": rmse(picture(executor, scene, reflection="map", reflection_size=1024), truth),
        "traced": rmse(picture(executor, scene), truth),
        "sky alone": rmse(picture(executor, blind), truth),
    }
    report.add(
        "Planar mirror on waves of 12 cm against a float64 ray trace, 160 × 90, RMSE in levels",
        **{name: f"{error:.3f}" for name, error in errors.items()},
    )
    assert errors["traced"] < 1.5
    assert errors["map"] < 0.6 * errors["sky alone"]


def test_a_boat_stands_before_what_is_behind_it_and_behind_what_is_before_it(executor: Executor) -> None:
    """Low over crests that hide half of it: no sample of water before the boat is any other for it."""
    scene = Scene(
        waves=(ParametricWave(amplitude=1.6, wavelength=14.0, direction=1.4, exponent=2.0),),
        boats=(Boat(centre=(0.0, -45.0), radius=20.0, bearing=1.6, speed=0.0, wake=0.0, kind="motor", length=10.0),),
        camera=Camera(position=(0.0, 1.9, 0.0), pitch=0.0, fov=0.5),
    )
    bare = scene.model_copy(update={"boats": ()})
    truth = render(scene, time=0.0, width=160, height=90)
    shader = Shader(scene, 0.0, cameras.view(scene.camera, 160, 90), 160, 90, 1, "same-samples", None)
    assert shader.fleet is not None
    down, along = np.mgrid[0:90, 0:160]
    X, Y = 2.0 * (along.ravel() + 0.5) / 160 - 1.0, 1.0 - 2.0 * (down.ravel() + 0.5) / 90
    D = cameras.rays(shader.view, X, Y)
    d = D / np.linalg.norm(D, axis=1)[:, None]
    water = surfaces.first_crossing(shader.relief, shader.eye_y, d)
    boat = shader.fleet.trace(np.array([0.0, shader.eye_y, 0.0]), d).t
    hidden = (np.isfinite(boat) & (water < boat)).reshape(90, 160)
    shown = (np.isfinite(boat) & (boat < water)).reshape(90, 160)
    assert hidden.sum() > 100
    assert shown.sum() > 100
    with_it, without = picture(executor, scene), picture(executor, bare)
    assert np.abs(with_it - without)[hidden].max() == 0.0
    assert 255.0 * np.abs(with_it - np.clip(truth.rgb, 0.0, 1.0))[shown].mean() < 0.5


OVERLAPPING = Scene(
    waves=(
        ParametricWave(amplitude=1.2, wavelength=9.0, direction=1.35, exponent=2.5),
        ParametricWave(amplitude=0.7, wavelength=5.3, direction=1.9, exponent=2.0, phase=1.0),
    ),
    foam=Foam(saturation=(HeightSaturation(base=1.2, full=1.7),), look="halftone"),
    water=Water(depth=6.0),
    light=Light(sun_elevation=0.4, sun_azimuth=-1.5, exposure=-1.5),
    camera=Camera(position=(0.4, 2.1, 0.0), pitch=-0.03, fov=0.7),
)
"""The lake shader blended its water over what was behind it, back faces and all, in the order of its triangles."""


@pytest.mark.parametrize("method", ["march", "mesh"])
def test_no_back_face_and_nothing_behind_a_crest_shows_through(executor: Executor, report: Report, method: str) -> None:
    """Overlapping crests from low over the water: every sample is the first surface alone, mixed by Fresnel."""
    surface = UNFILTERED.surface.model_copy(update={"method": method, "cells": 512})
    quality = UNFILTERED.model_copy(update={"samples": 1, "surface": surface})
    plan = make_plan(OVERLAPPING, quality)
    drawn = [one for one in plan.passes if one.name == "surface"]
    assert {one.state.blend for one in drawn} == {"none"}
    assert all(one.state.depth for one in drawn)
    worst_mean, worst_share = 0.0, 0.0
    for time in (0.0, 0.9, 1.8):
        seen = executor.render(plan, time=time, camera=OVERLAPPING.camera, width=160, height=90, output="samples")
        truth = render(OVERLAPPING, time=time, width=160, height=90)
        away = 255.0 * np.abs(
            np.clip(seen.pixels[..., :3].astype(np.float64), 0.0, 1.0) - np.clip(truth.rgb, 0.0, 1.0)
        ).max(axis=-1)
        worst_mean, worst_share = max(worst_mean, away.mean()), max(worst_share, float((away > 8.0).mean()))
    report.add(
        "Overlapping crests from 0.2 m over them, against float64, 160 × 90",
        method=method,
        mean=f"{worst_mean:.3f} levels",
        over_8=f"{100 * worst_share:.2f} %",
    )
    # On the mesh a silhouette is as fine as its cells.
    assert worst_mean <= (0.3 if method == "march" else 5.0)
    assert worst_share <= (0.005 if method == "march" else 0.06)


def test_no_plan_blends_the_surface() -> None:
    for name in ("lake-choppy", "storm", "boat-race", "boat-in-storm"):
        for tier in TIERS.values():
            plan = make_plan(load_preset(name).scene, tier)
            for one in plan.passes:
                if one.name in ("surface", "sky"):
                    assert one.state.blend == "none"
                    assert one.state.depth


def test_boats_bring_nothing_to_a_scene_without_them() -> None:
    plan = make_plan(load_preset("default").scene, TIERS["standard"]).canonical_json().decode()
    assert "boat" not in plan
    assert "wake" not in plan
    assert "mirror_" not in plan


def test_a_wider_boat_than_its_circle_is_refused() -> None:
    with pytest.raises(ValueError, match="radius"):
        Boat(length=20.0, radius=10.0)


def test_the_pose_is_as_small_as_the_fleet() -> None:
    plan = make_plan(Scene(boats=BOATS), TIERS["standard"])
    assert plan.targets["boat_pose"].size.width == len(BOATS)  # type: ignore[union-attr]
    assert effect.EFFECT.knobs
