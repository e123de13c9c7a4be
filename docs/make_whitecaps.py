"""Whitecaps of the sea against the wind: tables and plots of docs/whitecaps.md, factors of ocean/foam/whitecaps.py.

Run as ``python docs/make_whitecaps.py [--derive | --photographs | --patches]``. ``--derive`` prints new values of
``CLAMPED`` and ``LASTING_CLAMPED``; ``--photographs`` draws the sea as seen from a ship and counts whitecaps by AWE;
``--patches`` measures patches of foam in pictures from above.
"""

import argparse
import io
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image
from rich.console import Console
from rich.progress import Progress
from scipy import stats

from seafoam.accuracy.metrics import displayed
from seafoam.ocean.foam import whitecaps as foam_of_sea
from seafoam.ocean.waves import cascades as sea_tiles
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.waves.sea import sea_surface, whitecap_saturation
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, Foam, Light, Scene, Sea, WhitecapSaturation, load_preset

# As a script this file has docs on its path, as a module of tests what docs lies in.
sys.path.append(str(Path(__file__).resolve().parents[1]))

from docs.whitecaps_measure import Patches, Rule, awe_threshold, grey, levelled, patches

PAGE = Path(__file__).parent / "whitecaps.md"
PICTURE = Path(__file__).parent / "pictures" / "whitecaps.png"
Floats = NDArray[np.float32]
Floats64 = NDArray[np.float64]
WINDS = foam_of_sea.WINDS
DERIVED, SHOWN = (1, 2), (5, 6)
"""Seeds of the seas from which the factors are derived, and of the other seas that the page shows."""
FETCH = 5e5
LASTING_DECAY = 3.7
"""To 1/e, s: whitecaps of the open sea fade in 3.5 to 4 s (Monahan and Zietlow 1969)."""
TEXELS = 256
POINTS = 100_000

PRESET = "open-ocean"
PHOTOGRAPHED = (8.0, 10.0, 12.5, 15.0, 18.0)
SIZE = (2592, 1944)
"""Size of a photograph, pixels: the five megapixels for which AWE was published."""
SMALL = (128, 96)
"""Size of the frames without light, in which only foam is measured, pixels."""
COARSE = 6
"""Pixels along a side that are averaged to one pixel of the small photographs."""
EYE, PITCH, FOV = 30.0, -0.6, 0.7
"""Camera over still water, m; its pitch and vertical field of view, rad: 14 to 54 degrees down."""
QUALITY = TIERS["standard"].model_copy(update={"sea_size": 128})
"""Tiles of 128 texels resolve all waves and are fast to draw."""
VIEWS = 80
"""Number of small views per wind speed."""
PHOTOGRAPHS = 4
"""Number of photographs per wind speed: the ratio of AWE to the foam in the same picture needs few."""
RULES: tuple[Rule, ...] = ("program", "least")
THIN = 0.02
"""Foam amount below which a pixel counts as water."""
OUTLINED_WIND = 12.5
ABOVE = 300.0
"""Height of the camera for patches, m."""
OUTLINED, OUTLINED_SIDE = 24, 960
"""Number of pictures from above, and pixels along their sides."""


def coverage(wind: float, seed: int, kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False) -> float:
    """Mean foam saturation over random points of a sea: the covered share, since mask thresholds are uniform."""
    foam = WhitecapSaturation(lasting=True, decay=LASTING_DECAY) if lasting else WhitecapSaturation()
    scene = Scene(sea=Sea(model=kind, wind=wind, fetch=FETCH, seed=seed), foam=Foam(saturation=(foam,)))
    # For lasting foam, maps have the resolution of the finest tiers.
    surface = sea_surface(scene, 100.0 * seed, (0.0, 0.0), 2 * TEXELS if lasting else TEXELS)
    assert surface is not None
    random = np.random.default_rng(seed)
    x, z = random.uniform(0.0, 20.0 * surface.tiles[0].size, (2, POINTS))
    return float(whitecap_saturation(scene, foam, surface, x, z).mean())


def measured(
    seeds: tuple[int, ...], kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False
) -> dict[float, float]:
    """Coverage at each wind, the mean of several seas."""
    return {wind: float(np.mean([coverage(wind, seed, kind, lasting) for seed in seeds])) for wind in WINDS}


def derive(lasting: bool) -> tuple[float, ...]:
    """``CLAMPED``, iterated: the ratio of wanted to drawn coverage of seas drawn with it."""
    factors = dict.fromkeys(WINDS, 1.0)
    for _ in range(3):
        if lasting:
            foam_of_sea.LASTING_CLAMPED = tuple(factors.values())
        else:
            foam_of_sea.CLAMPED = tuple(factors.values())
        for wind, drawn in measured(DERIVED, lasting=lasting).items():
            factors[wind] *= foam_of_sea.whitecaps(wind) / drawn
        print({wind: round(factor, 3) for wind, factor in factors.items()}, file=sys.stderr)
    return tuple(round(factor, 3) for factor in factors.values())


