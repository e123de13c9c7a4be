"""What frames and model of a preset are measured for docs/nature.md: foam, waves, slopes, glitter, light and decay.

Nothing here knows what nature has. Places and times are random, the same in each run.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from docs.make_whitecaps import THIN
from numpy.typing import NDArray
from scipy.ndimage import label
from scipy.optimize import least_squares

from seafoam.ocean.basics.spectrum import frequency_spectrum, peak_frequency
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.waves.cascades import LOOP
from seafoam.planner import make_geometry_plan, make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, Light, Preset, Scene, direction

Floats = NDArray[np.float64]
FrameSize = tuple[int, int]

QUALITY = TIERS["standard"]
"""What the page and the server draw unless asked otherwise."""
SQUARES, SQUARE = 12, 384
"""Pictures from straight above, and pixels along their sides."""
WIDEST, NARROWEST, WAVELENGTHS = 300.0, 40.0, 5.0
"""Side of such a picture, m: so many wavelengths of the longest wave, within limits."""
OWN, OWN_EVERY, OWN_SIZE = 8, 11.3, (320, 180)
"""Frames of the preset's own camera, s from one to the next, pixels."""
AERIAL, AERIAL_SIZE, AERIAL_HEIGHT = 4, 240, 300.0
AERIAL_FOV, AERIAL_SUN = 1.9, 1.2
"""Field of view of the pictures of the glitter and elevation of their sun, rad: it lies 0.37 rad off their middle."""
PATHS, PATH_SIZE, PATH_FOV = 10, (384, 216), 0.9
FILMED, FILM_STEP, FILM_SIDE, FILM_PIXEL = 50, 0.4, 256, 0.75
"""Pictures of the film from above, s from one to the next, pixels along a side, m a pixel."""
COVERED = 0.5
"""Foam amount from which a pixel is a patch's, as in docs/whitecaps.md."""
LIT, LIT_SIDE, LIT_SIZE = 6, 80.0, 320
DENSE = 0.97
LEAST_AREA = 10.0
"""Least greatest area of a patch whose decay is measured, m²."""


@dataclass(frozen=True)
class Place:
    """Where and when a picture is taken."""

    x: float
    z: float
    time: float


def places(number: int, seed: int) -> Iterator[Place]:
    """Random places within 2 km of the origin and times of the sea's period."""
    random = np.random.default_rng(seed)
    for x, z, time in random.uniform((-2e3, -2e3, 0.0), (2e3, 2e3, LOOP), (number, 3)):
        yield Place(float(x), float(z), float(time))


def from_above(place: Place, side: float, height: float = 300.0) -> Camera:
    """A camera over a square of that side, m."""
    return Camera(position=(place.x, height, place.z), pitch=-0.5 * math.pi, fov=2.0 * math.atan(0.5 * side / height))


def frame(executor: Executor, scene: Scene, camera: Camera, time: float, size: FrameSize) -> Floats:
    """A linear frame, (height, width, 4): R, G, B, foam amount."""
    plan = make_plan(scene, QUALITY)
    drawn = executor.render(plan, time=time, camera=camera, width=size[0], height=size[1], output="linear")
    return drawn.pixels.astype(np.float64)


def distances(executor: Executor, scene: Scene, camera: Camera, time: float, size: FrameSize) -> Floats:
    """Distance of what each pixel shows, m, (height, width); 0: sky."""
    plan = make_geometry_plan(scene, QUALITY)
    drawn = executor.render(plan, time=time, camera=camera, width=size[0], height=size[1], output="linear")
    return drawn.pixels[..., 3].astype(np.float64)


def water_of(scene: Scene, **changed: Any) -> Scene:
    """The scene's open water: no boats, spray, rings or land."""
    bare: dict[str, Any] = {"boats": (), "spray": None, "rings": (), "shore": None}
    return scene.model_copy(update=bare | changed)


