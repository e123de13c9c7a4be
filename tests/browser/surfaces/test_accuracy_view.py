"""The accuracy benchmark, as a visitor runs it: on a small truth, which stands in for the server's own."""

import csv
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, expect

from seafoam.quality import TIERS
from support.browser.accuracy_answers import PRESET, SIZE, points, staged, truth
from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import Visit, canvas_pixels, link, visit

AT = {"preset": PRESET, "scale": 0.25}
"""Behind the view the picture may be blurred: at the finest quality it takes half a minute on llvmpipe."""
MEASURED = 240_000
"""Longest time that a measurement may take here, ms."""


@pytest.fixture(scope="module")
def measured(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    """The page with the view open and everything measured."""
    with visit(llvmpipe, server, link(**AT)) as made:
        staged(made.page)
        assert not any("accuracy" in url for _, url in made.asked), "something of the view ran before it was opened"
        made.press("Accuracy benchmark")
        panel = made.page.locator("#accuracy")
        expect(panel).to_contain_text("Computing the float64 reference… 40 %, 7 s left")
        expect(panel.get_by_role("status").first).to_contain_text(f"{len(points())} qualities", timeout=MEASURED)
        panel.get_by_text("All qualities").click()
        yield made


@pytest.fixture
def panel(measured: Visit) -> Locator:
    """The view."""
    return measured.page.locator("#accuracy")


def quality(measured: Visit) -> Any:
    """What the page runs: a tier, or the parameters that it changes."""
    said = measured.state()["quality"] or "standard"
    return json.loads(said) if said.startswith("{") else said


def listed(panel: Locator) -> Locator:
    """The rows of the table of qualities."""
    return panel.locator("details", has_text="All qualities").locator("tbody tr")


def told_errors(panel: Locator) -> dict[str | None, float]:
    """The errors that the table of qualities shows."""
    return {
        row.locator("th button").text_content(): float(row.locator("td").nth(1).text_content() or "nan")
        for row in listed(panel).all()
    }


def test_every_quality_has_a_mark_and_a_row_and_files_have_all(measured: Visit, panel: Locator) -> None:
    assert panel.locator(".chart.machine").get_by_role("button").count() == listed(panel).count() == len(points())
    for point in points():
        said = panel.locator(f'.machine .mark[data-id="{point["id"]}"]').get_attribute("aria-label") or ""
        told = rf"{re.escape(str(point['label']))}: [\d.]+ ms, error [\d.]+(, on the Pareto front)?"
        assert re.fullmatch(told, said), said
    assert sorted(panel.locator(".chart text.name").all_text_contents()) == sorted(TIERS)
    assert canvas_pixels(panel.locator(".chart.machine canvas")).any(), "nothing is drawn"
    # The tier named so is as exact as this gets.
    errors = told_errors(panel)
    assert errors["standard"] > errors["reference"] == min(errors.values()) > 0.0
    assert violations(panel.page) == []
    with measured.page.expect_download() as download:
        panel.get_by_role("button", name="Download CSV").click()
    rows = list(csv.DictReader(io.StringIO(Path(download.value.path()).read_text())))
    assert {row["id"] for row in rows} == {point["id"] for point in points()}
    for row in rows:
        assert float(row["rmse"]) == pytest.approx(errors[row["label"]], rel=0.06, abs=0.006)


def test_a_mark_runs_its_quality(measured: Visit, panel: Locator) -> None:
    point = next(point for point in points() if point["parameter"])
    mark = panel.locator(f'.machine .mark[data-id="{point["id"]}"]')
    mark.focus()
    expect(panel.locator(".tip")).to_contain_text(point["label"])
    mark.press("Enter")
    assert mark.get_attribute("aria-pressed") == "true"
    wanted: Any = point["parameter"]["value"]
    for step in reversed(point["parameter"]["pointer"].split("/")[1:]):
        wanted = {step: wanted}
    assert quality(measured) == wanted
    expect(panel.locator(".selected")).to_contain_text(re.compile(r"Compared with standard: .*(time|error)"))
    measured.settle()
    measured.page.wait_for_function("() => location.hash.includes('quality={') && location.hash.includes('accuracy=1')")
    # The link restores it, and the settings list it.
    fragment = measured.page.url.partition("#")[2]
    measured.follow(link(**AT, quality="high", accuracy=1))
    assert quality(measured) == "high"
    measured.follow(f"#{fragment}")
    assert quality(measured) == wanted
    assert json.loads(measured.page.locator("#quality").input_value()) == wanted


def canvas(panel: Locator, side: str) -> np.ndarray[Any, Any]:
    return canvas_pixels(panel.locator(f".frame canvas{side}")).astype(float)


def test_the_picture_beside_its_error_and_numbers_of_a_pixel_beside_the_true_ones(panel: Locator) -> None:
    heat = {}
    for tier in ("fast", "reference"):
        panel.locator(f"tr[data-id={tier}] button").click()
        heat[tier] = canvas(panel, ".right")
    assert heat["fast"].shape == (*SIZE[::-1], 3)
    assert heat["fast"].mean() > 1.2 * heat["reference"].mean(), "more error is no warmer"
    # Against the reference itself: one picture beside the other, the right way up.
    panel.get_by_role("button", name="reference", exact=True).and_(panel.locator(".toggle button")).click()
    picture, true = canvas(panel, ":not(.right)"), canvas(panel, ".right")
    pixels = np.load(io.BytesIO(truth()))
    linear = pixels[..., :3].clip(0.0, 1.0)
    encoded = 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    assert np.abs(true - encoded).max() <= 1.0
    assert np.abs(picture - true).mean() < 12.0
    assert np.abs(picture - true[::-1]).mean() > 2 * np.abs(picture - true).mean()
    panel.get_by_role("button", name="Worst pixel").click()
    column, row = (int(panel.get_by_label(name, exact=True).input_value()) for name in ("Column", "Row"))
    last = panel.locator(".floats tbody tr").last
    assert last.locator("th").text_content() == "Reference"
    said = [float(cell) for cell in last.locator("td").all_text_contents()[:4]]
    assert said == pytest.approx(pixels[row, column].tolist(), abs=1e-5)


def test_the_server_s_own_measurement_stands_beside_it(panel: Locator) -> None:
    there = panel.locator(".chart.server")
    panel.get_by_label("Server measurement").check()
    expect(there.get_by_role("button")).to_have_count(len(points()))
    expect(there).to_contain_text("The server: the server's own")
    panel.get_by_label("Server measurement").uncheck()
    expect(there).to_have_count(0)
