"""Noise, sky, clouds, their shadows, night and the cube map against float64 (docs/formulae.md, sections 9 and 10)."""

import math
from itertools import pairwise, product

import numpy as np
import pytest
from numpy.typing import NDArray

from references.bake import load_truth, same_size
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sky_irradiance, sun_irradiance
from seafoam.effects.light.overcast import gap_light
from seafoam.reference import noise
from seafoam.reference.light import light as reference_light
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import linear, rms, rmse
from support.probe import Probe, shown, stand_in
from support.report import Report
from support.scenes import Camera, Clouds, Day, Light, Moon, Scene, Sky, load_preset, sun_angles
from support.sweep import REST

HASH = "lib/noise.glsl@hash"


def places(dimensions: int, count: int = 4000) -> NDArray[np.float64]:
    """Places near and far, on lattice points and on both sides of the period; float32 holds them as they are."""
    rng = np.random.default_rng(9)
    spread = rng.uniform(-300.0, 600.0, (count, dimensions))
    whole = np.floor(rng.uniform(-300.0, 300.0, (200, dimensions)))
    return np.concatenate([spread, whole, whole + np.float32(1e-4)]).astype(np.float32).astype(np.float64)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_noise_and_its_octaves_equal_their_float64_form(probe: Probe, dimensions: int) -> None:
    files, axes = [HASH, f"lib/noise.glsl@perlin_{dimensions}"], {2: "x.xy", 3: "x.xyz"}[dimensions]
    x = places(dimensions)
    got = probe(files, f"y.x = noise_{dimensions}({axes}, 12345u);", x)[:, 0]
    assert np.abs(got - noise.perlin(x, 12345)[0]).max() <= 1e-5
    width = np.random.default_rng(1).choice(np.float32([0.0, 0.02, 0.1, 0.4, 2.0]), x.shape[0])
    padded = np.column_stack((x, np.zeros((x.shape[0], 3 - dimensions)), width))
    off = probe(files, f"y.x = fractal_{dimensions}({axes}, x.w, 6, 77u);", padded)[:, 0]
    off = off - noise.fractal(x, width.astype(np.float64), 6, 77)
    # The finest octave magnifies the rounding of a place by 56. NVIDIA's GPUs are 2.06e-3 away.
    assert np.abs(off).max() <= 2.5e-3
    assert rms(off) <= 2e-4


SKIES = (
    None,
    Sky(),
    Sky(haze=0.0),
    Sky(haze=20.0),
    Sky(clouds=Clouds(cover=0.6)),
    Sky(moon=Moon(elevation=0.5)),
    Sky(moon=Moon(elevation=0.01), clouds=Clouds(cover=1.0, thickness=50.0)),
)


def test_light_from_above_is_the_integral(report: Report) -> None:
    """The midpoint rule of the plan against the reference's Gauss–Legendre quadrature; lamps the same."""
    worst = 0.0
    for sky, elevation in product(SKIES, (-0.4, -0.08, 0.0, 0.3, math.pi / 2)):
        light = Light(sun_elevation=elevation, sun_azimuth=0.7, sky=sky)
        air = reference_light.air(light)
        worst = max(worst, float(np.abs(np.array(sky_irradiance(light)) / air.sky_irradiance - 1.0).max()))
        assert np.allclose(lamp(light), air.sun, atol=1e-12)
        assert np.allclose(sun_irradiance(light), air.sun_irradiance, rtol=1e-6, atol=1e-12)
    report.within("Light of the layered sky, plan over reference less 1", worst=(worst, 5e-3))


