"""Presets beside nature: figures, plots and table of docs/nature.md.

Run as ``python docs/make_nature.py``: it measures those presets whose scenes have changed, and writes page and plots.
``--all`` measures every one (five minutes on two busy cores), names of presets measure these. The figures stand in
docs/nature.json, with a hash of the scene that they were measured of.
"""

import argparse
import hashlib
import json
import math
import sys
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from rich.console import Console
from rich.progress import Progress

# As a script this file has docs on its path, as a module of tests what docs lies in.
sys.path.append(str(Path(__file__).resolve().parents[1]))

from docs.make_whitecaps import save
from docs.nature import laws
from docs.nature import measure as m

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.whitecaps import whitecaps
from seafoam.render.gl.executor import Executor
from seafoam.scene import FrontSaturation, Preset, Scene, WhitecapSaturation, load_preset, non_defaults

PAGE = Path(__file__).parent / "nature.md"
FIGURES = Path(__file__).parent / "nature.json"
PICTURE = "nature"
PRESETS = ("open-ocean", "storm", "boat-in-storm", "swell", "default", "sunset-sparkles", "lake-choppy", "moonlight")
COLOURS = ("#1f3a73", "#b5353c", "#e0912f", "#2a9d78", "#6b4c9a", "#3a8fb7", "#8c6d31", "#d4739c")
INK, BAND, GRID = "#1c2b33", "#c3d0d6", "#e6ebee"
FULL = 300
"""Pixels full of foam below which their mean reflectance is not given."""
PATCHES = 5
"""Patches below which no decay time is given."""
Figures = dict[str, dict[str, Any]]
_EVENING = "its single waves are those of a stronger wind than the scene's, and break as often"
REASONS: dict[tuple[str, ...], str] = {
    ("above", "above", "default"): _EVENING,
    ("own", "above", "default"): _EVENING,
    ("up", "above"): "the single waves are steeper than a sea of this wind",
    ("path", "below"): "likely as high waves hide and shade one another, which the band's equation does not",
    ("effective", "below"): "whitecaps are small and torn, and most of their pixels hold little foam",
}


def measured_of(preset: Preset) -> str:
    """Hash of what figures are measured of: scene and time, without what is at its default."""
    what = [non_defaults(preset.scene), preset.time]
    return hashlib.sha256(json.dumps(what, sort_keys=True).encode()).hexdigest()[:12]


def lamp_of(scene: Scene) -> tuple[float, float] | None:
    """Azimuth and elevation of the sun, or of the moon that stands over the horizon instead, rad; None: neither."""
    assert scene.light is not None
    sky = scene.light.sky
    if scene.light.sun[1] > 0.0:
        return scene.light.sun
    return (sky.moon.azimuth, sky.moon.elevation) if sky is not None and sky.moon is not None else None


def measured(executor: Executor, preset: Preset) -> dict[str, Any]:
    """All figures of a preset, in SI units and radians."""
    of = measured_of(preset)
    assert preset.scene.wind is not None
    wind = preset.scene.wind
    preset = preset.model_copy(update={"scene": preset.scene.settled})
    scene = preset.scene
    along, across = m.slope_variances(executor, scene, wind.direction)
    found: dict[str, Any] = {
        "of": of,
        "wind": wind.speed,
        "fetch": scene.sea.fetch if scene.sea is not None else None,
        "heading": wind.direction,
        "up": along,
        "across": across,
        "period": m.peak_period(scene),
    }
    found |= m.seen_from_above(executor, scene)
    found["steepness"] = 2.0 * math.pi * found["height"] / (GRAVITY * found["period"] ** 2)
    if (lamp := lamp_of(scene)) is not None:
        found |= {"lamp": lamp, "path": m.path_width(executor, preset, lamp)}
    if scene.foam is None:
        return found
    found |= m.seen_by_own_camera(executor, preset)
    breaking = [one for one in scene.foam.saturation if isinstance(one, FrontSaturation | WhitecapSaturation)]
    decays = [one.decay for one in breaking if one.decay is not None]
    if decays:
        found["set"] = float(np.mean(decays))
    if found["above"] > 1e-3:
        light = m.reflectances(executor, preset)
        found |= {"effective": light["effective"]}
        found |= {"dense": light["dense"]} if light["pixels"] >= FULL else {}
    if decays and found["above"] > 1e-3:
        times = m.decay_times(executor, scene)
        if len(times) >= PATCHES:
            tenth, median, ninth = np.quantile(times, (0.1, 0.5, 0.9))
            found |= {"decay": float(median), "decays": [float(tenth), float(ninth)], "patches": len(times)}
    return found


