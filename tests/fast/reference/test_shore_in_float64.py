"""Shores in float64, and how swell travels to them."""

import base64
import math

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import ValidationError
from scipy import ndimage

from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.coast.travel import arrival, speed, travel_grid
from seafoam.reference.shore.maps import BREAKS, shore_map
from seafoam.scene import Shore, Surf
from seafoam.textures.shore import ShoreFloor, shore_profiles
from seafoam.textures.store import texture
from support.scenes.coasts import KINDS, SHORE, png


@pytest.mark.parametrize("sharpness", [0.0, 0.05, 0.15])
def test_an_upright_profile_is_the_trochoid(sharpness: float) -> None:
    """γ = 1 is x = s − b sin 2πs, y = ½ + ½ cos 2πs, but for the Gaussian that smooths fronts."""
    nodes = 256
    upright = shore_profiles(nodes, 1.0, sharpness).astype(np.float64)
    assert (upright == upright[0]).all()
    s = np.arange(20000) / 20000.0
    x = s - sharpness * np.sin(2.0 * math.pi * s)
    want = np.interp((np.arange(nodes) + 0.5) / nodes, x, 0.5 + 0.5 * np.cos(2.0 * math.pi * s), period=1.0)
    # (2π·0.012)²/2 of the wave's half height, and more where the crest is sharper.
    assert np.abs(upright[0] - want).max() <= 2e-3 + 0.06 * sharpness / (1.0 - 2.0 * math.pi * 0.15 * 1.02)


@pytest.mark.parametrize("skew", [0.0, 1e-6, 0.05, 0.5, 1.0])
def test_profiles_at_the_ends_of_their_range(skew: float) -> None:
    for sharpness in (0.0, 0.05, 0.15):
        table = shore_profiles(128, skew, sharpness)
        assert np.isfinite(table).all()
        assert table.min() >= 0.0
        assert table.max() <= 1.0
        # The front is on the side toward the shore, that of rising x.
        if 0.3 <= skew < 1.0:
            change = np.diff(table[-1].astype(np.float64))
            assert -change.min() > 1.3 * change.max()


@pytest.mark.parametrize("kind", KINDS)
def test_floors_end_level_and_are_what_their_seed_says(kind: str) -> None:
    shore = SHORE.model_copy(update={"kind": kind, "level": -1.25})
    grid = floor_grid(shore, 128)
    edge = np.concatenate([grid[0], grid[-1], grid[:, 0], grid[:, -1]])
    assert (edge[:, 0] == -shore.depth - 1.25).all()
    assert (grid[..., 0] > 0.0).any()
    assert (grid * 1024.0 == np.round(grid * 1024.0)).all()
    other = floor_grid(shore.model_copy(update={"seed": 4}), 128)
    assert (grid != other).any()
    # A finer grid is of the same floor.
    fine = floor_grid(shore, 256)[..., 0].reshape(128, 2, 128, 2).mean(axis=(1, 3))
    assert np.abs(fine - grid[..., 0]).mean() <= 0.05


def test_a_picture_is_a_shore() -> None:
    """White in the middle of black is an island; deep and high as the scene says, and so is its texture."""
    grey = np.zeros((64, 64), np.uint8)
    grey[24:40, 20:30] = 255
    shore = Shore(kind="image", image=png(grey), size=640.0, depth=8.0, height=5.0)
    grid = floor_grid(shore, 128)[..., 0]
    assert grid[64, 50] == 5.0
    assert grid[10, 10] == -8.0
    # Texels of 5 m, pixels of 10 m: rows run with z, columns with x.
    assert (grid[52:76, 44:56] > 0.0).all()
    assert (grid[:46] < 0.0).all()
    assert (grid[:, 64:] < 0.0).all()
    stored = np.frombuffer(texture(ShoreFloor(shore=shore, texels=128)).data, "<f4").reshape(128, 128, 2)
    assert (stored[..., 0] == grid).all()


@pytest.mark.parametrize(
    ("image", "says"),
    [
        (None, "required for kind"),
        ("not base64!", "not a readable PNG"),
        (base64.b64encode(b"GIF89a").decode(), "not a readable PNG"),
        (png(np.zeros((1, 40), np.uint8)), "pixels"),
        (png(np.zeros((200, 200), np.uint8)), "pixels"),
        (png(np.zeros((16, 16), np.uint8))[:60], "not"),
        ("A" * 9000, "8192"),
    ],
)
def test_pictures_that_are_none_say_why(image: str | None, says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        Shore(kind="image", image=image)
    with pytest.raises(ValidationError):
        Shore(kind="beach", image=png(np.zeros((16, 16), np.uint8)))


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