@pytest.mark.parametrize("every", [75, pytest.param(1, marks=REST)])
def test_nothing_jumps_as_the_sun_goes_down(every: int) -> None:
    """From 10° over the horizon to 20° under, one step of 0.02° in so many: none of the sky over 3 %, none of the lamp
    over 0.1; from one step that is looked at to the next no more than as many of them."""
    sky = Sky(moon=Moon(elevation=0.6, azimuth=2.5), clouds=Clouds())
    before: tuple[int, NDArray[np.float64], float] | None = None
    look = np.array([[0.6, 0.05, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.3, 0.5]])
    look /= np.linalg.norm(look, axis=1)[:, None]
    for step in (step for step in range(1500) if step % every < 2):
        light = Light(sun_elevation=math.radians(10.0 - 0.02 * step), sun_azimuth=0.3, sky=sky)
        air = reference_light.air(light)
        seen, lamp = air.above.clear(look), float(air.sun_irradiance.sum())
        assert np.isfinite(seen).all()
        assert (seen > 0.0).all()
        if before is not None:
            steps = step - before[0]
            assert np.abs(seen / before[1] - 1.0).max() <= 1.03**steps - 1.0
            # Its last light ends at zero, where shares say nothing.
            assert abs(lamp - before[2]) <= 0.1 * steps
        before = step, seen, lamp


def test_the_sun_goes_round() -> None:
    """Equinox and solstice, by what every almanac says."""
    noon = Day(hour=12.0, date=81.0, latitude=0.8)
    azimuth, elevation = sun_angles(noon)
    assert elevation == pytest.approx(math.pi / 2 - 0.8, abs=0.01)
    # North is -z: at noon the sun stands over +z.
    assert math.cos(azimuth - math.pi / 2) == pytest.approx(1.0, abs=1e-6)
    azimuth, elevation = sun_angles(Day(hour=6.0, date=81.0, latitude=0.8))
    assert elevation == pytest.approx(0.0, abs=0.01)
    assert math.cos(azimuth) == pytest.approx(1.0, abs=1e-3), "the sun rises in the east, +x"
    assert sun_angles(Day(hour=12.0, date=172.0, latitude=math.radians(23.44)))[1] == pytest.approx(1.5708, abs=0.01)
    assert sun_angles(Day(hour=0.0, date=172.0, latitude=1.4))[1] > 0.0, "the midnight sun"


CUBE = ["lib/texels.glsl@bilinear", "lib/texels.glsl@cube_face", "reflection/cube.glsl@cube"]