def rounded(value: Any) -> Any:
    """Numbers at four digits, as figures are stored."""
    if isinstance(value, float):
        return float(f"{value:.4g}")
    return [rounded(one) for one in value] if isinstance(value, list | tuple) else value


def number(value: float) -> str:
    """Three digits, without an exponent."""
    return f"{value:.{max(2 - math.floor(math.log10(value)), 0)}f}" if value > 1e-4 else "0"


def reason(row: laws.Row) -> str:
    """Why a row is out of its band. Raises ``KeyError`` if that is not known: it is to be found out, and said above."""
    for key in ((row.key, row.side, row.preset), (row.key, row.side)):
        if key in REASONS:
            return REASONS[key]
    raise KeyError(f"{row.preset} lies {row.side} nature's band of {row.key}: find out why, and say so in REASONS")


def table(rows: Sequence[laws.Row]) -> str:
    """A line for each row, in Markdown. Raises ``KeyError`` for one out of its band that has no reason."""
    lines = ["| quantity | preset | ours | nature | |", "|---|---|---|---|---|"]
    for row in rows:
        of = laws.QUANTITIES[row.key]
        title = f"{of.title}, {of.unit}" if of.unit else of.title
        verdict = "within" if row.side == "within" else f"**{row.side}**: {reason(row)}"
        lines.append(
            f"| {title} | {row.preset} | {number(row.ours)} | {number(row.low)} to {number(row.high)} | {verdict} |"
        )
    return "\n".join(lines) + "\n"


def sources() -> str:
    """A line for each quantity: where its band is from."""
    lines = ["| quantity | band of nature |", "|---|---|"]
    lines += [f"| {of.title} | {of.source} |" for of in laws.QUANTITIES.values()]
    return "\n".join(lines) + "\n"


def summary(rows: Sequence[laws.Row]) -> str:
    """How many rows lie within their bands, in all and of each preset."""
    inside = [row for row in rows if row.side == "within"]
    each = ", ".join(
        f"{name} {sum(row.preset == name for row in inside)} of {sum(row.preset == name for row in rows)}"
        for name in dict.fromkeys(row.preset for row in rows)
    )
    return f"**{len(inside)} of {len(rows)}** measured quantities lie within what was published: {each}.\n"


def filled(text: str, figures: Mapping[str, Mapping[str, Any]]) -> str:
    """The page's text with summary, table and sources between their marks."""
    rows = laws.rows(figures)
    for name, content in (("summary", summary(rows)), ("table", table(rows)), ("sources", sources())):
        mark = f"<!-- {name} -->\n"
        before, _, after = text.split(mark)
        text = before + mark + content + mark + after
    return text


def panel(axes: Axes, title: str) -> None:
    """Common looks of a plot."""
    axes.set_title(title, fontsize=9, loc="left", color=INK)
    axes.tick_params(labelsize=7.5, colors=INK)
    axes.grid(color=GRID, lw=0.6)
    axes.set_axisbelow(True)
    for spine in axes.spines.values():
        spine.set_color(BAND)


def against_wind(axes: Axes, figures: Mapping[str, Mapping[str, Any]], keys: tuple[str, ...]) -> None:
    """A band over the wind, and presets in it: one mark a preset, full for the first key, empty for the second."""
    winds = np.linspace(2.0, 24.0, 100)
    column = {"up": 0, "across": 1}.get(keys[0])
    bands = [laws.coverage_band(wind) if column is None else laws.slope_bands(wind)[column] for wind in winds]
    scale = laws.QUANTITIES[keys[0]].scale
    low, high = scale * np.array(bands).T
    axes.fill_between(winds, low, high, color=BAND, alpha=0.7, lw=0)
    if column is None:
        axes.plot(winds, [scale * whitecaps(wind) for wind in winds], color=INK, lw=1.0)
        axes.plot(winds, [scale * laws.callaghan(wind) for wind in winds], color=INK, lw=1.0, ls="--")
    for figure, colour in zip(figures.values(), COLOURS, strict=True):
        for key, face in zip(keys, (colour, "none"), strict=False):
            if figure.get(key, 0.0) > 0.0:
                off = scale * figure.get(f"{key}_error", 0.0)
                axes.errorbar(figure["wind"], scale * figure[key], off, fmt="o", ms=6, color=colour, mfc=face, mew=1.4)
    axes.set_xlim(0.0, 24.0)
    axes.set_xlabel("wind, m/s", fontsize=8, color=INK)


