"""Figures in docs are of today's scenes and qualities: reports, where tiers lie on the front, and docs/accuracy.md."""

import csv
import json
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pytest

from seafoam.accuracy.points import points_of
from seafoam.accuracy.timing import TOLD, beating
from seafoam.quality import TIERS
from seafoam.reference import scene_sha256
from seafoam.render.service.jobs import plan_hash
from seafoam.scene import load_preset, preset_names
from support.report import Report
from support.sweep import spread

DOCS = Path(__file__).parents[3] / "docs"
AGAIN = "measure anew, as docs/reports/README.md says"
UNBEATEN = 110
"""Of the 120 tiers of all presets, so many at least are beaten by no other quality; docs/reports has the rest."""
SPAN = 20.0
"""From the fastest tier to the slowest, times, in the middle of the presets."""


@dataclass(frozen=True)
class Measured:
    """A line of a report: times by round (ms), RMSE (levels), parameters that are not their defaults (JSON), scene."""

    rounds: tuple[float, ...]
    error: float
    quality: str
    scene: str


@cache
def measured(preset: str) -> dict[str, Measured]:
    """What the preset's report says, by point."""
    with (DOCS / "reports" / f"{preset}.csv").open(newline="") as file:
        return {
            row["id"]: Measured(
                tuple(map(float, row["rounds_ms"].split())), float(row["rmse"]), row["quality"], row["scene"]
            )
            for row in csv.DictReader(file)
        }


def points_of_tiers(preset: str) -> dict[str, str]:
    """The point that stands for each tier: tiers of one plan are one point."""
    if measured(preset).keys() >= TIERS.keys():
        return {tier: tier for tier in TIERS}
    scene = load_preset(preset).scene
    by_plan = {plan_hash(scene, quality): tier for tier, quality in TIERS.items() if tier in measured(preset)}
    return {tier: by_plan[plan_hash(scene, quality)] for tier, quality in TIERS.items()}


def test_reports_are_of_todays_scenes() -> None:
    for preset in preset_names():
        scenes = {one.scene for one in measured(preset).values()}
        assert scenes == {scene_sha256(load_preset(preset).scene)}, f"{preset}: {AGAIN}"


@pytest.mark.parametrize("preset", spread(preset_names(), len(preset_names()), preset_names().index("default")))
def test_a_report_is_of_todays_qualities(preset: str) -> None:
    points = points_of(load_preset(preset).scene)
    today = {point.id: json.loads(point.quality.model_dump_json(exclude_defaults=True)) for point in points}
    assert {id: json.loads(one.quality) for id, one in measured(preset).items()} == today, AGAIN


def test_tiers_lie_on_the_front(report: Report) -> None:
    unbeaten = 0
    spans = []
    for preset in preset_names():
        found = measured(preset)
        tiers = points_of_tiers(preset)
        by = beating({id: (one.rounds, one.error) for id, one in found.items()})
        unbeaten += sum(not by[id] for id in tiers.values())
        times = [median(found[id].rounds) for id in tiers.values()]
        spans.append(max(times) / min(times))
        for tier, id in tiers.items():
            if by[id]:
                report.add("Tiers that another quality beats", preset=preset, tier=tier, by=by[id][0])
    whole = len(TIERS) * len(spans)
    report.add("Tiers on the front", unbeaten=f"{unbeaten}", of=f"{whole}", span=f"{median(spans):.0f}")
    assert unbeaten >= UNBEATEN
    assert median(spans) >= SPAN


def test_fast_errs_no_more_than_a_plainly_upscaled_tier_of_its_cost() -> None:
    """By the page's fronts, at 480 x 270, but for paper-threshold: of black and white texels any blur errs less."""
    kept = json.loads((DOCS.parent / "webclient/public/fronts.json").read_text(encoding="utf-8"))
    scales, pixels, beaten = kept["scales"][::-1], 480 * 270 / 1e6, {}
    for name, tiers in kept["presets"].items():
        fast, *others = tiers
        assert fast["tier"] == "fast"
        for other in others:
            share = (fast["fixed"] + fast["pixels"] * pixels - other["fixed"]) / (other["pixels"] * pixels)
            if share > scales[0] ** 2:
                error = np.interp(min(share, 1.0) ** 0.5, scales, other["errors"][::-1])
                beaten[name] = min(error / fast["errors"][0], beaten.get(name, np.inf))
    assert {name for name, ratio in beaten.items() if ratio < 1.0 / TOLD} == {"paper-threshold"}, beaten


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(DOCS))
    return import_module("make_tiers")


def test_the_page_has_the_figures_of_todays_scenes(made: Any) -> None:
    with made.FIGURES.open(newline="") as file:
        found = {(row["preset"], row["tier"]): row["scene"] for row in csv.DictReader(file)}
    today = {(name, tier): scene_sha256(load_preset(name).scene) for name in preset_names() for tier in TIERS}
    assert found == today, "measure again: python docs/make_tiers.py PRESET"
    page = (DOCS / "accuracy.md").read_text(encoding="utf-8")
    *lower, most = TIERS
    shown = f"![A part of {made.CROP[0]} at {', '.join(lower)} and {most}](pictures/accuracy/crops.webp)"
    assert shown in page, "draw the crops again: python docs/make_tiers.py --page"
    found = made.measured()
    assert f"<!-- tiers: table -->\n{made.table(found)}<!-- end -->" in page
    assert f"<!-- tiers: steps -->\n{made.sentences(found)}<!-- end -->" in page
