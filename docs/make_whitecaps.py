"""Whitecaps of the open sea against the wind: tables and plots of docs/whitecaps.md, factors of ocean/cascades.py.

Run as ``python docs/make_whitecaps.py [--derive | --photographs | --patches]``; with ``--derive`` it prints what
``CLAMPED`` and ``LASTING_CLAMPED`` should be instead, with ``--photographs`` it draws the sea as from a ship and counts
by AWE, with ``--patches`` it measures patches of foam from above.
"""

import argparse
import io
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image
from rich.console import Console
from rich.progress import Progress
from scipy import stats

from seafoam.accuracy.metrics import displayed
from seafoam.accuracy.whitecaps import Patches, Rule, awe_threshold, grey, levelled, patches
from seafoam.ocean import cascades as sea_tiles
from seafoam.ocean import whitecaps as foam_of_sea
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.waves.sea import fold_saturation, sea_surface
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FoldSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.waves import Sea

PAGE = Path(__file__).parent / "whitecaps.md"
PICTURE = Path(__file__).parent / "pictures" / "whitecaps.png"
Floats = NDArray[np.float32]
Floats64 = NDArray[np.float64]
MARK = "<!-- table -->\n"
WINDS = (5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0)
DERIVED, SHOWN = (1, 2), (5, 6)
"""Seeds of the seas that the factors come from, and of others that the page shows."""
FETCH = 5e5
LASTING_DECAY = 3.7
"""To 1/e, s: whitecaps of the open sea fade in 3.5 to 4 s (Monahan and Zietlow 1969)."""
TEXELS = 256
POINTS = 100_000

PRESET = "open-ocean"
PHOTOGRAPHED = (8.0, 10.0, 12.5, 15.0, 18.0)
SIZE = (2592, 1944)
"""Of a photograph: five megapixels, for which the program is written."""
SMALL = (128, 96)
"""Of the frames without light in which foam alone is counted."""
COARSE = 6
"""Pixels along a side that are one in the small photographs."""
EYE, PITCH, FOV = 30.0, -0.6, 0.7
"""Camera over still water, m; its pitch and vertical field of view, rad: 14 to 54 degrees down."""
QUALITY = TIERS["standard"].model_copy(update={"sea_size": 128})
"""A tile of 128 texels still holds all waves, and is drawn sooner."""
VIEWS = 80
"""Small views of a wind."""
PHOTOGRAPHS = 4
"""Photographs of a wind: AWE's ratio to the foam drawn in the same picture needs few."""
RULES: tuple[Rule, ...] = ("program", "least")
THIN = 0.02
"""Foam amount under which a pixel counts as water."""
OUTLINED_WIND = 12.5
ABOVE = 300.0
"""Height from which patches are measured, m."""
OUTLINED, OUTLINED_SIDE = 24, 960
"""Pictures from above, and pixels along their side."""


def coverage(wind: float, seed: int, kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False) -> float:
    """Mean foam of a sea, over points spread over its largest tile: the covered share, as masks are rank-uniform."""
    foam = FoldSaturation(lasting=True, decay=LASTING_DECAY) if lasting else FoldSaturation()
    scene = Scene(sea=Sea(model=kind, wind=wind, fetch=FETCH, seed=seed), foam=Foam(saturation=(foam,)))
    # Where foam lasts, texels of its maps are those of the finest tiers.
    surface = sea_surface(scene, 100.0 * seed, (0.0, 0.0), 2 * TEXELS if lasting else TEXELS)
    assert surface is not None
    random = np.random.default_rng(seed)
    x, z = random.uniform(0.0, 20.0 * surface.tiles[0].size, (2, POINTS))
    return float(fold_saturation(scene, foam, surface, x, z).mean())


def measured(
    seeds: tuple[int, ...], kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False
) -> dict[float, float]:
    """Coverage at each wind, the mean of several seas."""
    return {wind: float(np.mean([coverage(wind, seed, kind, lasting) for seed in seeds])) for wind in WINDS}


