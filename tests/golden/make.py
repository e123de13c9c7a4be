"""Writes the golden vectors, which hold the web client and the package to each other; run it as a script.

``uniform_rules``: what the rules of uniforms give. ``views``: which passes are drawn. ``flip``: pictures of linear
light and their mean FLIP. ``foam_strips``: formulas of the chapter on foam. ``picks``: which place of still water a
pixel shows.
"""

import json
import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seafoam.accuracy import metrics
from seafoam.framegraph.evaluation import FrameState, evaluate_rule
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import TargetInput
from seafoam.framegraph.rules import CameraRule, Clamp, Constant, Loop, Phase, Rule, Viewport, Wrap
from seafoam.framegraph.visibility import drawn_passes
from seafoam.masks.catalogue import mask_by_name
from seafoam.masks.formats import quantised
from seafoam.masks.judge.spectrum import measure_spectrum
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import sampling
from seafoam.reference.foam import front, looks
from seafoam.reference.noise import pcg
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.sources import height_saturation
from seafoam.scene import Camera, Look, ToneCurve, load_preset

Vectors = list[dict[str, Any]]

RULES: list[Rule] = [
    Constant(value=(0.0, -1.5, 1e-7)),
    Phase(offset=0.3, rate=2.1, k=(-0.4, 0.7)),
    Phase(offset=-5.9, rate=17.003, k=(62.8, -0.001)),
    Phase(offset=math.pi, rate=0.0, k=(0.0, 0.0)),
    Wrap(k=(0.07, 0.02)),
    Wrap(k=(-1.0, 0.0), offset=0.25, period=3.7),
    Wrap(k=(0.3, -0.2), period=256.0, rate=-1.7),
    Loop(period=60.0),
    Loop(period=0.1),
    Loop(period=7.3, offset=-2.25),
    Loop(period=7.3, offset=-2.25, step=0.7),
    Clamp(offset=-1e9, rate=1.0, low=0.0, high=55.3),
    Clamp(offset=-3.5, k=(-1.0, 0.0), low=-1e8, high=1e8),
    Clamp(offset=12.0, rate=-0.25, k=(0.0, 1.0), low=-40.0, high=9.0),
    *(CameraRule(what=what) for what in ("eye_height", "ray_x", "ray_y", "ray_z")),
    CameraRule(what="view_projection", top=2.3),
    CameraRule(what="view_projection", top=50.0),
    Viewport(),
    Viewport(times=2),
    Viewport(of="picture", times=4),
]

STATES = [
    (0.0, Camera(), 320, 180, 320, 180),
    (12.5, Camera(position=(3.0, 1.7, -8.0), yaw=0.9, pitch=-0.4, roll=0.1, fov=1.1), 1280, 720, 256, 256),
    (1e9, Camera(position=(1e7, 30.0, -1e7), yaw=-3.0, pitch=1.5708, fov=0.3), 1, 4096, 4, 16384),
    (-1e9, Camera(position=(-1e7, -2.0, 123.456), yaw=6.0, pitch=-1.5708, roll=-3.0, fov=2.5), 390, 844, 780, 1688),
    (1e9 + 1e-6, Camera(position=(-1e-12, 6.0, 1e-12)), 333, 77, 333, 77),
]


def uniform_rules() -> Vectors:
    """One entry a rule and state."""
    entries: Vectors = []
    for rule, (time, camera, width, height, target_width, target_height) in product(RULES, STATES):
        sizes = {"width": width, "height": height, "target_width": target_width, "target_height": target_height}
        given = {"time": time, "camera": camera, **sizes}
        state = FrameState(**given)
        told = given | {"camera": camera.model_dump(mode="json")}
        entries.append({"rule": rule.model_dump(mode="json"), "state": told, "value": list(evaluate_rule(rule, state))})
    return entries


PLANS = (("default", "standard"), ("boat-race", "standard"), ("boat-in-storm", "fast"), ("island-surf", "standard"))
VIEWS = (
    Camera(),
    Camera(position=(0.0, 60.0, 0.0), pitch=-math.pi / 2),
    Camera(position=(0.0, 60.0, 0.0), pitch=math.pi / 2),
    Camera(position=(0.0, 60.0, 0.0), pitch=0.9, fov=0.6),
    Camera(position=(0.0, 60.0, 0.0), pitch=-0.5, fov=0.9, roll=0.4),
    Camera(position=(0.0, 60.0, 0.0), pitch=-0.5, fov=1.1, yaw=math.pi),
    Camera(position=(0.0, -3.0, 0.0), pitch=1.2),
    Camera(position=(1e7, 40.0, -1e7), pitch=-0.1),
    Camera(position=(300.0, 8.0, 300.0), yaw=1.0, fov=0.4),
)


