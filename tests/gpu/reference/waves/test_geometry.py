"""Distance and normal at pixels' centres against float64, from over and under the water."""

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.planner import make_geometry_plan
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.renderer.shade import SampleShader
from seafoam.reference.types import unit
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import draw
from support.report import Report
from support.scenes import Camera, Scene, load_preset

SIZE = (96, 54)
TIME = 2.7
VIEWS: dict[str, tuple[Scene, Camera | None]] = {
    "default": (load_preset("default").scene, None),
    "island-surf": (load_preset("island-surf").scene, None),
    # A boat shapes the water under it, and hides none of it.
    "boat-race": (load_preset("boat-race").scene, None),
    "between crests": (load_preset("default").scene, Camera(position=(0.0, 0.5, 0.0), pitch=-0.1)),
    "a pool from below": (load_preset("pool-caustics").scene, Camera(position=(0.0, -1.0, 0.0), pitch=-0.2)),
}


def truth(scene: Scene, camera: Camera) -> NDArray[np.float64]:
    """Normal and distance in float64, (height, width, 4)."""
    width, height = SIZE
    grid = SampleGrid(camera, width, height)
    state = SampleShader(scene.settled, TIME, grid, "same-samples", None)
    X, Y = (2.0 * (np.arange(width) + 0.5) / width - 1.0, 1.0 - 2.0 * (np.arange(height) + 0.5) / height)
    surface, coast = state.surface, state.surface.coast
    D = grid.rays(*(one.ravel() for one in np.meshgrid(X, Y)))
    d = unit(D)
    found = np.zeros((len(d), 4))
    water = intersect.first_crossing(surface.relief, state.eye_y, d)
    ground = np.full(len(d), np.inf)
    if state.under and state.seabed is not None:
        here = np.zeros(len(d))
        ground = state.seabed.reach(here, here, here + state.eye_y, d)
    elif coast is not None:
        ground = intersect.land_crossing(coast.land, state.eye_y, d, *coast.within(d))
    dry, wet = ground < water, (water <= ground) & np.isfinite(water)
    x, z = d[:, 0], d[:, 2]
    if dry.any():
        found[dry, :3], found[dry, 3] = (0.0, 1.0, 0.0), ground[dry]
        if coast is not None:
            places = coast.place(x[dry] * ground[dry], z[dry] * ground[dry])
            _, g_x, g_z, _ = coast.ground(*places)
            found[dry, :3] = unit(intersect.normal(g_x, g_z))
    if wet.any():
        _, (h_x, h_z), (c_x, c_z) = surface.slopes(x[wet] * water[wet], z[wet] * water[wet])
        found[wet, :3], found[wet, 3] = unit(intersect.normal(h_x + c_x, h_z + c_z)), water[wet]
    return found.reshape(height, width, 4)


@pytest.mark.whole
@pytest.mark.parametrize("name", VIEWS)
def test_geometry_is_that_of_float64(executor: Executor, report: Report, name: str) -> None:
    scene, camera = VIEWS[name]
    seen = camera or scene.camera
    got = draw(executor, make_geometry_plan(scene, UNFILTERED), seen, time=TIME, size=SIZE, output="linear")
    want = truth(scene, seen)
    # Nearer to the horizon a ray that touches a crest falls either way.
    sure = np.abs(SampleGrid(seen, *SIZE).depression) > np.radians(1.0)
    assert (((got[..., 3] > 0.0) == (want[..., 3] > 0.0)) | ~sure).mean() >= 0.999
    both = sure & (got[..., 3] > 0.0) & (want[..., 3] > 0.0) & (want[..., 3] < 1e5)
    assert both.mean() > 0.2
    np.testing.assert_allclose(np.linalg.norm(got[both, :3], axis=-1), 1.0, atol=1e-5)
    turned = np.degrees(np.arccos(np.clip((got[both, :3] * want[both, :3]).sum(axis=-1), -1.0, 1.0)))
    report.within(
        "Distance and normal (degrees) at pixels' centres against float64, 99 % of them",
        view=name,
        distance=(np.quantile(np.abs(got[both, 3] / want[both, 3] - 1.0), 0.99), 1e-5),
        normal=(np.quantile(turned, 0.99), 0.1),
    )
