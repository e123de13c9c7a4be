"""Section 17: the section of a plunging crest keeps what its sources say of it."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves.plunging import (
    ASPECT,
    FOOT,
    FOREMOST,
    GENTLE,
    HALF_WIDTH,
    LENGTH,
    LONG,
    SHOULDER,
    TAIL,
    Overturning,
    overturning,
)
from seafoam.planner import PlanError, make_plan
from seafoam.quality import TIERS
from seafoam.reference.waves.breaker import FACE, LUMPS, TOP, UNDER, PlungingCrest, Section
from seafoam.scene import Breaker, BreakerSaturation, Scene
from support.scenes import plunging
from support.scenes.plunging import PlungingSection

PHASES = (0.0, 1e-6, 0.1, 0.35, 0.7, 1.0)
COUNT = 400
JET, ROOF, ARC, TROUGH = (slice(i * COUNT, (i + 1) * COUNT) for i in range(1, 5))


@pytest.mark.parametrize("phase", PHASES)
def test_the_pieces_join_with_one_tangent_but_for_a_cusp_at_the_tip(phase: float) -> None:
    curve = PlungingSection(phase).curve(COUNT)
    ends = [(i * COUNT - 1, i * COUNT) for i in range(1, 5)]
    for last, first in ends:
        np.testing.assert_allclose(curve.points[last], curve.points[first], atol=1e-12)
    turned = [float(curve.normals[last] @ curve.normals[first]) for last, first in ends]
    expected = [1.0, -1.0, 1.0, 1.0] if phase > 0.0 else [1.0, 0.0, 1.0, 1.0]
    # Where the jet has no width, the face meets the crest at a right angle.
    np.testing.assert_allclose(turned, expected, atol=1e-9)


@pytest.mark.parametrize("phase", PHASES[2:])
def test_normals_stand_on_the_curve_and_point_out_of_the_water(phase: float) -> None:
    section = PlungingSection(phase)
    curve = section.curve(COUNT)
    inner = np.arange(curve.points.shape[0]) % COUNT
    rows = np.flatnonzero((inner > 2) & (inner < COUNT - 3))
    along = curve.points[rows + 1] - curve.points[rows - 1]
    along /= np.hypot(*along.T)[:, None]
    assert np.abs(np.einsum("ij,ij->i", along, curve.normals[rows])).max() < 0.02
    step = 1e-7 * curve.normals[rows]
    out, into = (whole(phase, curve.points[rows] + side * step) for side in (1.0, -1.0))
    # Close to the tip the jet is thinner than the step; the trough is no part of the crest.
    thick = np.hypot(*(curve.points[rows] - np.array(section.tip)).T) > 0.02
    thick &= curve.points[rows, 1] > 1e-6
    assert (out[thick] > 0.0).all()
    assert (into[thick] < 0.0).all()


@pytest.mark.parametrize("phase", PHASES)
def test_the_face_is_an_arc_of_an_ellipse_of_aspect_root_three(phase: float) -> None:
    section = PlungingSection(phase)
    x, z = (section.curve(COUNT).points[ARC] - np.array(section.centre)).T
    # The conic's own axes: of x^2, xz and z^2 that are 1 everywhere on it.
    conic = np.linalg.lstsq(np.stack((x * x, 2.0 * x * z, z * z), axis=-1), np.ones(COUNT), rcond=None)[0]
    least, most = np.linalg.eigvalsh([[conic[0], conic[1]], [conic[1], conic[2]]])
    assert math.sqrt(most / least) == pytest.approx(ASPECT, rel=1e-9)
    assert 1.0 / math.sqrt(least) == pytest.approx(LONG, rel=1e-9)
    assert x.min() + section.centre[0] == pytest.approx(section.hindmost)


def test_the_tip_falls_freely_past_the_foremost_point_of_the_barrel() -> None:
    height, fall = 2.5, math.sqrt(2.0 * 2.5 / GRAVITY)
    times = np.linspace(0.0, 1.0, 9) * fall
    tips = np.array([PlungingSection(time / fall).tip for time in times]) * height
    np.testing.assert_allclose(tips[:, 1], height - 0.5 * GRAVITY * times**2, atol=1e-12)
    np.testing.assert_allclose(np.diff(tips[:, 0]), tips[1, 0], atol=1e-12)
    assert tips[-1, 1] == pytest.approx(0.0)
    passing = PlungingSection(math.sqrt(1.0 - FOREMOST))
    assert passing.tip[0] == pytest.approx(1.0)
    assert passing.tip[1] == pytest.approx(FOREMOST)
    assert abs(passing.tip[0] - passing.centre[0] - HALF_WIDTH) < 0.02


@pytest.mark.parametrize("phase", PHASES)
def test_the_section_stays_within_its_bounds(phase: float) -> None:
    section = PlungingSection(phase)
    x, z = section.curve(COUNT).points.T
    assert (z.min(), z.max()) == (pytest.approx(0.0, abs=1e-12), pytest.approx(1.0))
    assert (x.min(), x.max()) == (-LENGTH, plunging.FRONT)
    steepest = np.abs(np.diff(z[:COUNT]) / np.diff(x[:COUNT])).max()
    assert 0.999 * plunging.SLOPE < steepest <= plunging.SLOPE
    # The jet is nowhere thinner than nothing: its underside stays under its top.
    under, above = z[ROOF], np.interp(x[ROOF], x[: 2 * COUNT], z[: 2 * COUNT])
    assert phase == 0.0 or (under <= above + 1e-5).all()
    assert x[ARC].max() == pytest.approx(section.toe)
    assert section.toe < plunging.FRONT


def test_the_barrel_is_hollow_and_the_jet_is_over_it() -> None:
    column = np.linspace(0.0, 1.2, 1701)[1:]
    wet = whole(0.9, np.stack((np.full(column.size, 0.4), column), axis=-1)) < 0.0
    # From below: water, the barrel, the jet, air.
    assert np.count_nonzero(np.diff(wet)) == 3
    assert wet[0]
    assert not wet[-1]


@pytest.mark.parametrize("phase", [0.1, 0.35, 0.7, 1.0])
def test_the_float64_form_is_zero_on_the_curve(phase: float) -> None:
    points = PlungingSection(phase).curve(COUNT).points
    back, jet, under, face = (section_at(phase, points[i * COUNT : (i + 1) * COUNT]).gaps() for i in range(4))
    for gaps, part in ((back, TOP), (jet, TOP), (under, UNDER), (face, FACE)):
        # The underside is vertical where it leaves the face, and rounding of x shows there.
        np.testing.assert_allclose(gaps[part, 1:-1], 0.0, atol=1e-6)


def test_a_crest_peels_as_fast_as_the_reef_is_oblique() -> None:
    crest = Breaker(height=3.0, length=60.0, peel_angle=0.7, every=9.0)
    form = overturning(crest)
    speed = form.rate * form.advance * crest.height
    # A solitary wave's, in 1/0.78 of its height (McCowan 1894).
    assert speed**2 == pytest.approx(GRAVITY * (3.0 + 3.0 / 0.78), rel=1e-6)
    assert form.advance == pytest.approx(math.tan(0.7), rel=1e-6)
    assert form.landing / form.rate == pytest.approx(math.sqrt(6.0 / GRAVITY), rel=1e-6)
    assert form.life == pytest.approx(SHOULDER + 20.0 + TAIL * form.landing, rel=1e-6)
    assert form.period == pytest.approx(9.0 * form.rate, rel=1e-6)
    assert (form.crests - 1) * form.period < form.life <= form.crests * form.period


def test_a_crest_comes_again_at_any_time_and_ends_where_it_begins() -> None:
    crest = Breaker(every=9.0)
    form = overturning(crest)
    first = PlungingCrest(crest, 3.0, (0.0, 0.0))
    again = PlungingCrest(crest, 3.0 + form.period / form.rate, (0.0, 0.0))
    assert again.front == pytest.approx(first.front, abs=1e-9)
    # What was the last that began is then the one before.
    before = PlungingCrest(crest, 3.0 + form.period / form.rate, (0.0, 0.0), 1)
    assert before.front == pytest.approx(first.front + form.period, abs=1e-9)
    along = np.linspace(0.0, form.length, 500)
    for front in (-SHOULDER, form.length + TAIL * form.landing):
        at = Section(front, form, np.stack((0.0 * along, 0.0 * along, along), axis=-1))
        assert at.high.max() == pytest.approx(1e-3)
        assert at.lumps.max() == 0.0


def test_water_keeps_foam_from_where_the_bore_ran_over_it_and_for_as_long() -> None:
    crest, source = Breaker(place=(0.0, 0.0), heading=0.0), BreakerSaturation(amount=1.0, life=5.0)
    form = overturning(crest)
    # In the middle of the crest, two jets' ways behind where one landed.
    s, x = 0.5 * form.length, form.advance * (0.5 * form.length + 3.0 * form.landing) + FOOT
    passed = (s + 3.0 * form.landing) / form.rate
    x, z = np.array([x, x, x, x - 3.0 * form.advance * form.landing]), np.array([s, -0.1, form.length + 0.1, s])
    left = [
        PlungingCrest(crest, passed + age, (0.0, 0.0)).left(
            source, crest.height * x, crest.height * z, None, even=False
        )
        for age in (1e-6, 2.0, 7.9)
    ]
    # Neither beyond its ends, nor before it has overturned.
    assert np.abs(np.array(left)[:, 1:]).max() == 0.0
    assert 0.3 <= left[0][0] <= 1.2
    assert left[1][0] == pytest.approx(math.exp(-2.0 / 5.0) * left[0][0], rel=1e-5)
    # The next comes after 8 s.
    assert left[2][0] == pytest.approx(math.exp(-7.9 / 5.0) * left[0][0], rel=1e-5)


@pytest.mark.parametrize("every", [2.0, 2.6])
def test_crests_that_would_meet_are_refused_with_the_range(every: float) -> None:
    with pytest.raises(PlanError, match=r"^/breaker/every: between 2\.67 and 600 s"):
        make_plan(Scene(breaker=Breaker(every=every)), TIERS["fast"])


@pytest.mark.parametrize("phase", [-1e-9, 1.1, math.nan])
def test_no_other_phase_is_a_section(phase: float) -> None:
    with pytest.raises(ValueError, match=r"must be in \[0, 1\]"):
        PlungingSection(phase)


def section_at(phase: float, points: NDArray[np.float64]) -> Section:
    """Points (n, 2) of the section at a phase of overturning, in the middle of a long crest."""
    even = math.sqrt((phase * (math.sqrt(1.0 + GENTLE**2) - GENTLE) + GENTLE) ** 2 - GENTLE**2)
    form = Overturning(1, 2.0, 1.0, 1.0, 1000.0, 1e4, 1e4)
    along = np.full(len(points), 500.0 - even * form.landing)
    return Section(500.0, form, np.column_stack((points, along)))


def whole(phase: float, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Gap of the crest without what it throws up, at points (n, 2); (n,)."""
    top, front, under = section_at(phase, points).gaps()[:LUMPS]
    return np.asarray(np.maximum(top, np.minimum(front, under)))
