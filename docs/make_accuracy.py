"""The tables of docs/accuracy.md that tests measure.

Run as ``python docs/make_accuracy.py`` after a change of their form. After a change of what is drawn, measure first::

    pytest tests/gpu/reference/*/test_f*.py tests/gpu/accuracy/test_real_sweep.py --figures .cache/accuracy.json
    python docs/make_accuracy.py .cache/accuracy.json

What is measured stands in docs/accuracy.json, by the titles of the tests' tables; a run that measures some of them
leaves the others as they are. The tables that the benchmarks measure are written by ``python -m bench --docs``.
"""

import argparse
import json
import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

PAGE = Path(__file__).parent / "accuracy.md"
FIGURES = Path(__file__).parent / "accuracy.json"
Row = dict[str, str]
MARK = re.compile(r"(<!-- tests: ([a-z ]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def markdown(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table, its heads above its rows."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def plain(rows: Sequence[Row]) -> str:
    """The rows as the tests print them."""
    return markdown([head.replace("_", " ") for head in rows[0]], [list(row.values()) for row in rows])


def worst(rows: Sequence[Row]) -> str:
    """For each preset the greatest figure of any time."""
    figures = {
        "more than 1° below the horizon": "below_1_degree",
        "whole frame": "whole",
        "flipped samples*": "flipped",
    }
    largest: dict[str, list[float]] = {}
    for row in rows:
        values = [float(row[key].removesuffix(" %")) for key in figures.values()]
        known = largest.setdefault(row["preset"], values)
        largest[row["preset"]] = [max(pair) for pair in zip(known, values, strict=True)]
    return markdown(
        ["preset", *figures],
        [[name, f"{near:.2f}", f"{whole:.2f}", f"{flips:.2f} %"] for name, (near, whole, flips) in largest.items()],
    )


def across(rows: Sequence[Row], side: str, head: str, value: str) -> str:
    """The figure ``value`` with ``side`` down and ``head`` across."""
    heads = list(dict.fromkeys(row[head] for row in rows))
    cells = {(row[side], row[head]): row[value] for row in rows}
    sides = dict.fromkeys(row[side] for row in rows)
    return markdown([side.replace("_", " "), *heads], [[one, *(cells[one, name] for name in heads)] for one in sides])


def by_scale(rows: Sequence[Row]) -> str:
    """Both looks of each mask across, scales down."""
    pairs = [
        {"texels_a_pixel": row["texels_a_pixel"], "of": f"{row['mask']}: {look}", "error": row[key]}
        for row in rows
        for look, key in (("halftone, 16", "halftone"), ("filtered, 1", "filtered"))
    ]
    return across(pairs, "texels_a_pixel", "of", "error")


TABLES: dict[str, tuple[str, Callable[[Sequence[Row]], str]]] = {
    "frames": ("Frames against the float64 truth", worst),
    "looks": (
        "One sample a pixel against 256",
        lambda rows: across(rows, "preset", "look", "picture"),
    ),
    "over waves": ("Filtered once against halftone sixteen times", plain),
    "by scale": ("Coverage by scale", by_scale),
    "mean coverage": ("Mean coverage of the filtered look", plain),
    "flicker": ("Flicker of default", plain),
}
"""Name of a place in the page -> how the title of the tests' table begins, and the form of its rows."""


def filled(text: str, tables: dict[str, list[Row]]) -> str:
    """The page's text with the tables in their places. Raises ``StopIteration`` where one was never measured."""

    def table(match: re.Match[str]) -> str:
        title, form = TABLES[match[2]]
        rows = next(rows for name, rows in tables.items() if name.startswith(title))
        return f"{match[1]}{form(rows)}{match[3]}"

    return MARK.sub(table, text)


def main() -> None:
    """Take figures from a file where one is named, and write the tables."""
    parser = argparse.ArgumentParser(description="Write the tables of docs/accuracy.md.")
    parser.add_argument("measured", nargs="?", type=Path, help="what pytest --figures wrote")
    measured = parser.parse_args().measured
    tables: dict[str, list[Row]] = json.loads(FIGURES.read_text(encoding="utf-8")) if FIGURES.exists() else {}
    if measured is not None:
        titles = tuple(title for title, _ in TABLES.values())
        ran = json.loads(measured.read_text(encoding="utf-8"))
        tables |= {title: rows for title, rows in ran.items() if title.startswith(titles)}
        ordered = dict(sorted(tables.items()))
        FIGURES.write_text(json.dumps(ordered, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), tables), encoding="utf-8")


if __name__ == "__main__":
    main()