def small(plan: FramePlan) -> dict[str, Any]:
    """What of a plan says which of its passes are drawn."""
    passes = []
    for one in plan.passes:
        inputs = {name: source.model_dump() for name, source in one.inputs.items() if isinstance(source, TargetInput)}
        told = one.model_dump(mode="json", include={"name", "when", "eye", "view", "target"})
        passes.append({**told, "inputs": inputs, "state": {"clear": one.state.clear}})
    return {"top": plan.top, "trough": plan.trough, "passes": passes}


def views() -> Vectors:
    """One entry a plan, with what is drawn for each camera and size."""
    entries: Vectors = []
    for preset, tier in PLANS:
        plan = make_plan(load_preset(preset).scene, TIERS[tier])  # type: ignore[index]
        pictures = []
        for camera, (width, height) in product(VIEWS, ((320, 180), (90, 400))):
            drawn = [[index, shows] for index, shows in drawn_passes(plan, camera, width, height, "screen").items()]
            seen = {"camera": camera.model_dump(mode="json"), "width": width, "height": height}
            pictures.append({**seen, "drawn": drawn})
        entries.append({"preset": preset, "tier": tier, "plan": small(plan), "pictures": pictures})
    return entries


WIDTH, HEIGHT = 40, 24
CURVES: tuple[ToneCurve | None, ...] = (None, "filmic", "photographic")


def pictures() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A reference with smooth colours, edges and light above white, and a picture that differs in all of them."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    stripes = (np.sin(x * 0.9) > 0.3) * 0.6
    truth = np.stack((0.1 + x / WIDTH, 0.3 + 0.2 * np.cos(y / 3.0), 0.05 + y / HEIGHT + stripes), axis=-1)
    picture = truth + np.stack((0.1 * (y > 12), 0.05 * np.sin(x * y / 7.0), -0.3 * (x > 20) * (y > 6)), axis=-1)
    return np.round(np.maximum(truth, 0.0), 3), np.round(np.maximum(picture, 0.0), 3)


def flip() -> dict[str, Any]:
    """The pictures, and how far they are apart by each curve."""
    truth, picture = pictures()
    values = {"none" if curve is None else curve: round(metrics.flip(picture, truth, curve), 6) for curve in CURVES}
    golden = {"width": WIDTH, "height": HEIGHT, "flip": values}
    return golden | {"truth": truth.ravel().tolist(), "picture": picture.ravel().tolist()}


SIDE = 32
SAMPLE = 0.5
"""Side of a sample, texels."""
SEED = 7
WHITE_SEED = 2011
WHITE_COUNT = 256
GREYS = (1 / 16, 1 / 4, 1 / 2)


def fronts() -> Vectors:
    """Saturations of fronts over a period, with the paper's constants and with others."""
    theta = np.linspace(0.03, 2.0 * math.pi - 0.03, 61)
    kinds = [(name, one.delta, one.base, 4.0) for name, one in front.FRONT_CONSTANTS.items()]
    kinds += [("other", 1.3, 2.2, 1.0), ("other", 2.0, 4.0, 30.0)]
    vectors: Vectors = []
    for name, delta, base, intensity in kinds:
        psi = theta + 2.0 * delta - math.pi
        f = front.front_saturation(np.cos(psi), np.sin(psi), intensity, base)
        constants = {"constants": name, "delta": delta, "base": base, "intensity": intensity}
        vectors.append({**constants, "theta": theta.tolist(), "saturation": f.tolist()})
    return vectors


def amounts() -> Vectors:
    """Amounts of the looks that compare with single texels."""
    f, m, t = (one.ravel() for one in np.meshgrid([0.0, 0.1, 0.3, 0.7, 1.0, 2.2, 4.0], [0.05, 0.3, 0.9], [0.4, 1.0]))
    names: tuple[Look, ...] = ("textured", "halftone", "fading", "halftone_textured", "listing")
    return [
        {"look": name, "f": f.tolist(), "m": m.tolist(), "t": t.tolist(), "amount": looks.hard(name, f, m, t).tolist()}
        for name in names
    ]


