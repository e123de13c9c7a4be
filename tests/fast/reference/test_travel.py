"""Travel time of a swell: refraction and shoaling against closed forms (docs/formulae.md, section 8)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.coast.travel import arrival, speed, travel_grid
from seafoam.reference.shore.maps import BREAKS, shore_map
from seafoam.scene.shore import Shore, Surf

SIDE = 256
BEACH = Shore(
    kind="beach",
    size=640.0,
    depth=9.0,
    slope=0.05,
    height=0.0,
    roughness=0.0,
    smoothing=2.5,
    surf=Surf(height=0.6, period=7.5, heading=0.5, variation=0.0, refraction=True),
)


def _depth(shore: Shore) -> NDArray[np.float64]:
    texel = shore.size / SIDE
    depth: NDArray[np.float64] = ndimage.gaussian_filter(
        -floor_grid(shore, SIDE)[..., 0], shore.smoothing / texel, mode="nearest"
    )
    return depth


@pytest.mark.parametrize("period", [2.0, 7.5, 20.0])
def test_speed_satisfies_the_dispersion_relation(period: float) -> None:
    depth = np.geomspace(0.01, 1000.0, 200)
    rate = 2.0 * math.pi / period
    k = rate / speed(depth, period)
    assert np.abs(9.81 * k * np.tanh(k * depth) / rate**2 - 1.0).max() <= 2e-3


@pytest.mark.parametrize("heading", [0.0, 0.25, 0.5, 0.8])
def test_refraction_on_a_plane_beach_is_snells(heading: float) -> None:
    """sin θ/c is constant over straight contours; within 1° from deep water to where waves break."""
    shore = BEACH.model_copy(update={"surf": BEACH.surf.model_copy(update={"heading": heading})})
    texel = shore.size / SIDE
    time = travel_grid(shore, SIDE)[..., 0]
    along_z, along_x = np.gradient(time, texel)
    depth = _depth(shore)
    row = SIDE // 2
    breaks = shore.surf.height / BREAKS
    seen = np.flatnonzero((depth[row] > breaks) & (np.arange(SIDE) > 8) & (np.arange(SIDE) < SIDE // 2))
    got = np.arctan2(along_z[row, seen], along_x[row, seen])
    pace, offshore = speed(depth[row, seen], shore.surf.period), speed(np.array([shore.deep]), shore.surf.period)
    want = np.arcsin(math.sin(heading) * pace / offshore)
    assert np.abs(got - want).max() <= math.radians(1.0)
    # It has turned by much more than that.
    assert abs(got[0] - heading) <= math.radians(0.5)
    if heading >= 0.25:
        assert heading - got[-1] >= math.radians(7.0)


def test_shoaling_is_greens() -> None:
    """Height times the fourth root of the depth is constant, within 2 %, until waves break."""
    shore = BEACH.model_copy(
        update={"depth": 40.0, "surf": BEACH.surf.model_copy(update={"heading": 0.0, "height": 1.0})}
    )
    height = shore_map(shore, 0.0)[SIDE // 2, :, 1]
    depth = _depth(shore)[SIDE // 2]
    breaks = shore.surf.height / BREAKS
    seen = (depth > 1.02 * breaks) & (depth < 0.44 * shore.deep) & (np.arange(SIDE) < SIDE // 2)
    assert np.count_nonzero(seen) > 20
    assert depth[seen].max() / depth[seen].min() > 8.0
    law = height[seen] * depth[seen] ** 0.25
    assert np.abs(law / law.mean() - 1.0).max() <= 0.02


def test_plane_fronts_over_even_depth_are_exact() -> None:
    side, pace = 64, 8.0
    x, z = np.meshgrid(np.arange(side), np.arange(side), indexing="xy")
    for heading in (0.0, 0.4, 2.1, -1.3):
        plane = (math.cos(heading) * x + math.sin(heading) * z) / pace
        fixed = np.zeros((side, side), np.bool_)
        fixed[[0, -1], :] = fixed[:, [0, -1]] = True
        found = arrival(np.where(fixed, plane, 1e6), fixed, np.full((side, side), 1.0 / pace))
        assert np.abs(found - plane).max() <= 1e-9


def test_circles_round_a_point() -> None:
    """First order: off by less than a texel's delay at 60 texels."""
    side = 129
    fixed = np.zeros((side, side), np.bool_)
    fixed[64, 64] = True
    found = arrival(np.where(fixed, 0.0, 1e6), fixed, np.ones((side, side)))
    z, x = np.indices((side, side)) - 64
    assert np.abs(found - np.hypot(x, z)).max() <= 2.5


def test_islands_throw_shadows() -> None:
    island = Shore(
        kind="island",
        size=420.0,
        radius=62.0,
        roughness=0.0,
        surf=Surf(height=1.0, heading=0.0, exposure=1.0, refraction=True),
    )
    share = travel_grid(island, SIDE)[..., 1]
    row = SIDE // 2
    assert share[row, 20] >= 0.99
    assert share[row, SIDE // 2 + 55] <= 0.3
    assert share[20, SIDE // 2 + 55] >= 0.9
    open_ = island.model_copy(update={"surf": island.surf.model_copy(update={"exposure": 0.0})})
    assert travel_grid(open_, SIDE)[20, SIDE // 2 + 55, 1] >= 0.99
    # Behind it crests have come round: later than over level water, from both sides alike.
    time = travel_grid(island, SIDE)[..., 0]
    assert np.abs(time - time[::-1])[:, -40:].max() <= 2e-3
    assert time[row, SIDE // 2 + 55] > time[20, SIDE // 2 + 55] + 0.3