def write(drawn: dict[float, float], lasting: dict[float, float], gerstner: dict[float, float]) -> None:
    """Write the page's table and its plot."""
    rows = [
        "| wind, m/s | wanted, % | `fft`, % | over wanted | `fft`, lasting, % | over wanted "
        "| `gerstner`, % | over wanted |\n",
        "|---|---|---|---|---|---|---|---|\n",
    ]
    for wind in WINDS:
        wanted = foam_of_sea.whitecaps(wind)
        shares = " | ".join(f"{100 * of[wind]:.3f} | {of[wind] / wanted:.2f}" for of in (drawn, lasting, gerstner))
        rows.append(f"| {wind:g} | {100 * wanted:.3f} | {shares} |\n")
    fill("table", rows)
    figure, axes = law_plot("share of the sea under foam, %", (4.5, 21.0), dpi=120)
    series = (
        (drawn, "o", "#b5353c", "fft"),
        (lasting, "s", "#c98a2b", "fft, lasting"),
        (gerstner, "^", "#27708b", "gerstner"),
    )
    for of, mark, colour, name in series:
        axes.plot(list(of), [100 * share for share in of.values()], mark, color=colour, label=f"drawn, {name}")
    axes.legend(frameon=False)
    figure.savefig(PICTURE)


def seascape(wind: float, seed: int, yaw: float, *, own: bool = True) -> Scene:
    """A sea with the preset's whitecaps, opaque, of coverage 1, and a high sun behind a camera that faces ``yaw``.

    Without single waves, which the law does not know, and with opaque foam, since it counts areas.

    own: with the preset's lasting, drifting foam, else with fixed foam of the last 3 s.
    """
    preset = load_preset(PRESET).scene.settled
    assert preset.foam is not None
    assert preset.light is not None
    sources = (one for one in preset.foam.saturation if isinstance(one, WhitecapSaturation))
    whitecaps = tuple(one.model_copy(update={"coverage": 1.0}) for one in sources)
    fixed = {"saturation": (WhitecapSaturation(),), "life": None}
    changed: dict[str, Any] = {"scattering": None} | ({"saturation": whitecaps} if own else fixed)
    azimuth = math.remainder(yaw + 0.5 * math.pi, 2.0 * math.pi)
    light = Light(sun_azimuth=azimuth, sun_elevation=1.0, turbidity=2.0, visibility=18000.0)
    return preset.model_copy(
        update={
            "waves": (),
            "sea": Sea(wind=wind, fetch=FETCH, seed=seed),
            "foam": preset.foam.model_copy(update=changed),
            "light": light.model_copy(update={"exposure": preset.light.exposure}),
        }
    )


@dataclass(frozen=True)
class Shot:
    """A photograph: the shares of its pixels that are counted, and the drawn foam."""

    drawn: float
    """Mean foam amount."""
    coarse: float
    """AWE at a sixth of the resolution, not levelled."""
    whole: dict[Rule, float]
    """AWE over all pixels, levelled."""
    made_of: tuple[float, float, float]
    """``whole`` by the program, split into pixels with foam of at least 0.5, at least THIN, and less."""
    drawn_steep: float
    """Mean foam amount of the lower half, 34 degrees and more below the horizon."""
    steep: dict[Rule, float]
    """AWE in that half, levelled."""


def counted(image: Floats64, rule: Rule) -> NDArray[np.bool_]:
    """The pixels that AWE counts."""
    threshold = awe_threshold(image, rule)
    return image > (1.0 if threshold is None else threshold)


def photo(pixels: NDArray[np.float32]) -> NDArray[np.uint8]:
    """A linear frame as a camera's 8-bit sRGB."""
    return np.round(255.0 * displayed(pixels, "filmic")).astype(np.uint8)


def shot(pixels: NDArray[np.float32]) -> Shot:
    """Count a linear frame. Its sides are multiples of :data:`COARSE`."""
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
    """Views at one wind speed."""

    foam: list[float]
    """Mean foam amount of every view."""
    shots: list[Shot]

    def over_law(self, wind: float, of: Callable[[Shot], float], drawn: Callable[[Shot], float]) -> float:
        """Ratio of counted to drawn foam in the photographs, times mean drawn foam of all views, over the law."""
        counted = sum(map(of, self.shots)) / sum(map(drawn, self.shots))
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
    """Views of different seas, places, times and headings; some of them also as photographs."""
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
    """Write the page's table of photographs and its plot."""
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
            return album.over_law(wind, of, lambda shot: shot.drawn)

        def steep(rule: Rule, album: Album = album, wind: float = wind) -> float:
            return album.over_law(wind, lambda shot: shot.steep[rule], lambda shot: shot.drawn_steep)

        coarse = whole(lambda shot: shot.coarse)
        awe, least = whole(lambda shot: shot.whole["program"]), whole(lambda shot: shot.whole["least"])
        parts = (
            whole(lambda shot: shot.made_of[0]),
            whole(lambda shot: shot.made_of[1]),
            whole(lambda shot: shot.made_of[2]),
        )
        rows.append(
            f"| {wind:g} | {100 * law:.3f} | {len(album.foam)} | {drawn:.2f} | {100 * spread(album.foam):.0f} % "
            f"| {len(album.shots)} | {coarse:.2f} | {awe:.2f} | {' / '.join(f'{part:.2f}' for part in parts)} "
            f"| {steep('program'):.2f} | {least:.2f} | {steep('least'):.2f} |\n"
        )
        for name, value in zip(columns, (drawn, coarse, awe, least), strict=True):
            columns[name].append(100.0 * law * value)
    fill("photographs", rows)
    figure, axes = law_plot("share of the photograph, %", (7.5, 19.0), dpi=100)
    for (name, values), mark, colour in zip(
        columns.items(), "o^vs", ("#b5353c", "#27708b", "#5b9bb3", "#c98a2b"), strict=True
    ):
        axes.plot(list(albums), values, mark, color=colour, label=name)
    axes.legend(frameon=False)
    save(figure, "whitecaps-photographs")


