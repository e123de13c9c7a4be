"""The shore against float64: distances, map, waves, foam, ground, way through water (docs/formulae.md, section 8).

Where a closed form does not exist, the reference has the same grids of texels and the same splines between them as the
shaders: they are part of the model. Its distances are SciPy's exact ones.
"""

import hashlib
import itertools
import math
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.framegraph.passes import State
from seafoam.framegraph.shader import Program, Shader
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import Quality
from seafoam.reference.light.light import unit
from seafoam.reference.shore import maps
from seafoam.reference.shore import shore as truth
from seafoam.render.gl import executor as executors
from seafoam.render.gl.executor import Executor
from seafoam.textures import ShoreFloor, TextureData
from support.exact import EXACT
from support.pictures import draw, draw_target
from support.probe import WHOLE
from support.report import Report
from support.scenes import Camera, Foam, Scene, Shore, SurfSaturation
from support.scenes.coasts import KINDS, SEA, SHORE, coast, png

SIDE = 100
"""Points along each side of a probe: 10,000 in all."""


def patched(plan: FramePlan, main: str, name: str = "surface") -> FramePlan:
    """The plan with another main function in its surface's shader, or with that of another program in its place."""
    program = plan.programs[name]
    old = program.fragment.text
    assert old.count("void main()") == 1
    text = old.replace("void main()", "void drawn_main()") + main
    fragment = Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=())
    # All over the target, not under the horizon alone.
    programs = {**plan.programs, "surface": Program(vertex=WHOLE, fragment=fragment)}
    kept = [one for one in plan.passes if one.program not in ("sky", "land", "land, shown")]
    first = next(index for index, one in enumerate(kept) if one.program == "surface")
    kept[first] = kept[first].model_copy(update={"state": State(depth=True, clear=True)})
    return plan.model_copy(update={"programs": programs, "passes": tuple(kept)})


def probe(
    executor: Executor, scene: Scene, body: str, time: float = 0.0, quality: Quality = EXACT, name: str = "surface"
) -> NDArray[np.float64]:
    """(10,000, 4): what ``body`` (reads ``vec2 p``, m from the eye; sets o_color) gives all over the square."""
    assert scene.shore is not None
    main = f"""
void main() {{
    float i = floor(gl_FragCoord.y) * {SIDE}.0 + floor(gl_FragCoord.x) + 1.0;
    vec2 p = (fract(i * vec2(0.754877666, 0.569840291)) - 0.5) * {1.04 * scene.shore.size:.1f};
    {body}
}}
"""
    plan = patched(make_plan(scene, quality), main, name)
    camera = scene.camera
    pixels = draw(executor, plan, camera, time=time, size=(SIDE, SIDE), output="samples")
    return pixels.reshape(-1, 4).astype(np.float64)


