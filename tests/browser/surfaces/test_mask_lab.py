"""The mask laboratory, as a visitor uses it; and its three.js snippet, run."""

import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Locator, Page, Route, expect

from seafoam.masks.catalogue import load_catalogue, load_mask, mask_by_name
from seafoam.masks.formats import quantised
from support.browser.lanes import Lane
from support.browser.visits import FINGER, PHONE, TARGETS, Visit, canvas_pixels, visit

LARGE = (1440, 900)
THREE = Path(__file__).resolve().parents[3] / "webclient" / "node_modules" / "three" / "build"
SMALL = {"family": "vac", "sigma": 2.0, "size": 64, "seed": 7}
FIRST = "vac:2:64:7"


def ready(page: Page, count: int = 1) -> None:
    """Wait until every mask is here."""
    expect(page.locator(".side[aria-busy=false]")).to_have_count(count, timeout=60_000)


def shown(page: Page, side: int = 0) -> NDArray[np.uint8]:
    """What a canvas holds, (height, width)."""
    return canvas_pixels(page.locator(".picture canvas").nth(side))[..., 0]


@pytest.fixture(scope="module")
def labs(llvmpipe: Lane, server: str) -> Iterator[Callable[[tuple[int, int]], Visit]]:
    """The laboratory in windows of a size, each opened once."""
    with ExitStack() as left:

        @cache
        def at(size: tuple[int, int]) -> Visit:
            touch = {"has_touch": True, "is_mobile": True} if size == PHONE else {}
            return left.enter_context(visit(llvmpipe, server, "masks/", size=size, settle=False, **touch))

        yield at


@pytest.fixture
def lab(labs: Callable[[tuple[int, int]], Visit], request: pytest.FixtureRequest) -> Visit:
    """The laboratory with one small mask; on a desktop, if the test does not say otherwise."""
    made = labs(getattr(request, "param", LARGE))
    # All that a visitor chooses is in the address.
    made.page.evaluate("(hash) => { location.hash = hash; }", f"mask={FIRST}&grey=0.25")
    expect(made.page.locator(".status")).to_have_text("vac, σ 2, 64 × 64 texels, seed 7; foam on 25.00 %")
    ready(made.page)
    return made


BOTH = pytest.mark.parametrize("lab", [LARGE, PHONE], ids=["desktop", "phone"], indirect=True)


def small() -> NDArray[np.uint64]:
    """The values of the small mask, (64, 64)."""
    return quantised(mask_by_name("vac:2:64:7").ranks, 16)


def numbers(table: Locator, column: int) -> list[float | None]:
    cells = table.locator(f"tbody td:nth-of-type({column})").all_text_contents()
    return [None if cell == "–" else float(cell) for cell in cells]


def test_it_shows_the_mask_and_its_pattern(lab: Visit) -> None:
    page = lab.page
    values = small()
    assert (shown(lab.page) == np.where(values < 0.25 * 65536, 255, 0)).all()
    page.get_by_role("slider", name="Grey level").fill("0.5")
    assert (shown(lab.page) == np.where(values < 0.5 * 65536, 255, 0)).all()
    assert "grey=0.5" in page.url
    page.get_by_label("Mask itself").check()
    assert (shown(lab.page) == values >> 8).all()
    page.get_by_label("Show", exact=True).select_option("tiled")
    assert (shown(lab.page) == np.tile(values >> 8, (2, 2))).all()
    page.get_by_label("Show", exact=True).select_option("detail")
    assert (shown(lab.page) == np.roll(values >> 8, (32, 32), (0, 1))).all()


def test_parameters_make_another_mask(lab: Visit) -> None:
    page = lab.page
    before = shown(lab.page)
    page.get_by_label("First mask: seed").fill("8")
    page.keyboard.press("Enter")
    expect(page.locator(".status")).to_contain_text("seed 8", timeout=30_000)
    assert (shown(lab.page) != before).any()
    assert "mask=vac:2:64:8" in page.url
    page.get_by_label("First mask: family").select_option("bubble")
    expect(page.locator(".status")).to_contain_text("bubble, σ 2", timeout=30_000)
    # What the server refuses is told with the allowed range; the mask before it stays.
    page.get_by_role("slider", name="First mask: sigma, texels").fill("20")
    expect(page.locator(".status")).to_contain_text("must be 2 to 8 texels", timeout=30_000)
    page.get_by_role("slider", name="First mask: sigma, texels").fill("4")
    expect(page.locator(".status")).to_contain_text("bubble, σ 4", timeout=30_000)
    lab.complaints[:] = [said for said in lab.complaints if "422" not in said]


