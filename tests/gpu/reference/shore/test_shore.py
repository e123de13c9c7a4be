"""The shore against float64: distances, map, waves, foam, ground, way through water (docs/formulae.md, section 8).

Where a closed form does not exist, the reference has the same grids of texels and the same splines between them as the
shaders: they are part of the model. Its distances are SciPy's exact ones.
"""

import hashlib
import math
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.planner import make_plan
from seafoam.reference.light.light import unit
from seafoam.reference.shore import maps
from seafoam.reference.shore import shore as truth
from seafoam.render.gl import executor as executors
from seafoam.render.gl.executor import Executor
from seafoam.textures.shore import ShoreFloor
from seafoam.textures.store import TextureData
from support.exact import EXACT
from support.report import Report
from support.scenes import Camera, Foam, Scene, Shore, SurfSaturation
from support.scenes.coasts import KINDS, SEA, SHORE, coast, floor_of, map_of, on_shore, places


def at(place: float) -> Scene:
    """The sea with shore and eye this far from the origin, and the eye a little off the middle."""
    place = math.copysign(max(abs(place) - 300.0, 0.0), place)
    shore = SHORE.model_copy(update={"place": (place, -place)})
    return SEA.model_copy(update={"shore": shore, "camera": Camera(position=(place + 3.25, 9.0, -place - 1.5))})


def _formed(kind: str, refraction: bool) -> Shore:
    surf = SHORE.surf.model_copy(update={"refraction": refraction})
    return SHORE.model_copy(update={"kind": kind, "radius": 120.0 if kind == "lagoon" else 60.0, "surf": surf})


def coastlines() -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """20 random coastlines and the cases at the edge of having one; True is land."""
    size = 128
    for seed in range(20):
        random = np.random.default_rng(seed)
        rough = ndimage.gaussian_filter(random.standard_normal((size, size)), 1.0 + 0.7 * (seed % 10), mode="wrap")
        yield f"random {seed}", rough > np.quantile(rough, 0.2 + 0.03 * seed)

    def islands(*texels: int) -> NDArray[np.bool_]:
        land = np.zeros((size, size), np.bool_)
        land.flat[list(texels)] = True
        return land

    one = islands(37 * size + 91)
    yield "an island of one texel", one
    yield "a pond of one texel", ~one
    yield "two corners", islands(0, size * size - 1)
    few = np.random.default_rng(5).choice(size * size, 12, replace=False)
    yield "twelve islands of one texel", islands(*few)
    yield "all land", ~islands()
    yield "all water", islands()