def by_preset(axes: Axes, rows: Sequence[laws.Row], key: str, figures: Mapping[str, Mapping[str, Any]]) -> None:
    """A line for each preset: the band as a bar, ours as a mark, the tenth to ninth of ten as a line through it."""
    chosen = [row for row in rows if row.key == key]
    for place, row in enumerate(reversed(chosen)):
        colour = COLOURS[PRESETS.index(row.preset)]
        axes.barh(place, row.high - row.low, left=row.low, height=0.62, color=BAND, alpha=0.8)
        if key == "decay":
            axes.plot(figures[row.preset]["decays"], (place, place), color=colour, lw=2.0)
        axes.plot(row.ours, place, "o", ms=6, color=colour)
    axes.set_yticks(range(len(chosen)), [row.preset for row in reversed(chosen)])
    axes.set_ylim(-0.6, len(chosen) - 0.4)
    axes.set_xlim(0.0, 1.06 * max(max(row.ours, row.high) for row in chosen))


def draw(figures: Mapping[str, Mapping[str, Any]]) -> None:
    """The page of plots."""
    rows = laws.rows(figures)
    figure = Figure(figsize=(12.0, 12.4), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    plots = figure.subplots(4, 3)
    against_wind(plots[0, 0], figures, ("above", "own"))
    plots[0, 0].set_yscale("log")
    plots[0, 0].set_ylim(0.003, 60.0)
    panel(plots[0, 0], "whitecaps, % (from above; empty: own camera)\nlines: Monahan 1980, dashed Callaghan 2008")
    against_wind(plots[0, 1], figures, ("up",))
    against_wind(plots[0, 2], figures, ("across",))
    for axes, title in ((plots[0, 1], "along"), (plots[0, 2], "across")):
        panel(axes, f"slope variance {title} the wind\n(by glitter, as Cox and Munk 1954)")
    rest = ("path", "dense", "effective", "decay", "set", "height", "period", "steepness")
    for axes, key in zip(plots.ravel()[3:], rest, strict=False):
        of = laws.QUANTITIES[key]
        by_preset(axes, rows, key, figures)
        panel(axes, f"{of.title}, {of.unit}" if of.unit else of.title)
    last = plots[3, 2]
    last.axis("off")
    for name, colour in zip(PRESETS, COLOURS, strict=True):
        last.plot([], [], "o", color=colour, label=name)
    last.fill_between([], [], color=BAND, label="nature, published scatter")
    last.legend(loc="center", frameon=False, fontsize=10)
    save(figure, PICTURE)


def main() -> None:
    """Measure what is asked for or stale, and write figures, plots and page."""
    parser = argparse.ArgumentParser(description="Write docs/nature.md.")
    parser.add_argument(
        "presets", nargs="*", choices=[*PRESETS, []], help="presets to measure; none: those that changed"
    )
    parser.add_argument("--all", action="store_true", help="measure every preset")
    asked = parser.parse_args()
    known = json.loads(FIGURES.read_text(encoding="utf-8")) if FIGURES.exists() else {}
    stale = [name for name in PRESETS if known.get(name, {}).get("of") != measured_of(load_preset(name))]
    if unknown := set(asked.presets) - set(PRESETS):
        parser.error(f"not among {', '.join(PRESETS)}: {', '.join(unknown)}")
    names = PRESETS if asked.all else asked.presets or stale
    with closing(Executor()) as executor, Progress(console=Console(stderr=True)) as progress:
        for name in progress.track(names, description="presets"):
            found = measured(executor, load_preset(name))
            known[name] = {key: rounded(value) for key, value in found.items()}
    figures = {name: known[name] for name in PRESETS}
    lines = [f"{json.dumps(name)}: {json.dumps(figure)}" for name, figure in figures.items()]
    FIGURES.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
    draw(figures)
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), figures), encoding="utf-8")


if __name__ == "__main__":
    main()