def directions(count: int) -> NDArray[np.float64]:
    d = np.random.default_rng(2).normal(size=(count, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    return d.astype(np.float32).astype(np.float64)


def cube(probe: Probe, size: int, d: NDArray[np.float64]) -> NDArray[np.float32]:
    """A smooth function as a cube map of a size gives it in directions."""
    files, body = (
        (*CUBE, stand_in("smooth_texels"), "reflection/cube.glsl@cubemap"),
        "reflected_light(vec3(0.0), normalize(x.xyz), vec3(0.0))",
    )
    return probe(files, f"y.rgb = {body};", d, consts={"CUBE_SIZE": size})[:, :3]


@pytest.mark.parametrize("size", [2, 33, 256])
def test_a_cube_s_faces_meet_without_a_seam(probe: Probe, size: int) -> None:
    """Bilinear values a hair on either side of each edge, of a function that differs from texel to texel."""
    edge = directions(3000)
    axis, rows = np.argmax(np.abs(edge), axis=1), np.arange(len(edge))
    other = (axis + 1) % 3
    edge[rows, other] = np.where(edge[rows, other] < 0.0, -1.0, 1.0) * np.abs(edge[rows, axis])
    values = []
    for push in (1.0 - 1e-6, 1.0 + 1e-6):
        near = edge.copy()
        near[rows, other] *= push
        values.append(cube(probe, size, near))
    assert np.abs(values[0] - values[1]).max() <= 2e-5


def test_the_lake_in_the_cube_map_nears_the_truth(executor: Executor, report: Report) -> None:
    """The baked frame of ray-traced surroundings, against cube maps of rising size: hills and clouds on the water."""
    scene = load_preset("cubemap-lake").scene
    truth = load_truth("cubemap-lake.same.2.7")
    errors = []
    for size in (32, 64, 128, 256):
        quality = UNFILTERED.model_copy(update={"cube": "map", "cube_size": size})
        errors.append(rmse(linear(executor, scene, quality, time=2.7, size=same_size(scene)), truth.rgb))
    report.within(
        "cubemap-lake against ray-traced surroundings, RMSE in levels of linear light, faces of 32 to 256 texels",
        errors=" ".join(f"{error:.3f}" for error in errors),
        finest=(errors[-1], 1.2),
    )
    assert all(finer < coarser for coarser, finer in pairwise(errors))


EYE = (120.0, 10.0, -340.0)


def _scene(**fields: object) -> Scene:
    clouds = Clouds(size=1500.0, height=1200.0, thickness=8.0, seed=5, shadows=1.0).model_copy(update=fields)
    light = Light(sun_elevation=0.5, sun_azimuth=0.8, exposure=-2.0, sky=Sky(clouds=clouds))
    return Scene(light=light, camera=Camera(position=EYE))


def _truth(scene: Scene, place: NDArray[np.float64], side: float) -> NDArray[np.float64]:
    above = reference_light.air(scene.light, 3.0, EYE).above
    feet = np.tile((side, 0.0), (len(place), 1)), np.tile((0.0, 0.5 * side), (len(place), 1))
    return above.clouds.sunlight(place, feet)


def _places(far: float) -> NDArray[np.float64]:
    i = np.arange(1, 10_001)[:, None]
    p = (np.mod(i * np.array([0.754877666, 0.569840291]), 1.0) - 0.5) * far
    return np.stack((p[:, 0], np.full(len(p), 0.7), p[:, 1]), axis=-1)


@pytest.mark.parametrize("side", [0.1, 300.0, 2000.0])
def test_share_of_the_lamp(side: float, executor: Executor, report: Report) -> None:
    scene = _scene()
    fp = f"Footprint(vec2({side}, 0.0), vec2(0.0, {0.5 * side}))"
    body = f"o_color = vec4(sunlit(vec3(p.x, 0.7, p.y), {fp}), p, 0.0);"
    found = shown(executor, scene, body, 20000.0, time=3.0)
    place = np.stack((found[:, 1], np.full(len(found), 0.7), found[:, 2]), axis=-1)
    want = _truth(scene, place, side)
    off = np.abs(found[:, 0] - want)
    most = gap_light(scene.light.sky.clouds)
    assert found[:, 0].min() >= 0.0
    report.within(
        "Shadows of clouds, factor of the mean light of the lamp",
        footprint=f"{side} m",
        least=want.min(),
        most=(found[:, 0].max(), most * 1.0001),
        off=(np.quantile(off, 0.999), 2e-3),
    )


@pytest.mark.parametrize("side", [0.1, 300.0, 1000.0, 1e5])
@pytest.mark.parametrize("cover", [0.3, 0.6, 0.9])
def test_mean_is_kept(cover: float, side: float, report: Report) -> None:
    """Over many clouds the factor is 1 in the mean, whatever the footprint: energy is neither won nor lost."""
    scene = _scene(cover=cover)
    share = _truth(scene, _places(360.0 * 1500.0), side)
    report.within(
        "Mean of the shadows of clouds, less 1", cover=cover, footprint=side, off=(abs(share.mean() - 1.0), 0.03)
    )
    if side > 1e4:
        assert share.std() < 1e-6


def test_shadow_lies_where_clouds_hide_the_lamp() -> None:
    """Seen from a place on the water, the lamp stands behind the cloud that shades the place."""
    hidden, share = [], []
    scene = _scene(softness=0.5, depth=0.0)
    for x in np.linspace(-20000.0, 20000.0, 30):
        eye = (float(x), 1.0, 0.4 * float(x))
        above = reference_light.air(scene.light, 3.0, eye).above
        lamp = above.lit_by[None, :]
        hidden.append(float(above.behind_clouds(np.zeros((1, 3)), lamp, (np.full(1, 2e-3), np.full(1, 2e-3)))[1][0]))
        none = np.zeros((1, 2))
        share.append(float(above.clouds.sunlight(np.array([[0.0, 1.0, 0.0]]), (none, none))[0]))
    shaded = np.array(share) * (1.0 - float(above.taken))
    assert np.corrcoef(1.0 - np.array(hidden), shaded)[0, 1] > 0.9