def filtered(words: np.ndarray, quantiles: np.ndarray) -> Vectors:
    """Coverage of samples of half a texel, for saturations and fades."""
    values = (words + 0.5) / 65536.0
    random = np.random.default_rng(3)
    u, v = random.random(24), random.random(24)
    foot_u = np.tile([SAMPLE / SIDE, 0.0], (u.size, 1))
    foot_v = np.tile([0.0, SAMPLE / SIDE], (u.size, 1))
    size = np.full((u.size, 2), SAMPLE)
    b, e = looks.spline_over_footprint(sampling.bspline(values, u, v), foot_u, foot_v)
    vectors: Vectors = []
    at = {"x": (u * SIDE).tolist(), "y": (v * SIDE).tolist()}
    for fade, s in product((0.0, 0.2), (0.0, 0.001, 0.08, 0.3, 0.6, 0.97, 1.0)):
        share = np.full_like(u, s)
        threshold = sampling.quantile(quantiles, share)
        width = looks.spline_fade(quantiles, share, fade)
        near = looks.magnified_coverage(b, e, threshold, width)
        covered = looks.filtered_coverage(share, np.zeros_like(u), near, size, whole=fade == 0.0)
        vectors.append({"s": s, "fade": fade, **at, "coverage": covered.tolist()})
    return vectors


def shuffled() -> list[int]:
    """The order of white noise: Fisher and Yates with one hash a place."""
    ranks = list(range(WHITE_COUNT))
    words = pcg(np.arange(WHITE_SEED, WHITE_SEED + WHITE_COUNT, dtype=np.uint64))
    for i in range(WHITE_COUNT - 1, 0, -1):
        j = (int(words[i]) * (i + 1)) >> 32
        ranks[i], ranks[j] = ranks[j], ranks[i]
    return ranks


def foam_strips() -> dict[str, Any]:
    """All of the chapter's formulas."""
    mask = mask_by_name(f"vac:1.5:{SIDE}:{SEED}")
    words = quantised(mask.ranks, 16)
    heights = np.linspace(-0.2, 1.4, 9)
    spectra = measure_spectrum(mask.ranks, greys=GREYS)
    saturation = height_saturation(heights, 0.3, 0.9).tolist()
    return {
        "fronts": fronts(),
        "heights": {"height": heights.tolist(), "base": 0.3, "full": 0.9, "saturation": saturation},
        "amounts": amounts(),
        "mask": {"size": SIDE, "words": words.ravel().tolist(), "quantiles": mask.filtering.quantiles[0].tolist()},
        "sample": SAMPLE,
        "filtered": filtered(words, mask.filtering.quantiles[0]),
        "spectra": [{"grey": one.grey, "raps": one.raps.tolist()} for one in spectra.greys],
        "white": {"seed": WHITE_SEED, "ranks": shuffled()},
    }


CAMERAS = (
    Camera(),
    Camera(position=(3.0, 2.5, -7.0), yaw=0.8, pitch=-0.4, fov=0.6),
    Camera(position=(-40.0, 12.0, 5.0), yaw=-2.9, pitch=0.1, roll=0.5, fov=1.4),
    Camera(position=(0.0, 60.0, 0.0), pitch=-math.pi / 2),
    Camera(position=(1e7, 4.0, -1e7), yaw=3.1, pitch=-0.2),
    Camera(position=(2.0, -3.0, 1.0), yaw=1.0, pitch=0.6),
)

PIXELS = ((0.5, 0.5), (0.1, 0.95), (0.9, 0.7), (0.5, 0.02), (0.31, 0.55), (1.0, 1.0))
"""Places in the picture from its upper left corner, as shares of its width and height."""

FARTHEST = 2000.0
"""Distance from the eye beyond which no place is picked, m."""


def picked(camera: Camera, width: int, height: int, x: float, y: float) -> dict[str, float] | None:
    """Where the ray of a point of the picture meets y = 0, m, and its distance; None where it does not, or far away."""
    grid = cameras.SampleGrid(camera, width, height)
    ray = grid.rays(np.array(2.0 * x / width - 1.0), np.array(1.0 - 2.0 * y / height))
    if ray[1] == 0.0 or -grid.eye[1] / ray[1] <= 0.0:
        return None
    way = -grid.eye[1] / ray[1] * ray
    distance = float(np.linalg.norm(way))
    if distance > FARTHEST:
        return None
    return {"x": float(grid.eye[0] + way[0]), "z": float(grid.eye[2] + way[2]), "distance": distance}


def picks() -> Vectors:
    """One entry a camera and size, with what each of the pixels shows."""
    entries: Vectors = []
    for camera, (width, height) in product(CAMERAS, ((1440, 900), (390, 844))):
        places = [(u * width, v * height) for u, v in PIXELS]
        found = [{"x": x, "y": y, "place": picked(camera, width, height, x, y)} for x, y in places]
        entries.append({"camera": camera.model_dump(mode="json"), "width": width, "height": height, "picks": found})
    return entries


def main() -> None:
    """Write the files beside this one; of lists, a line an entry."""
    for make in (uniform_rules, views, flip, foam_strips, picks):
        made = make()
        text = json.dumps(made) if isinstance(made, dict) else "[\n" + ",\n".join(map(json.dumps, made)) + "\n]"
        Path(__file__).with_name(f"{make.__name__}.json").write_text(f"{text}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
