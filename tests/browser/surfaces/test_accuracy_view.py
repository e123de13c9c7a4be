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
from support.browser.visits import FINGER, PHONE, TARGETS, Visit, canvas_pixels, link, visit

LARGE = (1280, 800)
AT = {"preset": PRESET, "scale": 0.25}
START = link(**AT)
"""Behind the view the picture may be blurred: at the finest quality it takes half a minute on llvmpipe."""
MEASURED = 240_000
"""Longest time that a measurement may take here, ms."""


def opened(visited: Visit) -> Locator:
    """The view, once all is measured."""
    panel = visited.page.locator("#accuracy")
    expect(panel.get_by_role("status").first).to_contain_text(f"{len(points())} qualities", timeout=MEASURED)
    return panel


@pytest.fixture(scope="module")
def measured(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    """The page with the view open and everything measured."""
    with visit(llvmpipe, server, START, size=LARGE) as made:
        staged(made.page)
        assert made.page.locator("#accuracy").count() == 0
        assert not any("accuracy" in url for _, url in made.asked), "something of the view ran before it was opened"
        made.press("Accuracy benchmark")
        expect(made.page.locator("#accuracy")).to_contain_text("Computing the float64 reference… 40 %, 7 s left")
        opened(made)
        yield made


@pytest.fixture
def panel(measured: Visit) -> Locator:
    """The view."""
    return measured.page.locator("#accuracy")


def marks(panel: Locator) -> Locator:
    return panel.locator(".chart.machine").get_by_role("button")


ACCENT, TEAL = (243, 199, 149), (127, 196, 192)


def ink(panel: Locator, colour: tuple[int, int, int]) -> int:
    """How many pixels of the diagram's canvas have a colour."""
    found = panel.locator(".chart.machine canvas").evaluate(
        "(canvas, [r, g, b]) => { const { width, height } = canvas;"
        " const { data } = canvas.getContext('2d').getImageData(0, 0, width, height); let count = 0;"
        " for (let i = 0; i < data.length; i += 4) {"
        "  const off = Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b);"
        "  count += off < 24 && data[i + 3] > 200 ? 1 : 0; }"
        " return count; }",
        list(colour),
    )
    return int(found)


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


def run(panel: Locator, tier: str) -> None:
    """Run a tier by its row."""
    panel.locator(f"details:has-text('All qualities') tr[data-id={tier}] button").evaluate("(button) => button.click()")


def test_every_quality_has_a_mark_and_a_row(panel: Locator) -> None:
    assert marks(panel).count() == len(points())
    for point in points():
        said = panel.locator(f'.machine .mark[data-id="{point["id"]}"]').get_attribute("aria-label") or ""
        told = rf"{re.escape(str(point['label']))}: [\d.]+ ms, error [\d.]+(, on the Pareto front)?"
        assert re.fullmatch(told, said), said
    assert sorted(panel.locator(".chart text.name").all_text_contents()) == sorted(TIERS)
    assert panel.locator(".machine .mark[aria-label$='on the Pareto front']").count() > 1
    assert ink(panel, ACCENT) > 100, "no line through the tiers"
    panel.get_by_text("All qualities").click()
    assert listed(panel).count() == len(points())
    # The tier named so is as exact as this gets.
    errors = told_errors(panel)
    assert errors["reference"] == min(errors.values()) > 0.0
    assert errors["reference"] < errors["standard"]
    assert violations(panel.page) == []


def test_a_mark_runs_its_quality(measured: Visit, panel: Locator) -> None:
    point = next(point for point in points() if point["parameter"])
    parameter = point["parameter"]
    mark = panel.locator(f'.machine .mark[data-id="{point["id"]}"]')
    mark.focus()
    expect(panel.locator(".tip")).to_contain_text(point["label"])
    expect(panel.locator(".tip")).to_contain_text(" ms, error ")
    mark.press("Enter")
    assert mark.get_attribute("aria-pressed") == "true"
    wanted: Any = parameter["value"]
    for step in reversed(parameter["pointer"].split("/")[1:]):
        wanted = {step: wanted}
    assert quality(measured) == wanted
    told = re.compile(r"Compared with standard: .*(time|error)")
    expect(panel.locator(".selected")).to_contain_text(told)
    measured.settle()
    measured.page.wait_for_function(
        "() => location.hash.includes('quality=%22') || location.hash.includes('quality={')"
    )
    assert "accuracy=1" in measured.page.url
    # The link restores it, and the settings list it.
    fragment = measured.page.url.partition("#")[2]
    measured.follow(link(**AT, quality="high", accuracy=1))
    assert quality(measured) == "high"
    measured.follow(f"#{fragment}")
    assert quality(measured) == wanted
    assert json.loads(measured.page.locator("#quality").input_value()) == wanted
    # Arrows go from mark to mark, in the order of time.
    mark.focus()
    mark.press("Home")
    measured.page.keyboard.press("ArrowRight")
    measured.page.keyboard.press("Enter")
    assert panel.locator(".machine .mark[aria-pressed=true]").evaluate("(mark) => mark === document.activeElement")


def test_a_click_runs_a_tier(measured: Visit, panel: Locator) -> None:
    mark = panel.locator(".machine .mark[data-id=reference]")
    mark.scroll_into_view_if_needed()
    box = mark.locator(".dot").bounding_box()
    measured.page.mouse.click(box["x"] + box["width"] / 2 + 4, box["y"] + box["height"] / 2 - 3)
    assert quality(measured) == "reference"
    # Which of two small pictures takes longer is the machine's to say; how near each is to the truth is not.
    told = re.compile(r"^Compared with standard: .*\btime(?: difference)?, ([\d.]+)× less error\.$")
    sentence = panel.locator(".sentence")
    expect(sentence).to_have_text(told)
    found = told.match(sentence.text_content() or "")
    errors = told_errors(panel)
    assert float(found[1]) == pytest.approx(errors["standard"] / errors["reference"], rel=0.06)


def canvas(panel: Locator, side: str) -> np.ndarray[Any, Any]:
    return canvas_pixels(panel.locator(f".frame canvas{side}")).astype(float)


def test_the_picture_beside_its_error(measured: Visit, panel: Locator) -> None:
    heat = {}
    for tier in ("fast", "reference"):
        run(panel, tier)
        assert quality(measured) == tier
        heat[tier] = canvas(panel, ".right")
    width, height = SIZE
    assert heat["fast"].shape == (height, width, 3)
    assert heat["fast"].std() > 10.0, "a blank map"
    assert heat["fast"].mean() > 1.2 * heat["reference"].mean(), "more error is no warmer"
    # Against the reference itself: one picture beside the other, the right way up.
    panel.get_by_role("button", name="reference", exact=True).and_(panel.locator(".toggle button")).click()
    picture, true = canvas(panel, ":not(.right)"), canvas(panel, ".right")
    linear = np.load(io.BytesIO(truth()))[..., :3].clip(0.0, 1.0)
    encoded = 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    assert np.abs(true - encoded).max() <= 1.0
    assert np.abs(picture - true).mean() < 12.0
    assert np.abs(picture - true[::-1]).mean() > 2 * np.abs(picture - true).mean()
    panel.get_by_role("button", name="error", exact=True).click()
    panel.get_by_role("slider", name="Split position").fill("20")
    assert panel.locator(".frame").evaluate("(frame) => frame.style.getPropertyValue('--at')") == "20%"


def test_a_budget_picks_the_best_that_fits(panel: Locator) -> None:
    budget, slider = panel.get_by_label("Frame budget"), panel.get_by_role("slider", name="Budget slider")
    picked, over, count = panel.locator(".budget-message"), panel.locator(".machine .mark.over"), len(points())
    budget.fill("0.01")
    budget.press("Tab")
    assert over.count() == count
    expect(picked).to_contain_text("none is within the budget")
    expect(picked).to_contain_text(f"fastest of {count}")
    expect(picked).to_contain_text(f"{LARGE[0]} × {LARGE[1]}")
    # The slider picks while it moves.
    slider.focus()
    slider.press("End")
    expect(picked).to_contain_text(f"least error of {count} qualities within the budget ({count} measured)")
    assert over.count() == 0
    labels = {mark: mark.get_attribute("aria-label") or "" for mark in marks(panel).all()}
    best = min(labels, key=lambda mark: float(re.findall(r"error ([\d.]+)", labels[mark])[0]))
    assert best.get_attribute("aria-pressed") == "true"


def test_the_server_s_own_measurement(measured: Visit, panel: Locator) -> None:
    there = panel.locator(".chart.server")
    assert there.count() == 0
    panel.get_by_label("Server measurement").check()
    expect(panel.locator(".server-switch", has_text="measuring, 40 %")).to_be_visible()
    expect(there.get_by_role("button")).to_have_count(len(points()))
    expect(there).to_contain_text("The server: the server's own")
    # Side by side, on the same axes.
    measured.page.wait_for_function(
        "() => document.querySelector('#accuracy').getAnimations({ subtree: true }).length === 0"
    )
    here, beside = panel.locator(".chart.machine").bounding_box(), there.bounding_box()
    assert (here["y"], here["width"]) == pytest.approx((beside["y"], beside["width"]))
    assert beside["x"] >= here["x"] + here["width"]
    # A mark under the pointer is marked in both.
    there.locator(".mark[data-id=high]").focus()
    assert panel.locator(".mark.highlighted[data-id=high]").count() == 2
    panel.get_by_label("Server measurement").uncheck()
    expect(there).to_have_count(0)


def test_the_measure_of_error_is_chosen(measured: Visit, panel: Locator) -> None:
    wanted = {"RMSE": 1, "FLIP": 2, "maximum": 3, "foam coverage": 4}
    try:
        for name, column in wanted.items():
            panel.get_by_label("Error", exact=True).select_option(name)
            for row in listed(panel).all()[:4]:
                label = panel.locator(f'.machine .mark[data-id="{row.get_attribute("data-id")}"]')
                said = float(re.findall(r"error ([\d.]+)", label.get_attribute("aria-label") or "")[0])
                told = float(row.locator("td").nth(column).text_content() or "nan")
                assert said == pytest.approx(told / (100.0 if name == "foam coverage" else 1.0), abs=0.006)
    finally:
        panel.get_by_label("Error", exact=True).select_option("RMSE")


def test_a_setting_s_curve_stands_out(measured: Visit, panel: Locator) -> None:
    chosen = panel.get_by_label("Setting", exact=True)
    settings = {point["parameter"]["title"] for point in points() if point["parameter"]}
    assert set(chosen.locator("option").all_text_contents()) == settings | {"all"}
    before = ink(panel, TEAL)
    chosen.select_option(index=1)
    assert ink(panel, TEAL) > before + 10
    # The setting's own value, and that of standard.
    assert panel.locator(".machine text.value").count() >= 1
    chosen.select_option("all")
    assert panel.locator("text.value").count() == 0


def test_insets_show_one_place_in_all(measured: Visit, panel: Locator) -> None:
    run(panel, "fast")
    insets = panel.locator(".insets figure")
    assert insets.locator("figcaption b").all_text_contents() == ["Selected", "Equal time", "Equal error", "Reference"]
    assert re.match(r"fast: [\d.]+ ms, RMSE [\d.]+", insets.first.locator("figcaption span").text_content() or "")
    panel.get_by_role("button", name="Worst pixel").click()
    floats = panel.locator(".floats tbody tr")
    column, row = (int(panel.get_by_label(name, exact=True).input_value()) for name in ("Column", "Row"))
    true = np.load(io.BytesIO(truth()))[row, column]
    said = [float(cell) for cell in floats.last.locator("td").all_text_contents()[:4]]
    assert said == pytest.approx(true.tolist(), abs=1e-5)
    assert floats.last.locator("th").text_content() == "Reference"
    drawn = [float(cell) for cell in floats.first.locator("td").all_text_contents()[:4]]
    error = 255 * np.sqrt(np.mean((np.clip(drawn[:3], 0, 1) - np.clip(true[:3], 0, 1)) ** 2))
    shown = float(floats.first.locator("td").last.text_content() or "nan")
    assert shown == pytest.approx(error, rel=0.02, abs=0.02)
    # Arrow keys and pointers move it in all insets at once.
    panel.locator(".insets").focus()
    measured.page.keyboard.press("ArrowLeft" if column else "ArrowRight")
    assert int(panel.get_by_label("Column", exact=True).input_value()) == (column - 1 if column else 1)
    places = insets.locator("i").evaluate_all("(marks) => marks.map(({ style }) => `${style.left} ${style.top}`)")
    assert len(places) >= 2
    assert len(set(places)) == 1


def test_what_is_shown_is_saved(measured: Visit, panel: Locator) -> None:
    def saved(name: str) -> str:
        with measured.page.expect_download() as download:
            panel.get_by_role("button", name=f"Download {name}").click()
        assert download.value.suggested_filename == f"seafoam-accuracy-{PRESET}.{name.lower()}"
        return Path(download.value.path()).read_text()

    rows = list(csv.DictReader(io.StringIO(saved("CSV"))))
    assert {row["id"] for row in rows} == {point["id"] for point in points()}
    errors = told_errors(panel)
    for row in rows:
        assert float(row["rmse"]) == pytest.approx(errors[row["label"]], rel=0.06, abs=0.006)
    document = json.loads(saved("JSON"))
    assert document["preset"] == PRESET
    assert [point["id"] for point in document["points"]] == [row["id"] for row in rows]


def test_a_changed_scene_is_told(measured: Visit, panel: Locator) -> None:
    note = panel.locator(".edited")
    assert not note.is_visible()
    measured.follow(link(**AT, accuracy=1, scene={"/light/exposure": -1.5}))
    expect(note).to_contain_text("presets only")
    assert marks(panel).count() == len(points())
    measured.follow(START)
    expect(panel).to_be_hidden()
    assert "accuracy" not in measured.page.url


def test_opened_by_its_address_and_cancelled(llvmpipe: Lane, server: str) -> None:
    """On a phone: it opens by its address, stops when told, keeps what it has, and every target fits a finger."""
    with visit(llvmpipe, server, START, size=PHONE, has_touch=True, is_mobile=True) as made:
        staged(made.page)
        made.page.evaluate("(fragment) => { location.hash = fragment; }", link(**AT, accuracy=1))
        made.page.reload()
        panel = made.page.locator("#accuracy.open")
        panel.wait_for()
        made.page.locator("#loading").wait_for(state="hidden")
        panel.get_by_role("button", name="Cancel").click()
        again = panel.get_by_role("button", name="Measure again")
        again.click()
        made.page.wait_for_function("() => document.querySelectorAll('#accuracy .mark').length >= 3", timeout=MEASURED)
        panel.get_by_role("button", name="Cancel").click()
        expect(panel.get_by_role("status").first).to_have_text(
            re.compile(rf"Cancelled\. \d+ of {len(points())} qualities measured")
        )
        again.wait_for()
        assert panel.locator(".mark").count() >= 3
        panel.locator("summary").last.click()
        made.page.wait_for_function(
            "() => document.querySelector('#accuracy').getAnimations({ subtree: true }).length === 0"
        )
        assert [target for target in made.page.evaluate(TARGETS) if min(target[1:]) < FINGER] == []
        box = panel.bounding_box()
        assert (box["x"], box["width"]) == (0, PHONE[0])
        assert box["y"] > PHONE[1] / 4, "no picture is left to judge by"
        assert made.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
        made.page.keyboard.press("Escape")
        expect(made.page.locator("#accuracy")).to_be_hidden()
