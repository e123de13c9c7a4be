"""The table of hard cases in docs/stability.md: what effects declare of them, and what their tests measured last.

Run as ``python docs/make_stability.py`` after a change of words. After a change of what is drawn, measure first::

    pytest -m "sweep or not sweep" tests/gpu/numerics/test_hard_cases.py tests/gpu/numerics/test_mutations.py \\
        tests/browser/pixels/test_parity.py --figures hard-cases.json
    python docs/make_stability.py hard-cases.json

What is measured stands in docs/stability.json; a run of some cases leaves the others' figures as they are. With
``--pictures`` the cases of SHOWN are drawn with and without their guards (docs/pictures/guards.webp).
"""

import argparse
import hashlib
import json
import sys
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from PIL import Image

from seafoam.effects import EFFECTS

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests"))

from support.cases import HardCase, cases_of
from support.hard.mutations import Replaced, copied, run

PAGE = Path(__file__).parent / "stability.md"
FIGURES = Path(__file__).parent / "stability.json"
PICTURE = Path(__file__).parent / "pictures" / "guards.webp"
MARK = "<!-- cases -->\n"
SHOWN = (
    "sixteen equal waves",
    "the moon before the sun",
    "sparkles of a sun that sets through the horizon",
    "the lake's highlight at its sharpest",
    "eye above the clouds",
    "a hundred thousand little clouds",
    "a boat on a breaking crest",
    "eye in a boat",
    "an eye in a crest, below",
    "an eye under the floor",
)
"""Cases whose guards are best seen where they are missing."""
SIZE, GAP = (256, 144), 4
"""Of a picture, pixels, and between two."""
REFERENCE = "Hard cases against the float64 reference"
BROWSER = "Hard cases on SwiftShader"
GUARDS = "Guards of hard cases taken out"
"""How the titles of the tests' tables begin (tests/gpu/numerics, tests/browser)."""
Figures = dict[str, dict[str, Any]]
"""By a case's name: ``of``, what was measured; ``mean`` (levels) and ``over_2`` (%) against the
reference, ``swiftshader`` (levels), ``without``: what tests say of the case without its guard."""


def drawn(case: HardCase) -> str:
    """Hash of what is drawn of a case: scene, times and camera, without what is at its default."""
    scene, camera = (each.model_dump(mode="json", exclude_defaults=True) for each in (case.scene, case.camera))
    what = [scene, case.times, camera]
    return hashlib.sha256(json.dumps(what, sort_keys=True).encode()).hexdigest()[:12]


def merged(figures: Mapping[str, Mapping[str, Any]], tables: Mapping[str, list[dict[str, str]]]) -> Figures:
    """The figures updated by those of a run, for existing cases; without those of cases that have changed since."""
    result: Figures = {}
    for case in (case for effect in EFFECTS for case in cases_of(effect).hard):
        of = drawn(case)
        known = figures.get(case.name, {})
        figure = dict(known) if known.get("of") == of else {"of": of}
        for title, rows in tables.items():
            own = [row for row in rows if row.get("case") == case.name]
            if own and title.startswith(REFERENCE):
                figure["mean"] = float(own[0]["mean"])
                figure["over_2"] = float(own[0]["over_2"].removesuffix(" %"))
            elif own and title.startswith(BROWSER):
                figure["swiftshader"] = max(float(row["mean"]) for row in own)
            elif own and title.startswith(GUARDS):
                figure["without"] = own[0]["seen"]
        if "mean" in figure:
            result[case.name] = figure
    return result


def table(figures: Mapping[str, Mapping[str, Any]]) -> str:
    """A row for each case, in Markdown. Raises ``KeyError`` for a case without figures."""
    rows = ["| case | guard, and where | without it | now | SwiftShader |", "|---|---|---|---|---|"]
    for effect in EFFECTS:
        for case in cases_of(effect).hard:
            figure = figures[case.name]
            cells = [
                f"{effect.name}: {case.name}",
                case.guard,
                figure["without"],
                f"{figure['mean']:.4f} levels, {figure['over_2']:.2f} % over 2",
                f"{figure['swiftshader']:.2f}" if "swiftshader" in figure else "–",
            ]
            joined = " | ".join(cell.replace("|", r"\|") for cell in cells)
            rows.append(f"| {joined} |")
    return "\n".join(rows) + "\n"


def filled(text: str, figures: Mapping[str, Mapping[str, Any]]) -> str:
    """The page's text with the table between its marks."""
    before, _, after = text.split(MARK)
    return before + MARK + table(figures) + MARK + after


def shown(name: str, replaced: Replaced, folder: Path) -> Image.Image:
    """A case as a screen shows it, drawn by sources with these texts replaced."""
    with copied(folder / "sources", replaced) as environment:
        file = folder / "pictures.npz"
        said = run(environment, "-m", "support.hard.pictures", name, str(file), *map(str, SIZE))
        if said is not None:
            raise ValueError(f"{name}: {said}")
    with np.load(file) as pictures:
        last = max(key for key in pictures if key.startswith("exact"))
        light = np.clip(np.nan_to_num(pictures[last][..., :3]), 0.0, 1.0)
    return Image.fromarray(np.uint8(255.0 * light ** (1.0 / 2.2) + 0.5))


def draw_guards() -> None:
    """A row for each two cases of SHOWN: with the guard, and without it."""
    sheet = Image.new("RGB", (4 * SIZE[0] + 3 * GAP, len(SHOWN) // 2 * (SIZE[1] + GAP) - GAP), "white")
    without = {case.name: case.without for effect in EFFECTS for case in cases_of(effect).hard}
    with TemporaryDirectory() as folder:
        for i, name in enumerate(SHOWN):
            for j, replaced in enumerate(({}, without[name])):
                at = (2 * (i % 2) + j) * (SIZE[0] + GAP), i // 2 * (SIZE[1] + GAP)
                sheet.paste(shown(name, replaced, Path(folder)), at)
    sheet.save(PICTURE, quality=80, method=6)


def main() -> None:
    """Merge figures where a file is named, write the table, and draw the guards' pictures where asked."""
    parser = argparse.ArgumentParser(description="Write the table of docs/stability.md.")
    parser.add_argument("measured", nargs="?", type=Path, help="what pytest --figures wrote")
    parser.add_argument("--pictures", action="store_true", help="draw cases with and without their guards")
    asked = parser.parse_args()
    if asked.pictures:
        draw_guards()
    measured = asked.measured
    figures = json.loads(FIGURES.read_text(encoding="utf-8"))
    if measured is not None:
        figures = merged(figures, json.loads(measured.read_text(encoding="utf-8")))
        lines = [f"{json.dumps(name, ensure_ascii=False)}: {json.dumps(figure)}" for name, figure in figures.items()]
        FIGURES.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), figures), encoding="utf-8")


if __name__ == "__main__":
    main()
