"""A current carries what floats: as a carried eye sees it, with Doppler's frequencies; and stands still at stones."""

import pytest

from seafoam.effects.effect import PlanError
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import EXACT, SQUARE
from support.pictures import levels, samples
from support.scenes import (
    Boat,
    Camera,
    Current,
    Foam,
    FoamLife,
    FrontSaturation,
    Look,
    ParametricWave,
    Ring,
    Ripples,
    Scene,
    Sea,
    Stone,
    WakeSaturation,
    Water,
    WhitecapSaturation,
)

WAVE = ParametricWave(amplitude=0.5, wavelength=6.0, direction=0.7)
FLOW = Current(speed=2.3, direction=1.9)
SCENES = {
    "waves and cells": Scene(
        waves=(WAVE,), foam=Foam(cells=True, texture=0.5, texture_second=2.7), water=Water(ripples=Ripples())
    ),
    "living foam": Scene(
        waves=(WAVE, WAVE.model_copy(update={"direction": -1.0})),
        foam=Foam(saturation=(FrontSaturation(decay=2.0),), life=FoamLife(windrows=0.5)),
    ),
    "sea": Scene(sea=Sea(wind=12.0), foam=Foam(saturation=(WhitecapSaturation(lasting=True),)), water=Water(depth=4.0)),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_current_shows_what_an_eye_sees_that_the_water_carries(executor: Executor, name: str) -> None:
    """Galilei: from a bank at x after t seconds of a current U the water looks as still water does from x − Ut."""
    scene, time = SCENES[name], 37.5
    flowing = scene.model_copy(update={"current": FLOW})
    x, y, z = scene.camera.position
    u, w = FLOW.velocity
    carried = scene.camera.model_copy(update={"position": (x - u * time, y, z - w * time)})
    for quality in (EXACT, TIERS["standard"]):
        still = samples(executor, scene, quality, carried, time=time, size=(64, 36))
        seen = samples(executor, flowing, quality, scene.camera, time=time, size=(64, 36))
        resting = samples(executor, scene, quality, scene.camera, time=time, size=(64, 36))
        assert levels(seen, still).mean() < 0.05
        assert levels(resting, still).mean() > 1.0


@pytest.mark.parametrize(
    "changed", [{"rings": (Ring(),)}, {"boats": (Boat(),)}], ids=lambda changed: next(iter(changed))
)
def test_what_keeps_its_place_is_refused_in_a_current(changed: dict[str, object]) -> None:
    with pytest.raises(PlanError, match="current"):
        make_plan(Scene(current=FLOW).model_copy(update=changed), TIERS["standard"])
    make_plan(Scene(current=Current(speed=0.0)).model_copy(update=changed), TIERS["standard"])


STONES = Current(
    speed=2.2,
    direction=1.2,
    stones=(Stone(place=(-1.0, -9.0), radius=0.6, waves=0.5), Stone(place=(3.0, -14.0), radius=1.0, waves=0.3)),
)


@pytest.mark.parametrize("look", ["textured", "filtered"])
def test_water_at_stones_against_float64(executor: Executor, look: Look) -> None:
    """Waves and white water: exact per sample; at the standard tier the map's picture is the exact one's."""
    scene = Scene(
        current=STONES,
        foam=Foam(saturation=(WakeSaturation(amount=0.8, life=2.0),), look=look, mask="clump"),
        camera=Camera(position=(0.0, 4.0, 0.0), pitch=-0.35),
    )
    truth = render(scene, time=7.5, width=96, height=54)
    bare = scene.model_copy(update={"current": STONES.model_copy(update={"stones": ()})})
    # At `standard` marches widen their tolerance: 1.52 levels, and 1.34 if they did not.
    for quality, most in ((EXACT, 0.1), (SQUARE, 1.6)):
        away = levels(samples(executor, scene, quality, scene.camera, time=7.5, size=(96, 54)), truth.rgb)
        without = levels(samples(executor, bare, quality, scene.camera, time=7.5, size=(96, 54)), truth.rgb)
        assert away.mean() < most
        assert away.mean() < 0.3 * without.mean()


def test_stones_bring_nothing_to_water_that_rests_and_are_refused_where_it_is_shallow() -> None:
    low = tuple(stone.model_copy(update={"height": 0.0}) for stone in STONES.stones)
    still = Scene(
        current=STONES.model_copy(update={"speed": 0.0, "stones": low}), foam=Foam(saturation=(WakeSaturation(),))
    )
    assert "stone" not in "".join(
        program.fragment.text for program in make_plan(still, TIERS["standard"]).programs.values()
    )
    with pytest.raises(PlanError, match="at most"):
        make_plan(Scene(current=STONES, water=Water(depth=0.5)), TIERS["standard"])
