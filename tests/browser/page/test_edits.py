"""Edits of the scene: undone and redone, compared with the preset, copied and pasted."""

import json

import pytest
from playwright.sync_api import expect

from support.browser.lanes import Lane
from support.browser.visits import Visit, differs, link, visit
from support.scenes import load_preset


def test_edits_are_undone_and_redone(small: Visit) -> None:
    page = small.page
    before = small.picture()
    small.type("exposure", "1", folder="light")
    bright = small.picture()
    small.settings().get_by_label("look", exact=True).select_option(label="halftone")
    both = [["/foam/look", "halftone"], ["/light/exposure", 1]]
    assert small.state()["changes"] == both
    page.locator("#canvas").focus()
    page.keyboard.press("Control+z")
    assert small.state()["changes"] == both[1:]
    assert (small.picture() == bright).all()
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == []
    assert (small.picture() == before).all()
    expect(page.get_by_role("button", name="Undo")).to_be_disabled()
    page.locator("#canvas").focus()
    page.keyboard.press("Control+Shift+z")
    assert small.state()["changes"] == both[1:]
    page.get_by_role("button", name="Redo").click()
    assert small.state()["changes"] == both
    expect(page.get_by_role("button", name="Redo")).to_be_disabled()


def test_changes_are_listed_and_reverted_one_by_one(small: Visit) -> None:
    page = small.page
    small.follow(link(scene={"/light/exposure": 1, "/foam/look": "textured"}))
    small.settings()
    summary = page.locator(".changes summary")
    expect(summary).to_have_text("2 changed from the preset")
    summary.click()
    own = load_preset("default").scene
    rows = page.locator(".changes li")
    expect(rows.nth(0)).to_contain_text(f"{own.foam.look} → textured")
    expect(rows.nth(1)).to_contain_text("→ 1")
    page.get_by_role("button", name="Revert /foam/look").click()
    assert small.state()["changes"] == [["/light/exposure", 1]]
    page.get_by_role("button", name="Revert /light/exposure").click()
    expect(summary).to_have_text("no change from the preset")
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == [["/light/exposure", 1]]


def test_a_scene_is_pasted_and_what_is_wrong_with_it_told(small: Visit) -> None:
    page = small.page
    before = small.picture()
    small.settings()
    page.get_by_role("button", name="Paste scene").click()
    text, alert = page.get_by_label("Scene as JSON"), page.locator(".paste [role=alert]")
    apply = page.get_by_role("button", name="Apply")
    expect(apply).to_be_disabled()
    text.fill("{")
    apply.click()
    expect(alert).to_contain_text("Not JSON")
    text.fill('{"light": {"exposure": 1000}}')
    apply.click()
    expect(alert).to_contain_text("exposure")
    assert small.state()["changes"] == []
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    storm = load_preset("storm").scene
    text.fill(json.dumps({"scene": storm.model_dump(mode="json")}))
    apply.click()
    expect(text).to_have_count(0)
    assert small.state()["camera"]["position"] == list(storm.camera.position)
    assert differs(small.picture(), before) > 0.5
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == []


@pytest.mark.parametrize("permissions", [["clipboard-read", "clipboard-write"]])
def test_a_scene_is_copied_whole(llvmpipe: Lane, server: str, permissions: list[str]) -> None:
    with visit(llvmpipe, server, link(scene={"/light/exposure": 1}), permissions=permissions) as made:
        made.settings()
        made.press("Copy scene")
        made.page.get_by_text("Scene copied").wait_for()
        copied = json.loads(made.page.evaluate("() => navigator.clipboard.readText()"))
        own = load_preset("default").scene.model_dump(mode="json")
        own["light"]["exposure"] = 1
        assert copied == own