def test_distances_are_scipys(executor: Executor, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    size = 128
    quality = EXACT.model_copy(update={"shore_map": size, "shore_floor": size})
    plan = make_plan(Scene(shore=SHORE.model_copy(update={"size": float(size), "smoothing": 0.0})), quality)
    genuine = executors.texture
    for name, land in coastlines():
        # The spline of the texels keeps their sign where they are told apart by much more than their neighbours.
        heights = sharpened(np.where(land, 1.0, -1.0))
        raw = np.stack((heights, np.zeros_like(heights)), axis=-1).astype("<f4").tobytes()
        data = TextureData(raw, hashlib.sha256(raw).hexdigest(), "RG32F", size, size, 1)
        monkeypatch.setattr(
            executors, "texture", lambda asked, d=data: d if isinstance(asked, ShoreFloor) else genuine(asked)
        )
        texture = plan.textures["shore_floor"].model_copy(update={"sha256": data.sha256})
        other = plan.model_copy(update={"textures": {**plan.textures, "shore_floor": texture}})
        away = np.abs(map_of(executor, other, "shore_rough")[..., 0] - maps.signed_distance(land))
        report.within(
            "Distance to shore by jump flooding against SciPy's exact transform, 128 × 128, texels",
            coast=name,
            share_off=float((away > 1e-3).mean()),
            worst=(away.max(), 1.0),
        )


def sharpened(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Texels whose quadratic spline is ``heights`` at the texels' centres."""
    matrix = np.zeros((heights.shape[0],) * 2)
    for i in range(matrix.shape[0]):
        for step, weight in ((-1, 0.125), (0, 0.75), (1, 0.125)):
            matrix[i, np.clip(i + step, 0, matrix.shape[0] - 1)] += weight
    inverse = np.linalg.inv(matrix)
    return inverse @ heights @ inverse.T


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("time", "refraction"), [(0.0, False), (12.5, False), (3600.0, True), (1e9, False)])
def test_the_map_is_the_references(
    executor: Executor, report: Report, kind: str, time: float, refraction: bool
) -> None:
    shore = _formed(kind, refraction)
    got = map_of(executor, make_plan(Scene(shore=shore), EXACT), "shore_map", time)
    away = np.abs(got - maps.shore_map(shore, time))
    # Flooding may name a second nearest point here and there; smoothing spreads what is left.
    report.within(
        "Map of a shore against float64: worst texel (periods, m, skew, share), and share of texels off by 0.001",
        kind=kind + (", refracted" if refraction else ""),
        time=time,
        worst=(away.max(), 0.05),
        off=((away > 1e-3).any(axis=-1).mean(), 0.005),
    )


def test_without_surf_texels_hold_the_spline_of_the_share(executor: Executor) -> None:
    shore = _formed("island", False)
    shore = shore.model_copy(update={"surf": shore.surf.model_copy(update={"height": 0.0})})
    plan = make_plan(Scene(shore=shore), EXACT)
    spline = maps.QuadraticSpline(map_of(executor, plan, "shore_map", 3.0)[..., 3:], shore.size)
    powers, count = map_of(executor, plan, "shore_share", 3.0), EXACT.shore_map
    assert powers.shape[:2] == (count, 3 * count)
    q = np.random.default_rng(4).uniform(-0.5, 0.5, (2, 4000)) * shore.size
    base = np.floor((q / shore.size + 0.5) * count).astype(int)
    x, z = (q / shore.size + 0.5) * count - base
    c = np.stack([powers[base[1], 3 * base[0] + k, :3] for k in range(3)])
    c = np.moveaxis(c, -1, 0)  # by the power of x, of z
    by_x, by_z = np.stack((x**0, x, x * x)), np.stack((z**0, z, z * z))
    value = np.einsum("ijr,ir,jr->r", c, by_x, by_z)
    along = np.einsum("ijr,ir,jr->r", c, np.stack((0 * x, x**0, 2 * x)), by_z) * count / shore.size
    expected, slopes = spline.all(*q)
    assert np.ptp(expected) > 0.9
    np.testing.assert_allclose(value, expected[:, 0], atol=1e-6)
    np.testing.assert_allclose(along, slopes[0, :, 0], atol=1e-6)


@pytest.mark.parametrize("place", [0.0, 1e7])
@pytest.mark.parametrize("time", [0.0, 12.5, 3600.0, 1e9])
def test_heights_and_slopes_at_ten_thousand_points(
    executor: Executor, report: Report, place: float, time: float
) -> None:
    scene = at(place)
    x, z = places(executor, scene)
    got = on_shore(executor, scene, "o_color = vec4(waves(p), 0.0);", time=time)
    sea = coast(scene, time)
    h_x, h_z = sea.gradient(x, z)
    high = np.abs(got[:, 0] - sea.height(x, z))
    steep = np.hypot(got[:, 1] - h_x, got[:, 2] - h_z)
    report.within(
        "Sea at a shore against float64, 10,000 points, height in m and slope",
        place=place,
        time=time,
        height=(high.max(), 2e-3),
        slope=(steep.max(), 1e-2),
        most_heights=(np.quantile(high, 0.99), 2e-4),
        most_slopes=(np.quantile(steep, 0.99), 1e-3),
    )


def test_no_wave_passes_its_bounds(executor: Executor) -> None:
    """The march relies on them; the mask is at its highest somewhere, some time."""
    for kind, refraction in (("islands", False), ("lagoon", True)):
        scene = Scene(shore=_formed(kind, refraction))
        uniforms = make_plan(scene, EXACT).uniforms
        top, steepest, _ = uniforms["u_surface_bounds"].rules[0].value
        for time in (0.0, 2.1, 5.3, 40.0):
            got = on_shore(executor, scene, "o_color = vec4(waves(p), 0.0);", time=time)
            assert (got[:, 0] >= 0.0).all()
            assert got[:, 0].max() <= top
            assert np.hypot(got[:, 1], got[:, 2]).max() <= steepest
        got = on_shore(executor, scene, "o_color = shore_floor(shore_place(p));")
        assert got[:, 0].max() <= uniforms["u_shore_top"].rules[0].value[0]
        slopes = np.hypot(got[:, 1], got[:, 2])
        floor, land = (rule.value[0] for rule in uniforms["u_shore_steepest"].rules)
        assert slopes.max() <= floor
        assert slopes[got[:, 0] > 0.0].max() <= land
        # Floats differ by 1e-4 of a slope at this distance.
        step = 0.05
        bends = [
            on_shore(
                executor,
                scene,
                f"vec2 way = {step} * vec2({math.cos(angle)}, {math.sin(angle)}); vec2 q = shore_place(p);"
                "o_color.x = dot(shore_floor(q + way).yz - shore_floor(q).yz, normalize(way));",
            )[:, 0]
            / step
            for angle in (0.0, 0.8, 1.6, 2.4)
        ]
        bend = uniforms["u_shore_bend"].rules[0].value[0]
        assert 0.05 * bend <= np.max(bends) <= bend + 1e-4 / step


SURF = SurfSaturation(line=1.0)
LINED = SEA.model_copy(update={"foam": Foam(saturation=(SURF,))})


@pytest.mark.parametrize("sides", [((0.0, 0.0), (0.0, 0.0)), ((0.8, 0.1), (-0.2, 0.5)), ((3.0, -2.0), (0.4, 0.6))])
def test_foam_of_the_surf(executor: Executor, report: Report, sides: tuple[tuple[float, float], ...]) -> None:
    """At points, and under footprints that the water's edge may cross."""
    edges = 0
    x, z = places(executor, LINED)
    footprint = f"Footprint({', '.join(f'vec2({a}, {b})' for a, b in sides)})"
    feet = tuple(np.tile(side, (x.size, 1)) for side in sides)
    for time in (0.0, 3600.0):
        body = f"Footprint fp = {footprint}; o_color.x = surf_saturation(p, waves_shading(p, fp).x, fp);"
        got = on_shore(executor, LINED, body, time=time)[:, 0]
        sea = coast(SEA, time)
        height = sea.height(x, z)
        want = np.minimum(sea.foam(SURF, x, z, height, (feet[0], feet[1])), 1.0)
        depth = height - sea.ground(*sea.place(x, z))[0]
        edges += int(np.count_nonzero((want > 0.0) & (depth < 0.5 * truth.EDGE[1])))
        assert want.max() > 0.9
        foam_is(report, got, want, f"surf under {sides[0]}, {sides[1]} m, {time:g} s")
    assert edges > 20


def foam_is(report: Report, got: NDArray[np.float64], want: NDArray[np.float64], what: str) -> None:
    away = np.abs(got - want)
    title = "Foam at a shore against float64, 10,000 points"
    report.within(title, foam=what, worst=(away.max(), 0.05), most=(np.quantile(away, 0.99), 1e-3))


def test_ground_and_the_way_through_the_water(executor: Executor, report: Report) -> None:
    x, z = places(executor, SEA)
    look = "vec3 d = normalize(vec3(p.y, -40.0, p.x)); vec3 n = normalize(vec3(0.1, 1.0, -0.05)); vec2 there;"
    feet = np.full((x.size, 2), 0.02)
    d = unit(np.stack((z, np.full_like(x, -40.0), x), axis=-1))
    n = np.broadcast_to(unit(np.array([[0.1, 1.0, -0.05]])), d.shape)
    albedo, path = floor_of(coast(SEA, 0.0).seen(x, z, np.full_like(x, 0.3), d, n, (feet, feet)))
    body = look + "o_color = vec4(floor_path(shore_place(p), 0.3, d, n, there), there, 0.0);"
    paths = {}
    for steps in (1, 2, 4, 8, 16):
        quality = EXACT.model_copy(update={"refraction_steps": steps})
        paths[steps] = np.abs(on_shore(executor, SEA, body, quality=quality)[:, 0] - path)
    body = look + "floor_path(shore_place(p), 0.3, d, n, there);"
    body += "o_color = vec4(floor_albedo(there, shore_floor(there), Footprint(vec2(0.02), vec2(0.02))), 0.0);"
    tint = np.abs(on_shore(executor, SEA, body)[:, :3] - albedo).max(axis=1)
    assert path.max() > 15.0
    assert all(paths[2 * steps].mean() < 0.6 * paths[steps].mean() for steps in (1, 2, 4, 8))
    report.within(
        "Way of the light, m, and colour of the floor against float64",
        worst_of_16_steps=(paths[16].max(), 1e-2),
        most=(np.quantile(paths[16], 0.99), 1e-3),
        albedo=(np.quantile(tint, 0.99), 1e-3),
    )
