"""Boats: how they float, their hulls, wakes and mirror, and what stands before what (docs/boats.md)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.boats.wake import ASIDE
from seafoam.effects.shader import Inline
from seafoam.ocean.waves.wakes import Wake
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.reference.boats import boat as reference
from seafoam.reference.boats import wake as wakes_of
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.shade import SampleShader
from seafoam.render.gl.executor import Executor
from support.exact import EXACT, everywhere
from support.pictures import draw, levels, samples
from support.probe import Probe, patched
from support.report import Report
from support.scenes import Boat, Camera, Foam, HeightSaturation, Light, ParametricWave, Ring, Scene, Sea, Shore, Water
from support.scenes.fleet import BOATS, WAKES

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
    "rings": Scene(rings=(Ring(place=(0.0, -20.0), amplitude=0.5, decay=0.1),)),
    "shore": Scene(
        shore=Shore(kind="island", place=(60.0, -10.0), size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)
    ),
}


def poses(executor: Executor, plan: FramePlan, time: float, camera: Camera) -> NDArray[np.float64]:
    """What the pass wrote: height amidships and the slopes of each boat, (n, 3)."""
    draw(executor, everywhere(plan), camera, time=time, size=(16, 9), output="samples")
    target = plan.targets["boat_pose"]
    raw = executor._target("boat_pose", target, 16, 9)[0].read(components=4, dtype="f4")
    return np.frombuffer(raw, np.float32).reshape(-1, 4)[:, :3].astype(np.float64)


def drawn_heights(
    executor: Executor, plan: FramePlan, time: float, camera: Camera, places: list[tuple[float, float]]
) -> NDArray[np.float64]:
    """Heights of the surface at places from the eye, by the program that draws it: its ``main`` alone is another."""
    table = ", ".join(f"vec2({x:.9g}, {z:.9g})" for x, z in places)
    main = (
        f"void main() {{\n    vec2 at[{len(places)}] = vec2[{len(places)}]({table});\n"
        f"    o_color = vec4(waves(at[min(int(gl_FragCoord.x), {len(places) - 1})]).x);\n}}\n"
    )
    seen = draw(executor, patched(plan, main), camera, time=time, size=(len(places), 1), output="samples")
    return seen[0, :, 0].astype(np.float64)


def water_lines(
    scene: Scene, found: NDArray[np.float64], time: float, camera: Camera
) -> tuple[list[tuple[float, float]], NDArray[np.float64]]:
    """Every boat's hull points, m from the eye, and its water line's height there."""
    origin = (camera.position[0], camera.position[2])
    places, heights = [], []
    for boat, (middle, slope_x, slope_z) in zip(scene.boats, found, strict=True):
        at = reference.course_of(boat, time, origin)
        for x, z in reference.hull_points(boat, at):
            places.append((x, z))
            heights.append(middle + slope_x * (x - at.place[0]) + slope_z * (z - at.place[1]))
    return places, np.array(heights)


@pytest.mark.parametrize("sea", SEAS)
def test_the_water_line_lies_on_the_drawn_surface(executor: Executor, report: Report, sea: str) -> None:
    """Without smoothing, at every hull point, at any time and place, at every quality."""
    scene, worst = SEAS[sea].model_copy(update={"boats": BOATS}), {}
    for tier, base in TIERS.items():
        surface = base.surface.model_copy(update={"method": "march"})
        # With relief one program has both waves and light.
        square = {"target": "RGBA32F", "samples": 1, "pixel_width": 1, "foam_relief": True}
        plan = make_plan(scene, base.model_copy(update={"surface": surface, **square}))
        off = 0.0
        for time in (2.7, 1000003.5):
            places, lines = water_lines(scene, poses(executor, plan, time, SKYWARD), time, SKYWARD)
            off = max(off, np.abs(drawn_heights(executor, plan, time, SKYWARD, places) - lines).max())
        worst[tier] = (off, WATER_LINE)
    report.within(
        "Water line over the drawn surface under hull points, smoothing 0, 2 boats, 2 times, m", sea=sea, **worst
    )


@pytest.mark.parametrize(("sea", "smoothing"), [("parametric", 0.0), ("storm", 2.0)])
def test_boats_float_as_in_float64(executor: Executor, report: Report, sea: str, smoothing: float) -> None:
    """Against the float64 surface, and its mean over discs: height, pitch and roll together, at the hull points."""
    boats = tuple(boat.model_copy(update={"smoothing": smoothing}) for boat in BOATS)
    scene = SEAS[sea].model_copy(update={"boats": boats})
    plan = make_plan(scene, EXACT)
    grid, off = cameras.SampleGrid(SKYWARD, 16, 9), 0.0
    for time in (1000003.5,) if scene.sea else (0.0, 1000003.5):
        places, lines = water_lines(scene, poses(executor, plan, time, SKYWARD), time, SKYWARD)
        relief = SampleShader(scene, time, grid, "same-samples", None).surface.relief
        want = [reference.mean_height(relief.height, place, smoothing) for place in places]
        off = max(off, float(np.abs(lines - np.array(want)).max()))
    title = "Water line against the float64 surface, reference quality, m"
    report.within(title, sea=sea, smoothing=smoothing, worst=(off, WATER_LINE))


def rays(seed: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """A place round a boat, as near as every ray is brought first, and directions to it and past it."""
    rng = np.random.default_rng(seed)
    angle, height, far = rng.uniform(0.0, 2.0 * math.pi), rng.uniform(-0.3, 1.2), rng.uniform(0.7, 0.9)
    eye = np.array([far * math.cos(angle), height, far * math.sin(angle)])
    toward = rng.uniform((-0.5, -0.1, -0.2), (0.5, 1.1, 0.2), (count, 3))
    # Some pass far from it, where nothing is.
    toward[: count // 8] = rng.uniform(-4.0, 4.0, (count // 8, 3))
    d = toward - eye
    return np.float64(np.float32(eye)), (d / np.linalg.norm(d, axis=1)[:, None]).astype(np.float32)


@pytest.mark.parametrize("kind", ["sail", "motor"])
def test_hulls_equal_their_float64_form(probe: Probe, report: Report, kind: str) -> None:
    """Where rays meet a boat, with which normal, and what part of it."""
    boat = Boat(kind=kind, boom=0.5)
    body = (
        "BoatHit hit = BoatHit(1e9, vec3(0.0), PART_HULL);\n"
        f"hit_boat(u_eye, x.xyz, {str(kind == 'motor').lower()}, u_rig, 0.0, hit);\n"
        "y = vec4(min(hit.t, 1e3), hit.normal.xy, float(hit.part));"
    )
    apart, worst, off, met = 0, 0.0, 0.0, 0
    for seed in range(12):
        eye, d = rays(seed, 4000)
        got = probe(
            (Inline("uniform vec3 u_eye;\nuniform vec2 u_rig;\n"), "boats/hull.glsl@hull"),
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
    assert met > 5000
    # Rays along an edge may meet either side of it.
    title = "Hulls against float64, 48 000 rays, in boat's lengths"
    report.within(title, kind=kind, met=met, other_part=(apart, 24), way=(worst, 2e-4), normal=(off, 5e-3))


def test_wakes_equal_their_float64_form(probe: Probe, report: Report) -> None:
    for boat in WAKES:
        wake = Wake(boat)
        at = np.random.default_rng(5).random((20000, 2)) * (1.05 * wake.length, 1.1 * ASIDE * wake.length)
        at = at.astype(np.float32)
        at[:100, 1] = 0.0
        got = probe(
            ("lib/numbers.glsl", Inline("uniform vec4 u_wake;\nuniform vec2 u_form;\n"), "boats/wake.glsl@pattern"),
            "y = wake_pattern(x.xy, u_wake, u_form.x, u_form.y);",
            at,
            uniforms={"u_wake": (wake.k, boat.wake, wake.length, wake.shortest), "u_form": (boat.length, boat.radius)},
        ).astype(np.float64)
        off = np.abs(got[:, :3] - np.stack(wakes_of.pattern(wake, *at.astype(np.float64).T), axis=-1)).max(axis=0)
        report.within(
            "Wakes against float64, 20 000 places, height in m and slope",
            speed=boat.speed,
            height=(off[0], 2e-4 * boat.wake),
            slope=(off[1:].max(), 1e-3),
        )


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


# On the mesh a silhouette is as fine as its cells: 4.97 levels by llvmpipe, 5.01 by an H200.
@pytest.mark.parametrize(("method", "mean", "share"), [("march", 0.3, 0.005), ("mesh", 5.2, 0.06)])
def test_no_back_face_and_nothing_behind_a_crest_shows_through(
    executor: Executor, report: Report, method: str, mean: float, share: float
) -> None:
    """Overlapping crests from low over the water: every sample is the first surface alone, mixed by Fresnel."""
    surface = EXACT.surface.model_copy(update={"method": method, "cells": 512})
    quality = EXACT.model_copy(update={"surface": surface})
    drawn = [one for one in make_plan(OVERLAPPING, quality).passes if one.name == "surface"]
    assert {one.state.blend for one in drawn} == {"none"}
    assert all(one.state.depth for one in drawn)
    for time in (0.0, 0.9, 1.8):
        seen = samples(executor, OVERLAPPING, quality, time=time, size=(160, 90))
        away = levels(seen, render(OVERLAPPING, time=time, width=160, height=90).rgb)
        report.within(
            "Overlapping crests from 0.2 m over them, against float64, 160 × 90, levels and share over 8",
            method=method,
            time=time,
            mean=(away.mean(), mean),
            over_8=((away > 8.0).mean(), share),
        )
