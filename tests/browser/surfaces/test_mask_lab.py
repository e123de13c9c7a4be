"""The mask laboratory, as a visitor uses it; and its three.js snippet, run."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page, Route, expect

from seafoam.masks.catalogue import load_mask, mask_by_name
from seafoam.masks.formats import quantised
from support.browser.lanes import Lane
from support.browser.visits import Visit, canvas_pixels, visit

THREE = Path(__file__).resolve().parents[3] / "webclient" / "node_modules" / "three" / "build"
FIRST = "vac:2:64:7"


def ready(page: Page, count: int = 1) -> None:
    """Wait until every mask is here."""
    expect(page.locator(".side[aria-busy=false]")).to_have_count(count, timeout=60_000)


def shown(page: Page, side: int = 0) -> NDArray[np.uint8]:
    """What a canvas holds, (height, width)."""
    return canvas_pixels(page.locator(".picture canvas").nth(side))[..., 0]


@pytest.fixture(scope="module")
def opened(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, "masks/", size=(1440, 900), settle=False) as made:
        yield made


@pytest.fixture
def lab(opened: Visit, server: str) -> Visit:
    """The laboratory with one small mask: all that a visitor chooses is in the address."""
    opened.page.goto(f"{server}/masks/#mask={FIRST}&grey=0.25")
    expect(opened.page.locator(".status")).to_have_text("vac, σ 2, 64 × 64 texels, seed 7; foam on 25.00 %")
    ready(opened.page)
    return opened


def small() -> NDArray[np.uint64]:
    """The values of the small mask, (64, 64)."""
    return quantised(mask_by_name(FIRST).ranks, 16)


def test_it_shows_the_mask_and_its_pattern(lab: Visit) -> None:
    page, values = lab.page, small()
    assert (shown(page) == np.where(values < 0.25 * 65536, 255, 0)).all()
    page.get_by_role("slider", name="Grey level").fill("0.5")
    assert (shown(page) == np.where(values < 0.5 * 65536, 255, 0)).all()
    assert "grey=0.5" in page.url
    page.get_by_label("Mask itself").check()
    page.get_by_label("Show", exact=True).select_option("tiled")
    assert (shown(page) == np.tile(values >> 8, (2, 2))).all()


def test_parameters_make_another_mask_and_what_the_server_refuses_is_told(lab: Visit) -> None:
    page, status = lab.page, lab.page.locator(".status")
    before = shown(page)
    page.get_by_label("First mask: seed").fill("8")
    page.keyboard.press("Enter")
    expect(status).to_contain_text("seed 8", timeout=30_000)
    assert (shown(page) != before).any()
    assert "mask=vac:2:64:8" in page.url
    page.get_by_label("First mask: family").select_option("bubble")
    expect(status).to_contain_text("bubble, σ 2", timeout=30_000)
    page.get_by_role("slider", name="First mask: sigma, texels").fill("20")
    expect(status).to_contain_text("outside 2..8 texels", timeout=30_000)
    lab.complaints[:] = [said for said in lab.complaints if "422" not in said]


def test_two_masks_beside_each_other_are_restored_by_their_address(lab: Visit) -> None:
    page = lab.page
    page.get_by_label("Two side by side").check()
    ready(page, 2)
    page.get_by_label("Second mask: mask").select_option("mix")
    expect(page.locator(".status").last).to_contain_text("mix, σ", timeout=30_000)
    first, second = (page.locator(".picture").nth(side).bounding_box() for side in (0, 1))
    assert first["y"] == pytest.approx(second["y"])
    assert second["x"] >= first["x"] + first["width"]
    page.reload()
    ready(page, 2)
    assert page.get_by_label("Second mask: mask").input_value() == "mix"
    assert (shown(page, 1) == np.where(quantised(load_mask("mix").ranks, 16) < 0.25 * 65536, 255, 0)).all()


PAGE = """<!doctype html><html><head>
<script type="importmap">{"imports": {"three": "./three.module.js"}}</script></head><body><script type="module">
import * as THREE from "three";
import { addFoam, loadMask } from "./mask.js";
const renderer = new THREE.WebGLRenderer();
const mask = await loadMask();
window.draw = (material, tiles, lit, camera, width, height) => {
  const target = new THREE.WebGLRenderTarget(width, height);
  const scene = new THREE.Scene();
  const made = new THREE[material]({ color: 0 });
  addFoam(made, mask, "0.3", tiles);
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), made);
  scene.add(plane, new THREE.DirectionalLight(0xffffff, lit));
  const above = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
  const eye = camera === "above" ? above : new THREE.PerspectiveCamera(50, 16 / 9, 0.01, 10);
  if (camera === "low") {
    plane.rotation.x = -1.2;
    eye.position.set(0.1, 0, 1.1);
  }
  renderer.setRenderTarget(target);
  renderer.render(scene, eye);
  const pixels = new Uint8Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  return Array.from(pixels.filter((_, i) => i % 4 === 0));
};
</script></body></html>"""


def test_the_three_snippet_draws_lit_antialiased_foam(lab: Visit, server: str) -> None:
    page = lab.page
    expect(page.locator(".take-home .tested")).to_contain_text("Run in this project's tests")
    code = page.locator("pre code").text_content() or ""

    def answer(route: Route) -> None:
        name = route.request.url.rpartition("/")[2]
        content = {"index.html": PAGE, "mask.js": code}.get(name) or (THREE / name).read_text()
        route.fulfill(body=content, content_type="text/html" if name == "index.html" else "text/javascript")

    page.route("**/snippet/*", answer)
    page.goto(f"{server}/snippet/index.html")
    page.wait_for_function("() => window.draw !== undefined", timeout=60_000)

    def drawn(*asked: object, width: int, height: int) -> NDArray[np.float64]:
        values = page.evaluate("(asked) => window.draw(...asked)", [*asked, width, height])
        return np.array(values, np.float64).reshape(height, width)

    # A pixel a texel, unlit: the pattern itself. The target's first row is the mask's first: v = 0.
    pattern = np.tile(small() + 0.5 < 0.3 * 65536, (2, 2))
    # Half floats may move the one threshold that is next to the saturation.
    wrong = np.abs(drawn("MeshBasicMaterial", 2, 0, "above", width=128, height=128) - 229.5 * pattern) > 1.0
    assert wrong.sum() <= 4
    # A standard material in perspective, against 64 samples a pixel; and it is the scene's light that shows it.
    lit = ("MeshStandardMaterial", 6, 3, "low")
    once = drawn(*lit, width=96, height=54)
    truth = drawn(*lit, width=96 * 8, height=54 * 8).reshape(54, 8, 96, 8).mean(axis=(1, 3))
    assert truth.max() > 60.0
    assert truth.std() > 15.0
    error = float(np.sqrt(((once - truth) ** 2).mean()))
    assert error < 12.0, error
    assert drawn("MeshStandardMaterial", 6, 0, "low", width=96, height=54).max() == 0.0
