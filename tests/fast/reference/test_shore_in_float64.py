"""Shores in float64 and in plans: profiles, floors, foam over the edge of the water, pictures of land."""

import base64
import math

import numpy as np
import pytest
from pydantic import ValidationError

from seafoam.ocean.coast.seabed import floor_grid
from seafoam.reference.shore import shore as truth
from seafoam.scene.foam import SurfSaturation
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore
from seafoam.textures.shore import ShoreFloor, shore_profiles
from seafoam.textures.store import texture
from support.scenes.coasts import KINDS, SEA, SHORE, coast, png

SURF = SurfSaturation(line=1.0)


def test_foam_of_the_water_goes_over_into_that_on_the_ground() -> None:
    """At the water's edge it is the ground's; the water's own where the edge lies outside of the footprint."""
    sea, source = coast(SEA, 0.0), SURF
    x, z = np.random.default_rng(1).uniform(-60.0, 60.0, (2, 100_000))
    height = sea.height(x, z)
    ground = sea.ground(*sea.place(x, z))[0]
    depth = height - ground
    narrow, wide = ((np.tile((side, 0.0), (x.size, 1)), np.tile((0.0, side), (x.size, 1))) for side in (0.05, 1.0))
    own = np.minimum(sea.foam(source, x, z, height, None), 1.0)
    swept = sea.swash_foam(source, x, z, ground, narrow)
    found = sea.foam(source, x, z, height, narrow)
    deep = depth > truth.EDGE[1]
    assert np.abs(found - own)[deep].max() <= 0.01
    # Patches of the water lie where it rests, those of the ground where they are.
    assert np.quantile(np.abs(found - swept)[depth <= 0.0], 0.99) <= 0.02
    shallow = (depth > 0.0) & (depth < 0.25 * truth.EDGE[1]) & (np.abs(swept - own) > 0.3)
    part = (sea.foam(source, x, z, height, wide) - swept)[shallow] / (own - swept)[shallow]
    assert np.count_nonzero((part > 0.1) & (part < 0.9)) > 10


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
        ("not base64!", "not base64"),
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


def test_a_scene_with_a_broken_picture_names_its_field() -> None:
    """As every other scene that is not one; the field is named."""
    with pytest.raises(ValidationError) as caught:
        Scene.model_validate({"shore": {"kind": "image", "image": "????"}})
    assert caught.value.errors()[0]["loc"][:1] == ("shore",)