def derive(lasting: bool) -> tuple[tuple[float, float], ...]:
    """``CLAMPED`` from seas drawn with it: what is wanted over what is drawn, until it stands still."""
    factors = dict.fromkeys(WINDS, 1.0)
    for _ in range(3):
        if lasting:
            foam_of_sea.LASTING_CLAMPED = tuple(factors.items())
        else:
            foam_of_sea.CLAMPED = tuple(factors.items())
        for wind, drawn in measured(DERIVED, lasting=lasting).items():
            factors[wind] *= foam_of_sea.whitecaps(wind) / drawn
        print({wind: round(factor, 3) for wind, factor in factors.items()}, file=sys.stderr)
    return tuple((wind, round(factor, 3)) for wind, factor in factors.items())


def write(drawn: dict[float, float], lasting: dict[float, float], gerstner: dict[float, float]) -> None:
    """The page's table and its plot."""
    rows = [
        "| wind, m/s | wanted, % | `fft`, % | over wanted | `fft`, lasting, % | over wanted "
        "| `gerstner`, % | over wanted |\n",
        "|---|---|---|---|---|---|---|---|\n",
    ]
    for wind in WINDS:
        wanted = foam_of_sea.whitecaps(wind)
        shares = " | ".join(f"{100 * of[wind]:.3f} | {of[wind] / wanted:.2f}" for of in (drawn, lasting, gerstner))
        rows.append(f"| {wind:g} | {100 * wanted:.3f} | {shares} |\n")
    before, _, after = PAGE.read_text(encoding="utf-8").split(MARK)
    PAGE.write_text(before + MARK + "".join(rows) + MARK + after, encoding="utf-8")
    figure = Figure(figsize=(8.0, 5.0), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    winds = np.linspace(4.5, 21.0, 100)
    law = 100 * 3.84e-6 * winds**3.41
    axes.fill_between(winds, 0.8 * law, 1.2 * law, color="#dde3e6", label="within 20 %")
    axes.plot(winds, law, color="#1c2b33", lw=1.2, label="3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980)")
    series = (
        (drawn, "o", "#b5353c", "fft"),
        (lasting, "s", "#c98a2b", "fft, lasting"),
        (gerstner, "^", "#27708b", "gerstner"),
    )
    for of, mark, colour, name in series:
        axes.plot(list(of), [100 * share for share in of.values()], mark, color=colour, label=f"drawn, {name}")
    axes.set_yscale("log")
    axes.set_xlabel("wind 10 m above the sea, m/s")
    axes.set_ylabel("share of the sea under foam, %")
    axes.legend(frameon=False)
    axes.grid(color="#dde3e6", lw=0.6)
    figure.savefig(PICTURE)


def seascape(wind: float, seed: int, yaw: float, *, own: bool = True) -> Scene:
    """The preset's sea and foam, of coverage 1, the sun high behind a camera that heads to ``yaw``.

    own: with the preset's foam that lasts and lives, else with that of the last 3 s, lying still.
    """
    preset = load_preset(PRESET).scene
    assert preset.foam is not None
    assert preset.light is not None
    changed: dict[str, Any] = {} if own else {"saturation": (FoldSaturation(),), "life": None}
    azimuth = math.remainder(yaw + 0.5 * math.pi, 2.0 * math.pi)
    light = Light(sun_azimuth=azimuth, sun_elevation=1.0, turbidity=2.0, visibility=18000.0)
    return preset.model_copy(
        update={
            "sea": Sea(wind=wind, fetch=FETCH, seed=seed),
            "foam": preset.foam.model_copy(update=changed),
            "light": light.model_copy(update={"exposure": preset.light.exposure}),
        }
    )


@dataclass(frozen=True)
class Shot:
    """A photograph: shares of its pixels that are counted, and the foam drawn."""

    drawn: float
    """Mean foam amount."""
    coarse: float
    """AWE, a sixth of the resolution, as it is."""
    whole: dict[Rule, float]
    """AWE, all pixels, levelled."""
    made_of: tuple[float, float, float]
    """Of ``whole`` by the program: pixels at least half under foam, thinly, and not."""
    drawn_steep: float
    """Mean foam amount of the lower half, which looks 34 degrees down and more."""
    steep: dict[Rule, float]
    """AWE in that half alone, levelled."""


def counted(image: Floats64, rule: Rule) -> NDArray[np.bool_]:
    """The pixels that AWE counts."""
    threshold = awe_threshold(image, rule)
    return image > (1.0 if threshold is None else threshold)


def photo(pixels: NDArray[np.float32]) -> NDArray[np.uint8]:
    """A linear frame as a camera's 8-bit sRGB."""
    return np.round(255.0 * displayed(pixels)).astype(np.uint8)


def shot(pixels: NDArray[np.float32]) -> Shot:
    """Judge a linear frame. Its sides are multiples of :data:`COARSE`."""
    height, width, _ = pixels.shape
    foam = pixels[..., 3].astype(np.float64)
    picture = photo(pixels)
    boxes = pixels.reshape(height // COARSE, COARSE, width // COARSE, COARSE, -1).mean(axis=(1, 3))
    low = slice(height // 2, None)
    whole, steep = levelled(picture), levelled(picture[low])
    of = counted(whole, "program")
    parts = (foam >= 0.5, (foam >= THIN) & (foam < 0.5), foam < THIN)
    return Shot(
        drawn=float(foam.mean()),
        coarse=float(counted(grey(photo(boxes)), "program").mean()),
        whole={"program": float(of.mean()), "least": float(counted(whole, "least").mean())},
        made_of=tuple(float((of & part).mean()) for part in parts),  # type: ignore[arg-type]
        drawn_steep=float(foam[low].mean()),
        steep={rule: float(counted(steep, rule).mean()) for rule in RULES},
    )


@dataclass(frozen=True)
class Album:
    """Views at one wind."""

    foam: list[float]
    """Mean foam amount of every view."""
    shots: list[Shot]

    def over_law(self, wind: float, of: Callable[[Shot], float], drawn: Callable[[Shot], float]) -> float:
        """What is counted in all photographs over what is drawn there, times what all views draw, over the law."""
        counted = sum(of(one) for one in self.shots) / sum(drawn(one) for one in self.shots)
        return counted * float(np.mean(self.foam)) / foam_of_sea.whitecaps(wind)


def view(executor: Executor, scene: Scene, place: Sequence[float], yaw: float, size: tuple[int, int]) -> Floats:
    """A linear frame. place: x and z, m, and time, s."""
    x, z, time = place
    camera = Camera(position=(x, EYE, z), pitch=PITCH, yaw=yaw, fov=FOV)
    plan = make_plan(scene, QUALITY)
    return executor.render(plan, time=time, camera=camera, width=size[0], height=size[1], output="linear").pixels  # type: ignore[return-value]


def spread(values: Sequence[float]) -> float:
    """Standard error of the mean over the mean."""
    return float(np.std(values, ddof=1) / np.mean(values) / math.sqrt(len(values)))


def photographed(executor: Executor, wind: float, progress: Progress) -> Album:
    """Views of other seas, places, moments and headings, some of them photographed."""
    random = np.random.default_rng(round(10.0 * wind))
    album = Album([], [])
    task = progress.add_task(f"photographs, {wind:g} m/s", total=VIEWS)
    rounds = VIEWS // PHOTOGRAPHS
    for number in range(PHOTOGRAPHS):
        yaw = float(random.uniform(-math.pi, math.pi))
        scene = seascape(wind, 100 + number, yaw)
        unlit = scene.model_copy(update={"light": None})
        for i in range(rounds):
            place = [float(value) for value in random.uniform((-2e3, -2e3, 0.0), (2e3, 2e3, sea_tiles.LOOP))]
            album.foam.append(float(view(executor, unlit, place, yaw, SMALL)[..., 3].mean(dtype=np.float64)))
            if i == 0:
                album.shots.append(shot(view(executor, scene, place, yaw, SIZE)))
            progress.advance(task)
        progress.console.print(f"{wind:g} m/s:", album.shots[-1])
    return album


def write_photographs(albums: Mapping[float, Album]) -> None:
    """The page's table of photographs and its plot."""
    rows = [
        "| wind, m/s | law, % | views | drawn, over law | sure to | photographs | AWE, 0.14 megapixels | AWE, 5 "
        "| its pixels: foam / thin / none | AWE, 5, steep | least PIP, 5 | least PIP, 5, steep |\n",
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    ]
    columns: dict[str, list[float]] = {"drawn": [], "AWE, 0.14": [], "AWE, 5": [], "least PIP, 5": []}
    for wind, album in albums.items():
        law = foam_of_sea.whitecaps(wind)
        drawn = float(np.mean(album.foam)) / law

        def whole(of: Callable[[Shot], float], album: Album = album, wind: float = wind) -> float:
            return album.over_law(wind, of, lambda one: one.drawn)

        def steep(rule: Rule, album: Album = album, wind: float = wind) -> float:
            return album.over_law(wind, lambda one: one.steep[rule], lambda one: one.drawn_steep)

        coarse = whole(lambda one: one.coarse)
        awe, least = whole(lambda one: one.whole["program"]), whole(lambda one: one.whole["least"])
        parts = (
            whole(lambda one: one.made_of[0]),
            whole(lambda one: one.made_of[1]),
            whole(lambda one: one.made_of[2]),
        )
        rows.append(
            f"| {wind:g} | {100 * law:.3f} | {len(album.foam)} | {drawn:.2f} | {100 * spread(album.foam):.0f} % "
            f"| {len(album.shots)} | {coarse:.2f} | {awe:.2f} | {' / '.join(f'{part:.2f}' for part in parts)} "
            f"| {steep('program'):.2f} | {least:.2f} | {steep('least'):.2f} |\n"
        )
        for name, value in zip(columns, (drawn, coarse, awe, least), strict=True):
            columns[name].append(100.0 * law * value)
    fill("photographs", rows)
    figure = Figure(figsize=(8.0, 5.0), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    winds = np.linspace(7.5, 19.0, 100)
    law_curve = 100 * 3.84e-6 * winds**3.41
    axes.fill_between(winds, 0.8 * law_curve, 1.2 * law_curve, color="#dde3e6", label="within 20 %")
    axes.plot(winds, law_curve, color="#1c2b33", lw=1.2, label="3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980)")
    for (name, values), mark, colour in zip(
        columns.items(), "o^vs", ("#b5353c", "#27708b", "#5b9bb3", "#c98a2b"), strict=True
    ):
        axes.plot(list(albums), values, mark, color=colour, label=name)
    axes.set_yscale("log")
    axes.set_xlabel("wind 10 m above the sea, m/s")
    axes.set_ylabel("share of the photograph, %")
    axes.legend(frameon=False)
    axes.grid(color="#dde3e6", lw=0.6)
    save(figure, "whitecaps-photographs")


def outlined(executor: Executor, progress: Progress, *, own: bool) -> Patches:
    """Patches of pixels at least half under foam, from straight above."""
    random = np.random.default_rng(3)
    found = []
    for i in progress.track(range(OUTLINED), description=f"patches, {'own look' if own else 'lying still'}"):
        scene = seascape(OUTLINED_WIND, 200 + i, 0.0, own=own)
        x, z, time = (float(value) for value in random.uniform((-2e3, -2e3, 0.0), (2e3, 2e3, sea_tiles.LOOP)))
        camera = Camera(position=(x, ABOVE, z), pitch=-0.5 * math.pi, fov=2.0 * math.atan(0.5))
        plan = make_plan(scene, QUALITY)
        side = OUTLINED_SIDE
        frame = executor.render(plan, time=time, camera=camera, width=side, height=side, output="linear")
        found.append(patches(frame.pixels[..., 3] >= 0.5, ABOVE / side))
    parts = ("areas", "lengths", "perimeters")
    return Patches(*(np.concatenate([getattr(one, part) for one in found]) for part in parts))


def write_patches(found: Mapping[str, Patches]) -> None:
    """The page's table of patches and its plot."""
    rows = [
        "| foam | patches | areas, m² | exponent of the areas | mean axis ratio (0.41) | outlines' dimension "
        "(1.39; streaks 1.23) | lengths, m: median, 90 % | gamma law of lengths, greatest distance |\n",
        "|---|---|---|---|---|---|---|---|\n",
    ]
    figure = Figure(figsize=(8.0, 4.6), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    for (name, of), colour in zip(found.items(), ("#b5353c", "#27708b"), strict=True):
        shape, _, scale = stats.gamma.fit(of.lengths, floc=0.0)
        distance = stats.kstest(of.lengths, "gamma", args=(shape, 0.0, scale)).statistic
        rows.append(
            f"| {name} | {len(of.areas)} | {of.areas.min():.2f} to {of.areas.max():.0f} | {of.exponent():.2f} "
            f"| {of.axis_ratios.mean():.2f} | {of.dimension():.2f} "
            f"| {np.median(of.lengths):.1f}, {np.quantile(of.lengths, 0.9):.1f} | {distance:.2f} |\n"
        )
        ordered = np.sort(of.areas)[::-1]
        axes.loglog(ordered, np.arange(1, len(ordered) + 1) / len(ordered), color=colour, label=name)
        slope = 1.0 - of.exponent()
        axes.loglog(ordered, (ordered / ordered[-1]) ** slope, ":", color=colour, label=f"area^{slope:.2f}")
    axes.set_xlabel("area of a patch, m²")
    axes.set_ylabel("share of patches at least as large")
    axes.legend(frameon=False)
    axes.grid(color="#dde3e6", lw=0.6)
    fill("patches", rows)
    save(figure, "whitecaps-patches")


def fill(name: str, rows: Sequence[str]) -> None:
    """Put a table between its marks on the page. Raises where they are not there once each."""
    mark = f"<!-- {name} -->\n"
    before, _, after = PAGE.read_text(encoding="utf-8").split(mark)
    PAGE.write_text(before + mark + "".join(rows) + mark + after, encoding="utf-8")


def save(figure: Figure, name: str) -> None:
    """A plot as a small WebP."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").save(PICTURE.with_name(f"{name}.webp"), quality=85, method=6)


def main() -> None:
    """Write what was asked for of the page, or print ``CLAMPED``."""
    parser = argparse.ArgumentParser(description=__doc__)
    asked = parser.add_mutually_exclusive_group()
    asked.add_argument("--derive", action="store_true")
    asked.add_argument("--photographs", action="store_true")
    asked.add_argument("--patches", action="store_true")
    chosen = parser.parse_args()
    if chosen.derive:
        for lasting in (False, True):
            print("LASTING_CLAMPED" if lasting else "CLAMPED", derive(lasting))
    elif chosen.photographs or chosen.patches:
        executor = Executor()
        try:
            with Progress(console=Console(stderr=True)) as progress:
                if chosen.photographs:
                    write_photographs({wind: photographed(executor, wind, progress) for wind in PHOTOGRAPHED})
                else:
                    looks = {"last 3 s, lying still": False, "preset's own look": True}
                    write_patches({name: outlined(executor, progress, own=own) for name, own in looks.items()})
        finally:
            executor.close()
    else:
        write(measured(SHOWN), measured(SHOWN, lasting=True), measured(SHOWN, "gerstner"))


if __name__ == "__main__":
    main()
