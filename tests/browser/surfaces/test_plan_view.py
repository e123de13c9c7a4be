"""The plan view: what runs, why, what was left out, and the GLSL as the driver has it."""

import hashlib
from itertools import product

import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from support.browser.lanes import Lane
from support.browser.visits import Visit, link, visit
from support.scenes import load_preset

SIZE = (900, 600)


def tab(made: Visit, name: str) -> None:
    made.page.locator(".sheet").get_by_role("button", name=name, exact=True).click()


def test_effects_with_why_and_skipped_ones_with_their_bound(llvmpipe: Lane, server: str) -> None:
    plan = make_plan(load_preset("lake-calm").scene, TIERS["fast"])
    assert plan.skipped
    with visit(llvmpipe, server, link(preset="lake-calm", open="plan"), size=SIZE) as made:
        tab(made, "Effects")
        for kind, effects in ((":not(.skipped)", plan.effects), (".skipped", plan.skipped)):
            told = made.page.locator(f".notes{kind} > li").all_inner_texts()
            assert len(told) == len(effects)
            for text, effect in zip(told, effects, strict=True):
                assert effect.why in text
                assert ("of 255" in text) == (effect.bound is not None)


def test_changes_against_the_preset(llvmpipe: Lane, server: str) -> None:
    start = link(quality="standard", preset="paper-halftone", open="plan")
    with visit(llvmpipe, server, start, size=SIZE) as made:
        tab(made, "Changes")
        made.page.get_by_text("This plan is that of").wait_for()
        made.follow(link(quality="standard", preset="paper-halftone", open="plan", scene={"/foam/look": "textured"}))
        made.page.locator(".plan-changes").wait_for()
        told = made.page.locator(".plan-changes li").all_inner_texts()
        assert any(text.startswith("program surface changed") for text in told), told


@pytest.mark.parametrize("preset", ["default", "paper-halftone"])
def test_the_passes_are_those_of_the_plan_and_the_glsl_is_the_drivers_byte_for_byte(
    llvmpipe: Lane, server: str, preset: str
) -> None:
    plan = make_plan(load_preset(preset).scene, TIERS["fast"])
    with visit(llvmpipe, server, link(preset=preset, open="plan"), size=SIZE) as made:
        sheet = made.page.locator(".sheet")
        for when in {one.when for one in plan.passes}:
            part = sheet.locator(f".kind.{when}")
            passes = [one for one in plan.passes if one.when == when]
            assert f"{len(passes)} pass" in part.get_by_role("heading").inner_text()
            nodes = part.locator(".node .name").all_text_contents()
            assert len(nodes) == len({one.program for one in passes})
            part.locator("summary").click()
            rows = part.locator("tbody tr")
            assert rows.count() == len(passes)
            assert rows.first.locator("td").first.inner_text() == passes[0].name
        # llvmpipe's timers are wrong: the page says so, and shows no number.
        assert "CPU" in sheet.get_by_text("Time of each pass").inner_text()
        assert sheet.locator("tbody td:last-child").all_inner_texts() == [""] * len(plan.passes)
        tab(made, "GLSL")
        for name, stage in product(("surface", "present"), ("vertex", "fragment")):
            sheet.get_by_label("Program").select_option(name)
            tab(made, stage)
            shader = getattr(plan.programs[name], stage)
            sheet.get_by_text("As the driver has it").get_by_text(shader.sha256[:12]).wait_for()
            text = made.page.evaluate("() => document.querySelector('pre.glsl').textContent")
            assert hashlib.sha256(text.encode()).hexdigest() == shader.sha256
            files = sheet.locator(".line[data-file]").evaluate_all("(all) => all.map((one) => one.dataset.file)")
            assert files == [one.path for one in shader.files]
            assert sheet.locator(".glsl .keyword").count() > 0
