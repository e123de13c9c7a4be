"""The bench's own arithmetic, and what its tables are made of."""

import io
import re
from pathlib import Path

import numpy as np
import pytest
from bench import document, plots
from bench.drawn.frames import Cost
from bench.drawn.passes import Frame, Taken
from bench.drawn.steps import counting_shader
from bench.report import Column, Table
from bench.served.water_page import Frames
from bench.served.yardstick import GROUPS, MEASURED, Measured
from PIL import Image

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset, preset_names


def _cost(*seconds: float) -> list[Cost]:
    return [Cost(wall=one, cpu=2.0 * one) for one in seconds]


def test_a_round_is_held_against_three_js_before_and_after_it() -> None:
    measured = Measured()
    measured.add(_cost(0.3, 0.2, 0.4), [Frames((0.1, 0.1), cpu=0.1), Frames((0.3, 0.3, 0.3), cpu=0.5)])
    measured.add(_cost(0.5), [Frames((0.5,), cpu=0.25), Frames((0.5,), cpu=0.25)])
    assert measured.wall == pytest.approx([1.0, 1.0])
    assert measured.cpu == pytest.approx([0.6 / 0.3, 1.0 / 0.25])
    assert measured.frames == pytest.approx([1.0, 2.0 / 3.0, 4.0 / 3.0, 1.0])
    assert measured.seconds == pytest.approx(0.35)
    assert measured.three_seconds == pytest.approx(0.4)


def test_every_preset_but_the_mask_alone_is_in_one_group_of_the_yardstick() -> None:
    grouped = [name for group in GROUPS for name in group.presets]
    assert sorted([*grouped, "paper-threshold"]) == sorted(preset_names())
    assert all(group.aim[tier] < group.must[tier] for group in GROUPS for tier in MEASURED)
    assert all(group.must["fast"] < group.must["standard"] for group in GROUPS)


SURFACE = make_plan(load_preset("default").scene, TIERS["standard"]).programs
SHORE = make_plan(load_preset("beach").scene, TIERS["standard"]).programs


@pytest.mark.parametrize("name", ["surface", "met"])
def test_a_counting_text_counts_in_every_function_that_evaluates_waves(name: str) -> None:
    """And its main only finds what a ray meets first."""
    text = counting_shader((SHORE if name == "met" else SURFACE)[name].fragment).text
    # waves and waves_shading; before a shore, the open sea's waves alone.
    assert text.count("++bench_evaluations;") == (3 if name == "met" else 2)
    _, _, main = text.partition("void main() {")
    assert "first_met(" in main
    assert "foam" not in main


def _pass(name: str, seconds: float, *, kept: bool = False) -> Taken:
    return Taken(name, "program", 64, 64, seconds, kept)


FRAME = Frame(
    "sea",
    0.5,
    (
        _pass("shore: flood, 8 texels", 0.1, kept=True),
        _pass("sea: rows, 1 to 8", 0.1),
        _pass("earlier folds 0, 17.5 m tile", 0.05),
        _pass("sea, 17.5 m tile", 0.05),
        _pass("surface", 0.3),
    ),
)


def test_passes_of_a_kind_are_one_and_bars_of_the_same_figures_the_same_picture() -> None:
    assert FRAME.drawn == pytest.approx(0.5)
    assert FRAME.kinds() == [
        ("shore", 1, 0.1, True),
        ("sea", 2, pytest.approx(0.15), False),
        ("earlier folds", 1, 0.05, False),
        ("surface", 1, 0.3, False),
    ]
    for draw in (lambda: plots.one_frame(FRAME), lambda: plots.every_frame([FRAME, FRAME])):
        made = draw()
        assert made == draw()
        picture = np.asarray(Image.open(io.BytesIO(made)).convert("RGB"))
        assert picture.shape[1] > 700
        assert (picture == (0x1F, 0x3A, 0x73)).all(axis=-1).mean() > 0.05, "no bar is to be seen"


def test_a_run_is_written_into_the_docs(tmp_path: Path) -> None:
    """Sections that were measured are new, the others as they were, and pictures of presets that are gone are gone."""
    (tmp_path / "performance.md").write_text(
        "<!-- bench: yardstick on Mesa 25 -->\n<!-- end -->\n<!-- bench: yardstick on Mesa 22 -->\nkept\n<!-- end -->\n"
        "<!-- bench: page -->\nkept\n<!-- end -->\n",
        encoding="utf-8",
    )
    old = tmp_path / "pictures" / "passes" / "gone.webp"
    old.parent.mkdir(parents=True)
    old.write_bytes(b"")
    table = Table("Title", "A note.", (Column("a", "first"),), [("x",)])
    document.write({"GL": "4.5 Mesa 25.0.7"}, {"yardstick": [table], "http": [table]}, [FRAME], tmp_path)
    written = (tmp_path / "performance.md").read_text(encoding="utf-8")
    assert written == (
        "<!-- bench: yardstick on Mesa 25 -->\n```\nGL  4.5 Mesa 25.0.7\n\nTitle\nA note.\n\nfirst\n-----\nx\n```\n"
        "<!-- end -->\n<!-- bench: yardstick on Mesa 22 -->\nkept\n<!-- end -->\n"
        "<!-- bench: page -->\nkept\n<!-- end -->\n"
    )
    passes = (tmp_path / "passes.md").read_text(encoding="utf-8")
    assert "| sea | 2 | 150 | 30.0 % |\n" in passes
    assert "| shore | 1 | 100 | once |\n" in passes
    named = re.findall(r"\((pictures/passes/.*?\.webp)\)", passes)
    assert named == ["pictures/passes/all.webp", "pictures/passes/sea.webp"]
    assert {path.relative_to(tmp_path).as_posix() for path in old.parent.iterdir()} == set(named)
