"""Writes what was measured into the docs: blocks of ``performance.md``, and all of ``passes.md`` with its pictures."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from bench import plots
from bench.passes import SIZE, Frame
from bench.report import Table, ms

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURES = "pictures/passes"


def fill(text: str, name: str, block: str) -> str:
    """The text with a block between ``<!-- bench: name -->`` and ``<!-- end -->``. Raises where no such place is."""
    place = re.compile(rf"(<!-- bench: {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
    filled, found = place.subn(lambda match: f"{match[1]}{block}\n{match[2]}", text)
    if found != 1:
        raise RuntimeError(f"{found} places for the figures of {name}, not one")
    return filled


def write(
    about: Mapping[str, str],
    sections: Mapping[str, Sequence[Table]],
    frames: Sequence[Frame],
    docs: Path = DOCS,
) -> None:
    """Write the sections that have a place in ``performance.md``, and the page of the passes if there are frames."""
    performance = docs / "performance.md"
    text = performance.read_text(encoding="utf-8")
    for name in re.findall(r"<!-- bench: (\w+) -->", text):
        if name in sections:
            tables = (f"\n{table.text()}" for table in sections[name])
            text = fill(text, name, "\n".join(["```", lines(about), *tables, "```"]))
    performance.write_text(text, encoding="utf-8")
    if frames:
        _write_passes(about, frames, docs)


def lines(about: Mapping[str, str]) -> str:
    """Names and values, a line each."""
    width = max(map(len, about))
    return "\n".join(f"{name.ljust(width)}  {value}" for name, value in about.items())


def _write_passes(about: Mapping[str, str], frames: Sequence[Frame], docs: Path) -> None:
    folder = docs / PICTURES
    folder.mkdir(parents=True, exist_ok=True)
    pictures = {"all": plots.every_frame(frames), **{frame.preset: plots.one_frame(frame) for frame in frames}}
    for old in folder.glob("*.webp"):
        old.unlink()
    for name, data in pictures.items():
        (folder / f"{name}.webp").write_bytes(data)
    parts = [_head(about), *(_section(frame) for frame in frames)]
    (docs / "passes.md").write_text("\n".join(parts), encoding="utf-8")


def _head(about: Mapping[str, str]) -> str:
    return f"""# What a frame is made of

Every pass of every preset, with GL finished before and after it: {SIZE[0]} × {SIZE[1]}, quality `standard`, the
preset's own camera, on the machine below. Passes of one kind, such as those of an FFT, are one bar. Pale bars are drawn
with the first frame and kept; no later frame pays for them. A whole frame is drawn without the waits between passes.
What passes read and write is in the frame plan (`/api/plans/default`), what they compute in [formulae](formulae.md).

This page is made by a command, as the figures of [performance](performance.md) are:

    .venv/bin/python -m bench --only passes --docs

```
{lines(about)}
```

![All presets]({PICTURES}/all.webp)
"""


def _section(frame: Frame) -> str:
    rows = [f"## {frame.preset}", "", f"![{frame.preset}]({PICTURES}/{frame.preset}.webp)", ""]
    rows += ["| passes | number | ms | share |", "|---|---|---|---|"]
    for kind, number, seconds, kept in frame.kinds():
        share = "once" if kept else f"{100.0 * seconds / frame.drawn:.1f} %"
        rows.append(f"| {kind} | {number} | {ms(seconds)} | {share} |")
    rows.append(f"| *whole frame, without waits between* | | {ms(frame.whole)} | |")
    return "\n".join([*rows, ""])