def outlined(executor: Executor, progress: Progress, *, own: bool) -> Patches:
    """Patches of pixels with foam of at least 0.5, seen from straight above."""
    random = np.random.default_rng(3)
    pictures = []
    for i in progress.track(range(OUTLINED), description=f"patches, {'own look' if own else 'lying still'}"):
        scene = seascape(OUTLINED_WIND, 200 + i, 0.0, own=own)
        x, z, time = (float(value) for value in random.uniform((-2e3, -2e3, 0.0), (2e3, 2e3, sea_tiles.LOOP)))
        camera = Camera(position=(x, ABOVE, z), pitch=-0.5 * math.pi, fov=2.0 * math.atan(0.5))
        plan = make_plan(scene, QUALITY)
        side = OUTLINED_SIDE
        frame = executor.render(plan, time=time, camera=camera, width=side, height=side, output="linear")
        pictures.append(patches(frame.pixels[..., 3] >= 0.5, ABOVE / side))
    parts = ("areas", "lengths", "perimeters")
    return Patches(*(np.concatenate([getattr(picture, part) for picture in pictures]) for part in parts))


def write_patches(patches_of: Mapping[str, Patches]) -> None:
    """Write the page's table of patches and its plot."""
    rows = [
        "| foam | patches | areas, m² | exponent of the areas | mean axis ratio (0.41) | outlines' dimension "
        "(1.39; streaks 1.23) | lengths, m: median, 90 % | gamma law of lengths, greatest distance |\n",
        "|---|---|---|---|---|---|---|---|\n",
    ]
    figure = Figure(figsize=(8.0, 4.6), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    for (name, of), colour in zip(patches_of.items(), ("#b5353c", "#27708b"), strict=True):
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


def law_plot(shares: str, winds: tuple[float, float], dpi: int) -> tuple[Figure, Axes]:
    """A plot of the whitecap law over a range of wind speeds, m/s. ``shares``: title of the vertical axis."""
    figure = Figure(figsize=(8.0, 5.0), dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    speeds = np.linspace(*winds, 100)
    law = 100 * 3.84e-6 * speeds**3.41
    axes.fill_between(speeds, 0.8 * law, 1.2 * law, color="#dde3e6", label="within 20 %")
    axes.plot(speeds, law, color="#1c2b33", lw=1.2, label="3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980)")
    axes.set_yscale("log")
    axes.set_xlabel("wind 10 m above the sea, m/s")
    axes.set_ylabel(shares)
    axes.grid(color="#dde3e6", lw=0.6)
    return figure, axes


def fill(name: str, rows: Sequence[str]) -> None:
    """Put a table between its two marks on the page. Raises ``ValueError`` unless there are exactly two."""
    mark = f"<!-- {name} -->\n"
    before, _, after = PAGE.read_text(encoding="utf-8").split(mark)
    PAGE.write_text(before + mark + "".join(rows) + mark + after, encoding="utf-8")


def save(figure: Figure, name: str) -> None:
    """Save a plot as a small WebP."""
    figure.savefig(buffer := io.BytesIO(), format="png")
    Image.open(buffer).convert("RGB").save(PICTURE.with_name(f"{name}.webp"), quality=85, method=6)


def main() -> None:
    """Write the requested part of the page, or print ``CLAMPED``."""
    parser = argparse.ArgumentParser(description=__doc__)
    mode = parser.add_mutually_exclusive_group()
    for name in ("--derive", "--photographs", "--patches"):
        mode.add_argument(name, action="store_true")
    chosen = parser.parse_args()
    if chosen.derive:
        for lasting in (False, True):
            print("LASTING_CLAMPED" if lasting else "CLAMPED", derive(lasting))
    elif chosen.photographs or chosen.patches:
        with closing(Executor()) as executor, Progress(console=Console(stderr=True)) as progress:
            if chosen.photographs:
                write_photographs({wind: photographed(executor, wind, progress) for wind in PHOTOGRAPHED})
            else:
                looks = {"last 3 s, lying still": False, "preset's own look": True}
                write_patches({name: outlined(executor, progress, own=own) for name, own in looks.items()})
    else:
        write(measured(SHOWN), measured(SHOWN, lasting=True), measured(SHOWN, "gerstner"))


if __name__ == "__main__":
    main()