def places(executor: Executor, scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    found = probe(executor, scene, "o_color = vec4(p, 0.0, 0.0);")
    return found[:, 0], found[:, 1]


def at(place: float) -> Scene:
    """The sea with shore and eye this far from the origin, and the eye a little off the middle."""
    place = math.copysign(max(abs(place) - 300.0, 0.0), place)
    shore = SHORE.model_copy(update={"place": (place, -place)})
    return SEA.model_copy(update={"shore": shore, "camera": Camera(position=(place + 3.25, 9.0, -place - 1.5))})


def drawn(executor: Executor, plan: FramePlan, target: str, time: float = 0.0) -> NDArray[np.float32]:
    """What the passes leave in a target; rows from z = 0."""
    # In every frame, so that nothing is kept and each target can be read.
    passes = tuple(one.model_copy(update={"when": "frame"}) for one in plan.passes)
    return draw_target(executor, plan.model_copy(update={"passes": passes, "kept": {}}), target, time)


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
    one = np.zeros((size, size), np.bool_)
    one[37, 91] = True
    yield "an island of one texel", one
    yield "a pond of one texel", ~one
    corners = np.zeros_like(one)
    corners[0, 0] = corners[-1, -1] = True
    yield "two corners", corners
    few = np.zeros_like(one)
    few.flat[np.random.default_rng(5).choice(size * size, 12, replace=False)] = True
    yield "twelve islands of one texel", few
    yield "all land", np.ones_like(one)
    yield "all water", np.zeros_like(one)


def test_distances_are_scipys(executor: Executor, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    size = 128
    quality = EXACT.model_copy(update={"shore_map": size, "shore_floor": size})
    shore = SHORE.model_copy(update={"size": float(size), "smoothing": 0.0})
    plan = make_plan(Scene(shore=shore), quality)
    genuine = executors.texture
    for name, land in coastlines():
        # The spline of the texels keeps their sign where they are told apart by much more than their neighbours.
        heights = np.where(land, 1.0, -1.0)
        grid = np.stack((sharpened(heights), np.zeros_like(heights)), axis=-1).astype("<f4")
        raw = grid.tobytes()
        sha = hashlib.sha256(raw).hexdigest()
        data = TextureData(raw, sha, "RG32F", size, size, 1)
        monkeypatch.setattr(
            executors, "texture", lambda asked, d=data: d if isinstance(asked, ShoreFloor) else genuine(asked)
        )
        texture = plan.textures["shore_floor"].model_copy(update={"sha256": sha})
        changed = plan.model_copy(update={"textures": {**plan.textures, "shore_floor": texture}})
        got = drawn(executor, changed, "shore_rough")[..., 0]
        want = maps.signed_distance(land)
        worst = float(np.abs(got - want).max())
        report.add(
            "Distance to shore by jump flooding against SciPy's exact transform, 128 × 128",
            coast=name,
            worst=f"{worst:.3f} texels",
            off=f"{100 * float((np.abs(got - want) > 1e-3).mean()):.3f} %",
        )
        assert np.isfinite(got).all()
        assert worst <= 1.0, name


def sharpened(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Texels whose quadratic spline is ``heights`` at the texels' centres."""
    matrix = np.zeros((heights.shape[0],) * 2)
    for i in range(matrix.shape[0]):
        for step, weight in ((-1, 0.125), (0, 0.75), (1, 0.125)):
            matrix[i, np.clip(i + step, 0, matrix.shape[0] - 1)] += weight
    inverse = np.linalg.inv(matrix)
    result: NDArray[np.float64] = inverse @ heights @ inverse.T
    return result


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("time", "refraction"), [(0.0, False), (12.5, False), (3600.0, True), (1e9, False)])
def test_the_map_is_the_references(
    executor: Executor, report: Report, kind: str, time: float, refraction: bool
) -> None:
    shore = _formed(kind, refraction)
    got = drawn(executor, make_plan(Scene(shore=shore), EXACT), "shore_map", time)
    want = maps.shore_map(shore, time)
    away = np.abs(got - want)
    report.add(
        "Map of a shore against float64: worst texel (periods, m, skew, share), and share of texels off by 0.001",
        kind=kind + (", refracted" if refraction else ""),
        time=f"{time:g} s",
        worst=" ".join(f"{value:.1e}" for value in away.max(axis=(0, 1))),
        off=f"{100 * float((away > 1e-3).any(axis=-1).mean()):.3f} %",
    )
    # Flooding may name a second nearest point here and there; smoothing spreads what is left.
    assert away.max() <= 0.05
    assert (away > 1e-3).any(axis=-1).mean() <= 0.005


@pytest.mark.parametrize("place", [0.0, 1e7])
@pytest.mark.parametrize("time", [0.0, 12.5, 3600.0, 1e9])
def test_heights_and_slopes_at_ten_thousand_points(
    executor: Executor, report: Report, place: float, time: float
) -> None:
    scene = at(place)
    x, z = places(executor, scene)
    got = probe(executor, scene, "o_color = vec4(waves(p), 0.0);", time)
    sea = coast(scene, time)
    H = sea.height(x, z)
    h_x, h_z = sea.gradient(x, z)
    high = np.abs(got[:, 0] - H)
    steep = np.hypot(got[:, 1] - h_x, got[:, 2] - h_z)
    report.add(
        "Sea at a shore against float64, 10,000 points",
        place=f"{place:g} m",
        time=f"{time:g} s",
        height=f"{high.max():.1e} m",
        slope=f"{steep.max():.1e}",
        of=f"{H.max():.2f} m, {np.hypot(h_x, h_z).max():.2f}",
    )
    assert high.max() <= 2e-3
    assert steep.max() <= 1e-2
    assert np.quantile(high, 0.99) <= 2e-4
    assert np.quantile(steep, 0.99) <= 1e-3


def test_no_wave_passes_its_bounds(executor: Executor) -> None:
    """The march relies on them; the mask is at its highest somewhere, some time."""
    for kind, refraction in itertools.product(KINDS, (False, True)):
        scene = Scene(shore=_formed(kind, refraction))
        uniforms = make_plan(scene, EXACT).uniforms
        top, steepest, _ = uniforms["u_surface_bounds"].rules[0].value  # type: ignore[union-attr]
        for time in (0.0, 2.1, 5.3, 40.0):
            got = probe(executor, scene, "o_color = vec4(waves(p), 0.0);", time)
            assert (got[:, 0] >= 0.0).all()
            assert got[:, 0].max() <= top
            assert np.hypot(got[:, 1], got[:, 2]).max() <= steepest
        got = probe(executor, scene, "o_color = shore_floor(shore_place(p));")
        assert got[:, 0].max() <= uniforms["u_shore_top"].rules[0].value[0]  # type: ignore[union-attr]
        slopes = np.hypot(got[:, 1], got[:, 2])
        floor, land = (rule.value[0] for rule in uniforms["u_shore_steepest"].rules)  # type: ignore[union-attr]
        assert slopes.max() <= floor
        assert slopes[got[:, 0] > 0.0].max() <= land
        # Floats differ by 1e-4 of a slope at this distance.
        step = 0.05
        bends = [
            probe(
                executor,
                scene,
                f"vec2 way = {step} * vec2({math.cos(angle)}, {math.sin(angle)}); vec2 q = shore_place(p);"
                "o_color.x = dot(shore_floor(q + way).yz - shore_floor(q).yz, normalize(way));",
            )[:, 0]
            / step
            for angle in (0.0, 0.8, 1.6, 2.4)
        ]
        bend = uniforms["u_shore_bend"].rules[0].value[0]  # type: ignore[union-attr]
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
        got = probe(executor, LINED, body, time)[:, 0]
        sea = coast(SEA, time)
        height = sea.height(x, z)
        want = np.minimum(sea.foam(SURF, x, z, height, (feet[0], feet[1])), 1.0)
        depth = height - sea.ground(*sea.place(x, z))[0]
        edges += int(np.count_nonzero((want > 0.0) & (depth < 0.5 * truth.EDGE[1])))
        away = np.abs(got - want)
        report.add(
            "Surf foam against float64, 10,000 points",
            time=f"{time:g} s",
            footprint=f"{sides[0]}, {sides[1]} m",
            worst=f"{away.max():.1e}",
        )
        assert want.max() > 0.9
        assert away.max() <= 0.05
        assert np.quantile(away, 0.99) <= 1e-3
    assert edges > 20


def test_foam_on_the_ground(executor: Executor, report: Report) -> None:
    """At points, and under footprints in which a wave ends."""
    x, z = places(executor, LINED)
    sea = coast(SEA, 0.0)
    ground = sea.ground(*sea.place(x, z))[0]
    for side in (0.0, 1.5):
        body = (
            f"Footprint fp = Footprint(vec2({side}, 0.0), vec2(0.0, {side})); vec2 q = shore_place(p);"
            "o_color.x = surf_swept(shore_field(q), shore_floor(q).x, surf_patches(q, "
            "Footprint(vec2(0.0), vec2(0.0))), fp);"
        )
        got = probe(executor, LINED, body)[:, 0]
        feet = np.tile((side, 0.0), (x.size, 1)), np.tile((0.0, side), (x.size, 1))
        want = sea.swash_foam(SURF, x, z, ground, feet)
        away = np.abs(got - want)
        report.add("Foam on the sand against float64, 10,000 points", side=f"{side} m", worst=f"{away.max():.1e}")
        assert want.max() > 0.5
        assert away.max() <= 0.05
        assert np.quantile(away, 0.99) <= 1e-3


def test_ground_and_the_way_through_the_water(executor: Executor, report: Report) -> None:
    x, z = places(executor, SEA)
    sea = coast(SEA, 0.0)
    look = "vec3 d = normalize(vec3(p.y, -40.0, p.x)); vec3 n = normalize(vec3(0.1, 1.0, -0.05)); vec2 there;"
    feet = np.full((x.size, 2), 0.02)
    d = unit(np.stack((z, np.full_like(x, -40.0), x), axis=-1))
    n = np.broadcast_to(unit(np.array([[0.1, 1.0, -0.05]])), d.shape)
    floor = sea.bed(x, z, np.full_like(x, 0.3), d, n, (feet, feet))
    way, albedo = floor.path, floor.albedo
    body = look + "o_color = vec4(floor_path(shore_place(p), 0.3, d, n, there), there, 0.0);"
    paths = {}
    for steps in (1, 2, 4, 8, 16):
        quality = EXACT.model_copy(update={"refraction_steps": steps})
        paths[steps] = np.abs(probe(executor, SEA, body, quality=quality)[:, 0] - way)
    fp = "Footprint(vec2(0.02), vec2(0.02))"
    body = look + "floor_path(shore_place(p), 0.3, d, n, there);"
    colour = probe(executor, SEA, body + f"o_color = vec4(floor_albedo(there, shore_floor(there), {fp}), 0.0);")
    tint = np.abs(colour[:, :3] - albedo).max(axis=1)
    report.add(
        "Way of the light and colour of the floor against float64",
        **{f"{steps} steps": f"{path.max():.1e} m" for steps, path in paths.items()},
        albedo=f"{tint.max():.1e}",
    )
    assert way.max() > 15.0
    assert all(paths[2 * steps].mean() < 0.6 * paths[steps].mean() for steps in (1, 2, 4, 8))
    assert paths[16].max() <= 1e-2
    assert np.quantile(paths[16], 0.99) <= 1e-3
    assert np.quantile(tint, 0.99) <= 1e-3


def test_a_drawn_picture_is_the_references(executor: Executor) -> None:
    random = np.random.default_rng(8)
    grey = ndimage.zoom(random.random((6, 6)), 8, order=1)
    scene = Scene(
        shore=Shore(kind="image", image=png((255 * grey).astype(np.uint8)), size=300.0, depth=8.0, height=8.0)
    )
    x, z = places(executor, scene)
    got = probe(executor, scene, "o_color = shore_floor(shore_place(p));")
    want = coast(scene, 0.0).ground(x, z)
    assert np.abs(got - np.stack(want, axis=-1)).max() <= 1e-3
