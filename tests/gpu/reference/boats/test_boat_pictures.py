"""Pictures of boats: what stands before what, and crests that cover."""

import numpy as np
import pytest

from seafoam.planner import make_plan
from seafoam.reference import render
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect as surfaces
from seafoam.reference.renderer.shade import SampleShader
from seafoam.reference.types import unit
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import colours, levels, samples
from support.report import Report
from support.scenes import Boat, Camera, Foam, HeightSaturation, Light, ParametricWave, Scene, Water


def test_a_boat_stands_before_what_is_behind_it_and_behind_what_is_before_it(executor: Executor) -> None:
    """Low over crests that hide half of it: no sample of water before the boat is any other for it."""
    scene = Scene(
        waves=(ParametricWave(amplitude=1.6, wavelength=14.0, direction=1.4, exponent=2.0),),
        boats=(Boat(centre=(0.0, -45.0), radius=20.0, bearing=1.6, speed=0.0, wake=0.0, kind="motor", length=10.0),),
        camera=Camera(position=(0.0, 1.9, 0.0), pitch=0.0, fov=0.5),
    )
    grid = cameras.SampleGrid(cameras.view(scene.camera, 160, 90), 160, 90)
    shader = SampleShader(scene, 0.0, grid, "same-samples", None)
    down, along = np.mgrid[0:90, 0:160]
    X, Y = 2.0 * (along.ravel() + 0.5) / 160 - 1.0, 1.0 - 2.0 * (down.ravel() + 0.5) / 90
    d = unit(cameras.rays(grid.view, X, Y))
    water = surfaces.first_crossing(shader.surface.relief, shader.eye_y, d).reshape(90, 160)
    boat = shader.fleet.trace(np.array([0.0, shader.eye_y, 0.0]), d).t.reshape(90, 160)
    hidden, shown = (np.isfinite(boat) & nearer for nearer in (water < boat, boat < water))
    assert hidden.sum() > 100
    assert shown.sum() > 100
    bare = scene.model_copy(update={"boats": ()})
    with_it, without = (samples(executor, one, EXACT, size=(160, 90)) for one in (scene, bare))
    assert levels(with_it, without)[hidden].max() == 0.0
    truth = colours(render(scene, time=0.0, width=160, height=90).rgb)
    assert 255.0 * np.abs(colours(with_it) - truth)[shown].mean() < 0.5


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
