"""Section 17: the section of a plunging crest keeps what its sources say of it."""

import math

import numpy as np
import pytest

from seafoam.ocean.constants import GRAVITY
from support.scenes import plunging
from support.scenes.plunging import PlungingSection, fall_time, phase_at

PHASES = (0.0, 1e-6, 0.1, 0.35, 0.7, 1.0)
COUNT = 400
JET, ROOF, FACE, TROUGH = (slice(i * COUNT, (i + 1) * COUNT) for i in range(1, 5))


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
    out, into = (curve.points[rows] + side * step for side in (1.0, -1.0))
    # Close to the tip the jet is thinner than the step.
    thick = np.hypot(*(curve.points[rows] - np.array(section.tip)).T) > 0.02
    assert not section.inside(*out.T)[thick].any()
    assert section.inside(*into.T)[thick].all()


@pytest.mark.parametrize("phase", PHASES)
def test_the_face_is_an_arc_of_an_ellipse_of_aspect_root_three(phase: float) -> None:
    section = PlungingSection(phase)
    x, z = (section.curve(COUNT).points[FACE] - np.array(section.centre)).T
    # The conic's own axes: of x^2, xz and z^2 that are 1 everywhere on it.
    conic = np.linalg.lstsq(np.stack((x * x, 2.0 * x * z, z * z), axis=-1), np.ones(COUNT), rcond=None)[0]
    least, most = np.linalg.eigvalsh([[conic[0], conic[1]], [conic[1], conic[2]]])
    assert math.sqrt(most / least) == pytest.approx(math.sqrt(3.0), rel=1e-9)
    assert 1.0 / math.sqrt(least) == pytest.approx(plunging.LONG, rel=1e-9)
    assert x.min() + section.centre[0] == pytest.approx(section.hindmost)


def test_the_tip_falls_freely_and_lands_at_the_foremost_point_of_the_barrel() -> None:
    height, times = 2.5, np.linspace(0.0, 1.0, 9) * fall_time(2.5)
    tips = np.array([PlungingSection(time / fall_time(height)).tip for time in times]) * height
    np.testing.assert_allclose(tips[:, 1], height - 0.5 * GRAVITY * times**2, atol=1e-12)
    np.testing.assert_allclose(np.diff(tips[:, 0]), tips[1, 0], atol=1e-12)
    assert tips[-1, 1] == pytest.approx(plunging.LANDS * height)
    landed = PlungingSection(1.0)
    assert abs(landed.tip[0] - landed.centre[0] - plunging.HALF_WIDTH) < 0.01


@pytest.mark.parametrize("phase", PHASES)
def test_the_section_stays_within_its_bounds(phase: float) -> None:
    section = PlungingSection(phase)
    x, z = section.curve(COUNT).points.T
    assert (z.min(), z.max()) == (pytest.approx(0.0, abs=1e-12), pytest.approx(1.0))
    assert (x.min(), x.max()) == (-plunging.LENGTH, plunging.FRONT)
    steepest = np.abs(np.diff(z[:COUNT]) / np.diff(x[:COUNT])).max()
    assert 0.999 * plunging.SLOPE < steepest <= plunging.SLOPE
    # The jet is nowhere thinner than nothing: its underside stays under its top.
    under, above = z[ROOF], np.interp(x[ROOF], x[: 2 * COUNT], z[: 2 * COUNT])
    assert phase == 0.0 or (under <= above + 1e-5).all()
    assert x[FACE].max() == pytest.approx(section.toe)
    assert section.toe < plunging.FRONT


def test_the_barrel_is_hollow_and_the_jet_is_over_it() -> None:
    section = PlungingSection(0.9)
    column = np.linspace(-0.5, 1.2, 1701)
    wet = section.inside(np.full(column.size, 0.4), column)
    # From below: water, the barrel, the jet, air.
    assert np.count_nonzero(np.diff(wet)) == 3
    assert wet[0]
    assert not wet[-1]


def test_a_crest_that_peels_has_every_phase() -> None:
    phases = phase_at(np.linspace(-40.0, 40.0, 81), 2.0, 5.0, 20.0)
    assert (phases[0], phases[-1]) == (1.0, 0.0)
    assert np.diff(phases).min() == pytest.approx(-1.0 / 20.0)
    np.testing.assert_array_equal(phase_at(np.array([1e9, -1e9]), -1e9, 5.0, 20.0), [0.0, 0.0])


@pytest.mark.parametrize("phase", [-1e-9, 1.1, math.nan])
def test_no_other_phase_is_a_section(phase: float) -> None:
    with pytest.raises(ValueError, match=r"must be in \[0, 1\]"):
        PlungingSection(phase)
