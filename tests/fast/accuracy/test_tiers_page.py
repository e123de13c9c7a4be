"""docs/accuracy.md opens with the cost of today's tiers, in today's scenes, as docs/accuracy.csv has it."""

import csv
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from seafoam.quality import TIERS
from seafoam.reference import scene_sha256
from seafoam.scene.presets import load_preset, preset_names

DOCS = Path(__file__).parents[3] / "docs"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(DOCS))
    return import_module("make_tiers")


def test_the_figures_are_of_todays_scenes(made: Any) -> None:
    with made.FIGURES.open(newline="") as file:
        found = {(row["preset"], row["tier"]): row["scene"] for row in csv.DictReader(file)}
    today = {(name, tier): scene_sha256(load_preset(name).scene) for name in preset_names() for tier in TIERS}
    assert found == today, "measure again: python docs/make_tiers.py PRESET"


def test_the_page_has_the_figures(made: Any) -> None:
    page = (DOCS / "accuracy.md").read_text(encoding="utf-8")
    found = made.measured()
    assert f"<!-- tiers: table -->\n{made.table(found)}<!-- end -->" in page
    assert f"<!-- tiers: steps -->\n{made.sentences(found)}<!-- end -->" in page


def test_errors_fall_from_tier_to_tier_in_most_scenes(made: Any) -> None:
    """Exactness is bought: the middle of all presets falls with every tier, and costs more."""
    rows = list(made.measured().values())
    for less, more in zip(TIERS, list(TIERS)[1:], strict=False):
        assert sum(of[more].error < of[less].error for of in rows) >= 0.6 * len(rows), (less, more)
        assert sum(of[more].ms >= of[less].ms for of in rows) >= 0.6 * len(rows), (less, more)
