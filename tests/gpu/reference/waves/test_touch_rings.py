"""Rings of touches: the shader's slopes against float64, and frames of seas, shores and rivers that were touched."""

from dataclasses import replace

import numpy as np
import pytest

from seafoam.effects.waves.rings import TOUCHES
from seafoam.framegraph.rules import afloat
from seafoam.reference import render as reference
from seafoam.reference.waves.rings import touch_set
from seafoam.render.gl.executor import Executor
from support.exact import EXACT, UNFILTERED
from support.pictures import levels, samples
from support.probe import Probe
from support.report import Report
from support.scenes import (
    Camera,
    Current,
    Foam,
    Ripples,
    Scene,
    Sea,
    Shore,
    Touch,
    Water,
    WhitecapSaturation,
)

FILES = ("lib/numbers.glsl", "waves/rings.glsl@ring", "waves/rings.glsl@touch")
SIZE = (64, 36)
FULL = "y.xyz = touches_detail(x.xy, Footprint(vec2(0.0), vec2(0.0)));"


def train(time: float, place: tuple[float, float] = (0.0, 0.0), count: int = 14) -> tuple[Touch, ...]:
    """What a finger leaves that was drawn over the water, and a strong touch beyond."""
    near = tuple(
        Touch(place=(place[0] + 0.4 * i - 2.5, place[1] - 4.5 - 0.15 * i), time=time - 2.4 + 0.15 * i)
        for i in range(count)
    )
    return (*near, Touch(place=(place[0] + 3.0, place[1] - 14.0), time=time - 2.0, strength=0.12))


@pytest.mark.parametrize("current", [None, Current(speed=2.0, direction=0.7)], ids=["still", "river"])
@pytest.mark.parametrize(("time", "origin"), [(0.0, (0.0, 0.0)), (12.5, (1e7, -1e7)), (1e8, (-300.0, 4e5))], ids=str)
def test_slopes_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float], current: Current | None
) -> None:
    place = np.clip(origin, -1e7 + 20.0, 1e7 - 20.0)
    scene = Scene(current=current, touches=train(time, (float(place[0]), float(place[1]))))
    made = TOUCHES.contribute(scene, UNFILTERED)
    # The planner moves what floats in a current.
    velocity = (0.0, 0.0) if current is None else current.velocity
    made = replace(made, uniforms={name: afloat(one, velocity) for name, one in made.uniforms.items()})
    at = np.random.default_rng(3).uniform(-12.0, 12.0, (20000, 2)).astype(np.float32)
    at += np.float32(place - np.array(origin) - (0.0, 6.0))
    got = probe.contributed(made, FILES, FULL, at, time=time, origin=origin)
    want = np.column_stack(touch_set(scene, time, origin).gradient(*at.astype(np.float64).T))
    assert np.abs(want).max() > 0.1
    assert (got[:, 2] == 0.0).all(), "nothing is left out where nothing is filtered"
    report.within(
        "Touches against float64, 15 rings, 20 000 places",
        time=time,
        origin=origin[0],
        current=current is not None,
        slope=(np.abs(got[:, :2] - want).max(), 1e-4),
    )


def test_no_touch_and_a_touch_to_come_leave_the_water_level(probe: Probe) -> None:
    for touches, time in (((Touch(time=5.0),), 4.9), ((Touch(strength=0.0),), 1.0), ((Touch(),), 9.0)):
        contribution = TOUCHES.contribute(Scene(touches=touches), UNFILTERED)
        at = np.random.default_rng(5).uniform(-12.0, 12.0, (2000, 2)).astype(np.float32)
        assert (probe.contributed(contribution, FILES, FULL, at, time=time) == 0.0).all()


def test_what_a_footprint_takes_out_is_roughness(probe: Probe) -> None:
    """Far off, the slopes are gone, and their mean square is where the glitter looks for it."""
    contribution = TOUCHES.contribute(Scene(touches=train(0.0)), UNFILTERED)
    at = np.random.default_rng(7).uniform(-6.0, 6.0, (4000, 2)).astype(np.float32) - np.array([0.0, 6.0], np.float32)
    wide = FULL.replace("vec2(0.0), vec2(0.0)", "vec2(9.0, 0.0), vec2(0.0, 9.0)")
    sharp, blurred = (probe.contributed(contribution, FILES, body, at, filtered=True) for body in (FULL, wide))
    assert np.abs(blurred[:, :2]).max() < 0.05 * np.abs(sharp[:, :2]).max()
    assert sharp[:, 2].max() < 1e-6
    # Crossing rings interfere, so the sum of squares is theirs only in the mean.
    assert blurred[:, 2].mean() == pytest.approx((sharp[:, :2] ** 2).sum(axis=1).mean(), rel=0.5)


WATERS = {
    "sea": Scene(sea=Sea(wind=7.0), foam=Foam(saturation=(WhitecapSaturation(),))),
    "shore": Scene(shore=Shore(kind="beach"), water=Water(ripples=Ripples())),
    "river": Scene(current=Current(speed=1.2), water=Water(ripples=Ripples(), depth=1.5)),
}


@pytest.mark.parametrize("water", WATERS)
def test_a_touched_water_is_the_references(executor: Executor, report: Report, water: str) -> None:
    """The rings add to what is there, by as much as in float64, and change nothing where they are not."""
    x, y, z = (0.0, 3.0, 60.0) if water == "shore" else (0.0, 2.5, 0.0)
    time, camera = 20.0, Camera(position=(x, y, z), pitch=-0.35)
    touched = WATERS[water].model_copy(update={"touches": train(time, (x, z))})
    before, after = (samples(executor, one, EXACT, camera, time=time, size=SIZE) for one in (WATERS[water], touched))
    truth = reference(touched, time=time, width=SIZE[0], height=SIZE[1], camera=camera)
    away, change = levels(after, truth.rgb), levels(after, before)
    assert 0.02 < (change > 2.0).mean() < 0.9
    assert (change[:3] == 0.0).all(), "the sky is as it was"
    report.within(
        "Touched water against the float64 reference, 64 × 36, levels of linear light",
        water=water,
        mean=(away.mean(), 0.5),
        over_2=((away > 2.0).mean(), 0.01),
    )
