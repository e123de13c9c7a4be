"""The uniform rules: pinned by the golden vectors, exact at any time and place."""

import json
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seafoam.framegraph.evaluation import FrameState, axes, evaluate, evaluate_rule
from seafoam.framegraph.rules import CameraRule, Clamp, Constant, Loop, Phase, Uniform, Wrap
from seafoam.scene import Camera

GOLDEN = Path(__file__).parents[2] / "golden" / "uniform_rules.json"


def state(time: float = 0.0, camera: Camera | None = None) -> FrameState:
    return FrameState(time, camera or Camera(), 320, 180, 640, 360)


def test_golden_vectors_are_what_the_rules_give() -> None:
    for entry in json.loads(GOLDEN.read_text(encoding="utf-8")):
        rule = Uniform.model_validate({"type": "float", "rules": [entry["rule"]]}).rules[0]
        given_state = FrameState(**{**entry["state"], "camera": Camera.model_validate(entry["state"]["camera"])})
        got = np.array(evaluate_rule(rule, given_state), np.float32)
        # The vectors were written on one machine: its libm may differ from another's in the last bit of float64.
        np.testing.assert_allclose(got, np.array(entry["value"], np.float32), rtol=1.2e-7, atol=1e-12)


@given(
    time=st.floats(-1e9, 1e9),
    rate=st.floats(-100, 100),
    offset=st.floats(-7, 7),
    x=st.floats(-1e7, 1e7),
    k=st.floats(-100, 100),
)
def test_phase_is_reduced_as_exactly_as_float64_can(
    time: float, rate: float, offset: float, x: float, k: float
) -> None:
    camera = Camera(position=(x, 5.0, 0.0))
    (phase,) = evaluate_rule(Phase(offset=offset, rate=rate, k=(k, 0.0)), state(time, camera))
    assert -math.pi <= phase <= math.pi
    exact = Fraction(offset) + Fraction(rate) * Fraction(time) + Fraction(k) * Fraction(x)
    turns = (exact - Fraction(phase)) / Fraction(2.0 * math.pi)
    # What rounding of the two products may do: half a unit in the last place of each, in rad.
    allowed = 4.0 * (math.ulp(rate * time) + math.ulp(k * x)) + 1e-15
    assert abs(float(turns - round(turns))) * 2.0 * math.pi <= allowed


@given(value=st.floats(-1e12, 1e12), period=st.floats(1e-3, 1e6))
def test_wrap_and_loop_stay_in_their_period(value: float, period: float) -> None:
    (looped,) = evaluate_rule(Loop(period=period), state(value))
    assert 0.0 <= looped < period
    x = min(max(value, -1e7), 1e7)
    (wrapped,) = evaluate_rule(Wrap(k=(1.0, 0.0), period=period), state(0.0, Camera(position=(x, 1.0, 0.0))))
    assert 0.0 <= wrapped < period


@given(birth=st.floats(-1e9, 1e9), age=st.floats(-10.0, 100.0))
def test_an_age_is_as_exact_as_the_times_it_lies_between(birth: float, age: float) -> None:
    time = birth + age
    exact = min(max(Fraction(time) - Fraction(birth), Fraction(0)), Fraction(60))
    (held,) = evaluate_rule(Clamp(offset=-birth, rate=1.0, low=0.0, high=60.0), state(time))
    assert abs(Fraction(held) - exact) <= Fraction(math.ulp(time))
    (looped,) = evaluate_rule(Loop(period=7.5, offset=-birth), state(time))
    away = (Fraction(time) - Fraction(birth) - Fraction(looped)) % Fraction(7.5)
    assert min(away, Fraction(7.5) - away) <= Fraction(math.ulp(time)) + Fraction(math.ulp(7.5))


def test_held_stops_at_its_ends_and_a_uniform_that_its_rules_do_not_fill_is_refused() -> None:
    rule = Clamp(offset=0.5, k=(1.0, 0.0), low=-2.0, high=3.0)
    places = (-1e7, 1.0, 1e7)
    got = [evaluate_rule(rule, state(0.0, Camera(position=(x, 5.0, 0.0)))) for x in places]
    assert got == [(-2.0,), (1.5,), (3.0,)]
    with pytest.raises(ValueError, match="2 values for 1 × vec3"):
        evaluate(Uniform(type="vec3", rules=(Constant(value=(1.0, 2.0)),)), state())


@given(yaw=st.floats(-6, 6), pitch=st.floats(-math.pi / 2, math.pi / 2), roll=st.floats(-3, 3))
def test_axes_are_right_handed_at_any_pitch(yaw: float, pitch: float, roll: float) -> None:
    right, up, forward = axes(Camera(yaw=yaw, pitch=pitch, roll=roll))
    np.testing.assert_allclose(np.cross(right, up), -np.array(forward), atol=1e-12)
    matrix = np.array([right, up, forward])
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)


def test_projection_agrees_with_the_rays() -> None:
    """A point along a ray lands on the ray's own clip position."""
    camera = Camera(position=(5.0, 7.0, -3.0), yaw=0.7, pitch=-0.4, roll=0.2, fov=1.0)
    here = state(0.0, camera)
    matrix = np.array(evaluate_rule(CameraRule(what="view_projection", top=2.0), here)).reshape(4, 4).T
    rays = [np.array(evaluate_rule(CameraRule(what=what), here)) for what in ("ray_x", "ray_y", "ray_z")]
    for x, y in ((0.0, 0.0), (0.5, -0.25), (-1.0, 1.0)):
        point = np.array([0.0, 7.0, 0.0]) + 12.0 * (rays[2] + x * rays[0] + y * rays[1])
        clip = matrix @ np.append(point, 1.0)
        np.testing.assert_allclose(clip[:2] / clip[3], (x, y), atol=1e-12)
        assert -1.0 < clip[2] / clip[3] < 1.0