@BOTH
def test_two_masks_beside_each_other(lab: Visit) -> None:
    page = lab.page
    page.get_by_label("Two side by side").check()
    ready(page, 2)
    page.get_by_label("Second mask: mask").select_option("mix")
    expect(page.locator(".status").last).to_contain_text("mix, ", timeout=30_000)
    expect(page.locator(".spectra .legend").first).to_contain_text(load_catalogue()["mix"].title)
    first, second = (page.locator(".picture").nth(side).bounding_box() for side in (0, 1))
    assert first["y"] == pytest.approx(second["y"])
    assert second["x"] >= first["x"] + first["width"]
    # One of own parameters, with all its controls, is not pushed down either.
    page.get_by_label("Second mask: mask").select_option("own parameters")
    expect(page.locator(".status").last).to_contain_text("128 × 128", timeout=30_000)
    first, second = (page.locator(".picture").nth(side).bounding_box() for side in (0, 1))
    assert first["y"] == pytest.approx(second["y"])
    page.get_by_label("Second mask: mask").select_option("mix")
    expect(page.locator(".status").last).to_contain_text("mix, σ", timeout=30_000)
    ready(page, 2)
    # The address restores both.
    page.goto(page.url)
    page.reload()
    ready(page, 2)
    assert page.get_by_label("Second mask: mask").input_value() == "mix"
    assert (shown(lab.page, 1) == np.where(quantised(load_mask("mix").ranks, 16) < 0.25 * 65536, 255, 0)).all()


def test_spectra_are_the_server_s(lab: Visit) -> None:
    measured = mask_by_name("vac:2:64:7").tables.spectrum
    (grey,) = (one for one in measured.greys if one.grey == 0.25)
    tables = lab.page.locator(".spectra table")
    raps, anisotropy = numbers(tables.nth(0), 1), numbers(tables.nth(1), 1)
    assert raps == pytest.approx(grey.raps.tolist(), rel=0.01)
    wide = measured.bins >= 32
    assert [value is not None for value in anisotropy] == wide.tolist()
    found = [value for value in anisotropy if value is not None]
    assert found == pytest.approx(grey.anisotropy_db[wide].tolist(), rel=0.01, abs=0.01)
    assert lab.page.locator(".spectra canvas").count() == 2


def test_every_format_downloads(lab: Visit) -> None:
    page = lab.page
    sizes = {}
    for link in page.locator(".formats a").all():
        url = link.evaluate("(link) => link.href")
        answer = page.request.get(url)
        assert answer.ok, url
        sizes[re.findall(r"/(data8?\.\w+|sidecar)\?", url)[0]] = len(answer.body())
    assert set(sizes) == {"data.png", "data.u16", "data.npy", "data.dds", "data8.png", "sidecar"}
    assert sizes["data.u16"] == 2 * 64 * 64
    for engine in ("Godot", "Unity", "Unreal"):
        page.get_by_role("button", name=engine, exact=True).click()
        expect(page.locator(".take-home .untested")).to_contain_text("not run here")
        assert "aturation" in (page.locator("pre").text_content() or "")


@BOTH
def test_it_fits_fingers_and_keys(lab: Visit, server: str) -> None:
    page = lab.page
    back = page.get_by_role("link", name="Back to the water", exact=True)
    assert back.evaluate("(link) => link.href") == f"{server}/"
    page.get_by_label("Two side by side").check()
    ready(page, 2)
    targets = [target for target in page.evaluate(TARGETS) if min(target[1:]) < FINGER]
    # A ticked box's label is its target.
    assert targets == []
    # On a phone, what is too wide widens the window itself.
    size = page.viewport_size
    assert page.evaluate("() => document.documentElement.scrollWidth") <= size["width"]
    page.locator("pre").scroll_into_view_if_needed()
    assert page.locator("pre").bounding_box() is not None
    page.get_by_label("Show", exact=True).focus()
    page.keyboard.press("Tab")
    assert page.evaluate("() => document.activeElement.type") == "checkbox"
    page.keyboard.press("Space")
    ready(page)


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


def test_the_three_snippet_draws_lit_antialiased_foam(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, f"masks/#mask={FIRST}", size=LARGE, settle=False) as made:
        page = made.page
        ready(page)
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
        # A standard material in perspective, against 256 samples a pixel; and it is the scene's light that shows it.
        lit = ("MeshStandardMaterial", 6, 3, "low")
        once = drawn(*lit, width=96, height=54)
        truth = drawn(*lit, width=96 * 16, height=54 * 16).reshape(54, 16, 96, 16).mean(axis=(1, 3))
        assert truth.max() > 60.0
        assert truth.std() > 15.0
        error = float(np.sqrt(((once - truth) ** 2).mean()))
        assert error < 12.0, error
        assert drawn("MeshStandardMaterial", 6, 0, "low", width=96, height=54).max() == 0.0