def wave_periods(scene: Scene) -> list[tuple[float, float]]:
    """Period, s, and variance, m², of each single wave and of the sea at its steps of frequency.

    Groups are not in the variance: all waves have them alike.
    """
    phase = (np.arange(4096) + 0.5) * (2.0 * math.pi / 4096)
    found = []
    for wave in scene.waves:
        speed = math.sqrt(GRAVITY * wave.wavelength / (2.0 * math.pi)) if wave.speed is None else wave.speed
        heights = wave.amplitude * (0.5 * (np.sin(phase) + 1.0)) ** wave.exponent
        found.append((wave.wavelength / speed, float(heights.var())))
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        peak = peak_frequency(scene.sea.wind_speed, scene.sea.fetch)
        edges = np.geomspace(0.5 * peak, 8.0 * peak, 400)
        middles = np.sqrt(edges[1:] * edges[:-1])
        energy = frequency_spectrum(middles, scene.sea.wind_speed, scene.sea.fetch) * np.diff(edges)
        found += [(float(2.0 * math.pi / omega), float(part)) for omega, part in zip(middles, energy, strict=True)]
    return found


def peak_period(scene: Scene) -> float:
    """Period of the third of an octave with the greatest variance, s, its energy's mean."""
    parts = np.array(wave_periods(scene))
    octaves = np.log2(parts[:, 0])
    inside = np.abs(octaves[:, None] - octaves[None, :]) < 1.0 / 6.0
    best = inside[int(np.argmax(inside @ parts[:, 1]))]
    return float(np.average(parts[best, 0], weights=parts[best, 1]))


def square_side(scene: Scene) -> float:
    """Side of the pictures from above, m."""
    longest = GRAVITY * peak_period(scene) ** 2 / (2.0 * math.pi)
    return min(max(WAVELENGTHS * longest, NARROWEST), WIDEST)


def seen_from_above(executor: Executor, scene: Scene) -> dict[str, float]:
    """Share of foam with its standard error, and significant height, m, as drawn, of squares from straight above."""
    unlit, lit, side = water_of(scene, light=None), water_of(scene), square_side(scene)
    shares, squares = [], []
    for place in places(SQUARES, 1):
        camera = from_above(place, side)
        size = (SQUARE, SQUARE)
        if scene.foam is not None:
            shares.append(float(frame(executor, unlit, camera, place.time, size)[..., 3].mean()))
        at = (np.arange(SQUARE // 2) + 0.5) / (SQUARE // 2) - 0.5
        slant = np.hypot(np.hypot(*np.meshgrid(at, at)) * side, 300.0) / 300.0
        heights = 300.0 - distances(executor, lit, camera, place.time, (SQUARE // 2, SQUARE // 2)) / slant
        squares.append(heights)
    return {"height": 4.0 * float(np.std(squares))} | (with_error("above", shares) if shares else {})


def with_error(name: str, values: Sequence[float]) -> dict[str, float]:
    """Their mean and its standard error."""
    return {name: float(np.mean(values)), f"{name}_error": float(np.std(values, ddof=1) / math.sqrt(len(values)))}


def seen_by_own_camera(executor: Executor, preset: Preset) -> dict[str, float]:
    """Share of foam of the water's pixels, the mean of frames from the preset's time on."""
    unlit = water_of(preset.scene, light=None)
    shares = []
    for number in range(OWN):
        time = preset.time + number * OWN_EVERY
        foam = frame(executor, unlit, preset.scene.camera, time, OWN_SIZE)[..., 3]
        water = distances(executor, unlit, preset.scene.camera, time, OWN_SIZE) > 0.0
        shares.append(float(foam[water].mean()))
    return with_error("own", shares)


def rays(camera: Camera, size: FrameSize) -> Floats:
    """Unit vectors of the pixels' centres, (height, width, 3), of a camera without roll."""
    width, height = size
    up = math.tan(0.5 * camera.fov) * (1.0 - 2.0 * (np.arange(height) + 0.5) / height)
    right = math.tan(0.5 * camera.fov) * width / height * (2.0 * (np.arange(width) + 0.5) / width - 1.0)
    right, up = np.meshgrid(right, up)
    sine, cosine = math.sin(camera.pitch), math.cos(camera.pitch)
    level, rise = cosine - up * sine, sine + up * cosine
    x = right * math.cos(camera.yaw) + level * math.sin(camera.yaw)
    z = right * math.sin(camera.yaw) - level * math.cos(camera.yaw)
    found = np.stack([x, rise, z], axis=-1)
    result: Floats = found / np.linalg.norm(found, axis=-1, keepdims=True)
    return result


def fresnel(cosine: Floats) -> Floats:
    """Reflectance of water for unpolarised light, index 1.333."""
    inside = np.sqrt(1.0 - (1.0 - cosine**2) / 1.333**2)
    across = (cosine - 1.333 * inside) / (cosine + 1.333 * inside)
    along = (inside - 1.333 * cosine) / (inside + 1.333 * cosine)
    result: Floats = 0.5 * (across**2 + along**2)
    return result


def glitter(view: Floats, sun: Sequence[float], heading: float, variances: Sequence[float]) -> Floats:
    """Radiance of the sun's glitter over its irradiance, as Cox and Munk (1954) have it; 0 over the horizon.

    view: unit vectors from the eye; heading: of the wind, rad; variances of the slopes along and
    across it. Facets neither hide nor shade one another.
    """
    facing = np.asarray(sun) - view
    facing /= np.linalg.norm(facing, axis=-1, keepdims=True)
    below = view[..., 1] < 0.0
    upright, down = np.where(below, facing[..., 1], 1.0), np.where(below, -view[..., 1], 1.0)
    slope_x, slope_z = -facing[..., 0] / upright, -facing[..., 2] / upright
    along = slope_x * math.cos(heading) + slope_z * math.sin(heading)
    across = slope_z * math.cos(heading) - slope_x * math.sin(heading)
    exponent = -0.5 * (along**2 / variances[0] + across**2 / variances[1])
    density = np.exp(exponent) / (2.0 * math.pi * math.sqrt(variances[0] * variances[1]))
    mirrored = fresnel(np.clip(facing @ np.asarray(sun), 0.0, 1.0))
    result: Floats = np.where(below, mirrored * density / (4.0 * down * upright**4), 0.0)
    return result


def slope_variances(executor: Executor, scene: Scene, heading: float) -> tuple[float, float]:
    """Variances of slopes along and across the wind, read from the glitter in pictures from above."""
    light = Light(sun_azimuth=0.4, sun_elevation=AERIAL_SUN, turbidity=1.5, visibility=1e6)
    lit, size = water_of(scene, foam=None, light=light), (AERIAL_SIZE, AERIAL_SIZE)
    pictures, view = [], Camera()
    for place in places(AERIAL, 2):
        view = Camera(position=(place.x, AERIAL_HEIGHT, place.z), pitch=-0.5 * math.pi, fov=AERIAL_FOV)
        pictures.append(frame(executor, lit, view, place.time, size)[..., 0])
    return fitted_variances(np.mean(pictures, axis=0), rays(view, size), direction(*light.sun), heading)


def fitted_variances(picture: Floats, view: Floats, sun: Sequence[float], heading: float) -> tuple[float, float]:
    """Variances of slopes along and across the wind with which :func:`glitter` is most like a picture.

    As Cox and Munk did it, with the light of sky and water as a constant. picture: (height, width), view its rays.
    """
    scale = float(picture.max())

    def off(guess: Floats) -> Floats:
        model = guess[2] * glitter(view, sun, heading, (math.exp(guess[0]), math.exp(guess[1]))) + guess[3]
        result: Floats = (model - picture / scale).ravel()
        return result

    first = (0.02, 0.02)
    strength = 1.0 / float(glitter(view, sun, heading, first).max())
    fitted = least_squares(off, np.array([*np.log(first), strength, 0.0])).x
    return float(math.exp(fitted[0])), float(math.exp(fitted[1]))


def path_view(lamp: tuple[float, float]) -> tuple[Camera, Floats]:
    """A camera that looks at the water below a lamp, (azimuth, elevation) rad, and its rays."""
    camera = Camera(yaw=math.remainder(lamp[0] + 0.5 * math.pi, 2.0 * math.pi), pitch=-lamp[1], fov=PATH_FOV)
    return camera, rays(camera, PATH_SIZE)


def path_width(executor: Executor, preset: Preset, lamp: tuple[float, float]) -> float:
    """Width of the glitter's path toward sun or moon from the preset's own height: see :func:`equivalent_width`."""
    scene = preset.scene
    assert scene.light is not None
    camera, view = path_view(lamp)
    camera = camera.model_copy(update={"position": scene.camera.position})
    sky = scene.light.sky
    # The glow around a low lamp is mirrored too, and is no glitter.
    clear = sky and sky.model_copy(update={"haze": 0.0, "clouds": None, "cirrus": None, "stars": 0.0})
    plain = {"glare": 0.0, "sparkles": None, "reflection": "sky", "turbidity": 1.0, "visibility": 1e6, "sky": clear}
    lit = water_of(scene, foam=None, light=scene.light.model_copy(update=plain))
    pictures = [
        frame(executor, lit, camera, preset.time + number * OWN_EVERY, PATH_SIZE)[..., :3].sum(axis=-1)
        for number in range(PATHS)
    ]
    return equivalent_width(np.mean(pictures, axis=0), view, lamp)


def equivalent_width(picture: Floats, view: Floats, lamp: tuple[float, float]) -> float:
    """Width of a path of glitter as far below the horizon as its lamp is above it, rad of azimuth.

    The light over that of the rows' sides, by azimuth, over its greatest value: 2.5 deviations of a bell curve.
    """
    depth = -np.arcsin(view[..., 1])
    azimuth = np.arctan2(view[..., 2], view[..., 0])
    aside = np.remainder(azimuth - lamp[0] + math.pi, 2.0 * math.pi) - math.pi
    chosen = (depth > 0.75 * lamp[1]) & (depth < 1.25 * lamp[1])
    edges = np.linspace(-0.6, 0.6, 49)
    bins = np.digitize(aside[chosen], edges)
    sums = np.bincount(bins, weights=picture[chosen], minlength=50)[1:49]
    means = sums / np.maximum(np.bincount(bins, minlength=50)[1:49], 1)
    profile = means - 0.5 * (means[:4].mean() + means[-4:].mean())
    return float(profile.sum() * (edges[1] - edges[0]) / profile.max())


def reflectances(executor: Executor, preset: Preset) -> dict[str, float]:
    """Reflectance of foam from straight above: of pixels full of foam, and the mean of those with any foam.

    A sheet of white paper is the same foam, opaque and matt, of albedo 1. The second is what foam adds to the mean
    light over what paper would send.
    """
    scene = water_of(preset.scene)
    assert scene.foam is not None
    paper = scene.foam.model_copy(update={"scattering": None, "thickness": 0.0, "albedo": 1.0, "texture": 0.0})
    clear = scene.water.model_copy(update={"aeration": 0.0})
    scenes = (scene, scene.model_copy(update={"foam": paper, "water": clear}), scene.model_copy(update={"foam": None}))
    dense: list[tuple[float, float]] = []
    added, area = 0.0, 0.0
    for place in places(LIT, 4):
        camera = from_above(place, LIT_SIDE)
        own, white, bare = (frame(executor, one, camera, place.time, (LIT_SIZE, LIT_SIZE)) for one in scenes)
        full = white[..., 3] >= DENSE
        dense += zip(own[full, 1], white[full, 1], strict=True)
        added += float((own[..., 1] - bare[..., 1]).sum())
        area += float((white[..., 3] >= THIN).sum())
    of, on = np.array(dense).T
    level = float(np.mean(on))
    return {"dense": float(np.mean(of) / level), "effective": added / area / level, "pixels": len(of)}


def decay_times(executor: Executor, scene: Scene) -> Floats:
    """Decay times of patches of foam filmed from straight above, s."""
    unlit = water_of(scene, light=None)
    camera = from_above(Place(0.0, 0.0, 0.0), FILM_SIDE * FILM_PIXEL)
    size = (FILM_SIDE, FILM_SIDE)
    film = [frame(executor, unlit, camera, i * FILM_STEP, size)[..., 3] >= COVERED for i in range(FILMED)]
    return patch_times(np.stack(film), FILM_STEP, LEAST_AREA / FILM_PIXEL**2)


def patch_times(film: NDArray[np.bool_], step: float, least: float) -> Floats:
    """Decay times of the patches of foam in a film, in the unit of its step.

    A patch is what is connected in the film, over pixels and pictures, and neither begins nor ends it nor touches its
    sides. Its time is the area after the greatest, summed over time, over the greatest: of an exponential, that to 1/e.
    film: (pictures, height, width); least: greatest area of the smallest patch that counts, pixels.
    """
    names, count = label(film, structure=np.ones((3, 3, 3)))
    sides = (names[0], names[-1], names[:, 0], names[:, -1], names[:, :, 0], names[:, :, -1])
    cut = np.unique(np.concatenate([side.ravel() for side in sides]))
    areas = np.stack([np.bincount(one.ravel(), minlength=count + 1) for one in names], axis=1)
    areas[cut] = 0
    afters = [area[int(np.argmax(area)) :] for area in areas[areas.max(axis=1) >= least]]
    return np.array([(after.sum() - 0.5 * after[0]) * step / after[0] for after in afters])
