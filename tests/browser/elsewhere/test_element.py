"""The element's package: packed by npm, loaded in a foreign page, drawn, at rest out of view, still without WebGL2."""

import io
import json
import os
import subprocess
import tarfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page, expect

from support.browser.lanes import Lane, complaints_of
from support.browser.proxy import proxied, site
from support.browser.visits import Held
from support.command import free_port

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "webclient" / "element"
NODE = str(ROOT / "scripts" / "node.sh")
HTML = """<!doctype html><html lang="en"><head><title>A page</title><link rel="icon" href="data:," />
<script type="module" src="/package/{module}"></script>
<style>body {{ margin: 0 }} seafoam-water {{ width: 320px; height: 180px }} .far {{ height: 3000px }}</style></head>
<body><seafoam-water {attributes}></seafoam-water><div class="far"></div></body></html>"""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package, packed and unpacked."""
    folder = tmp_path_factory.mktemp("package")
    environment = {**os.environ, "npm_config_cache": str(folder / "cache"), "npm_config_offline": "true"}
    command = [NODE, "npm", "pack", "--silent", "--pack-destination", str(folder), str(FOLDER)]
    subprocess.run(command, check=True, timeout=60, env=environment, cwd=folder)
    (archive,) = folder.glob("*.tgz")
    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter="data")
    return folder / "package"


@contextmanager
def opened(
    lane: Lane, server: str, package: Path, attributes: str, script: str = ""
) -> Iterator[tuple[Page, list[str]]]:
    """A foreign page with the element."""
    exports = json.loads((package / "package.json").read_text())["exports"]["."]
    assert (package / exports["types"]).is_file()
    module = exports["default"].removeprefix("./")
    context = lane.browser.new_context(viewport={"width": 400, "height": 300})
    page = context.new_page()
    complaints = complaints_of(page)
    html = HTML.format(module=module, attributes=attributes)
    page.route("**/a-page/", lambda route: route.fulfill(body=html, content_type="text/html"))
    page.route("**/package/**", lambda route: route.fulfill(path=package / route.request.url.split("/package/")[1]))
    if script:
        page.add_init_script(script)
    try:
        page.goto(f"{server}/a-page/")
        yield page, complaints
    finally:
        context.close()


def shown(page: Page) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(page.locator("seafoam-water").screenshot())).convert("RGB"))


def frames(page: Page) -> int:
    count: int = page.evaluate("() => document.querySelector('seafoam-water').frames")
    return count


def test_the_package_has_what_it_names(package: Path) -> None:
    files = {str(path.relative_to(package)) for path in package.rglob("*") if path.is_file()}
    snippets = {f"snippets/{path.name}" for path in (ROOT / "docs/snippets").iterdir()}
    assert files == {"package.json", "README.md", "index.d.ts", "dist/seafoam-water.js", "dist/LICENSE"} | snippets
    for name in snippets:
        assert (package / name).read_bytes() == (ROOT / "docs" / name).read_bytes()


def test_it_draws_moves_and_rests_out_of_view(llvmpipe: Lane, server: str, package: Path) -> None:
    attributes = 'preset="paper-halftone" time="4" quality="draft" server="/"'
    with opened(llvmpipe, server, package, attributes) as (page, complaints):
        page.wait_for_function("() => document.querySelector('seafoam-water').frames > 3", timeout=60_000)
        assert shown(page).std() > 5.0
        assert page.evaluate("() => document.querySelector('seafoam-water').currentTime") > 4.0
        globals_before = page.evaluate("() => Object.keys(window).filter((name) => /seafoam/i.test(name))")
        assert globals_before == []
        page.evaluate("() => window.scrollTo(0, 2500)")
        # The observer tells in a later frame; after it nothing is drawn.
        page.wait_for_timeout(500)
        resting = frames(page)
        page.wait_for_timeout(700)
        assert frames(page) == resting
        page.evaluate("() => window.scrollTo(0, 0)")
        page.wait_for_function("(count) => document.querySelector('seafoam-water').frames > count", arg=resting)
        assert complaints == []


def test_attributes_take_effect(llvmpipe: Lane, server: str, package: Path) -> None:
    attributes = 'preset="paper-halftone" time="4" quality="draft" server="/" paused'
    with opened(llvmpipe, server, package, attributes) as (page, complaints):
        page.wait_for_function("() => document.querySelector('seafoam-water').frames > 0", timeout=60_000)
        assert page.evaluate("() => document.querySelector('seafoam-water').currentTime") == 4.0
        page.evaluate(
            "() => new Promise((done) => { const water = document.querySelector('seafoam-water');"
            " water.addEventListener('load', done, { once: true });"
            " water.setAttribute('preset', 'paper-height'); water.setAttribute('time', '7'); })"
        )
        assert page.evaluate("() => document.querySelector('seafoam-water').currentTime") == 7.0
        page.evaluate("() => document.querySelector('seafoam-water').remove()")
        page.wait_for_timeout(300)
        assert complaints == []


def test_without_webgl_it_shows_the_servers_picture(llvmpipe: Lane, server: str, package: Path) -> None:
    attributes = 'preset="paper-halftone" time="4" quality="draft" server="/"'
    script = "HTMLCanvasElement.prototype.getContext = () => null"
    with opened(llvmpipe, server, package, attributes, script) as (page, complaints):
        page.wait_for_function(
            "() => document.querySelector('seafoam-water')?.shadowRoot?.querySelector('img[src*=\"/api/\"]')?.complete",
            timeout=60_000,
        )
        query = "time=4&quality=draft&width=320&height=180"
        answer = page.request.get(f"{server}/api/frames/paper-halftone.png?{query}")
        served = np.asarray(Image.open(io.BytesIO(answer.body())).convert("RGB"))
        page.wait_for_timeout(200)
        assert (shown(page) == served).all()
        assert complaints == []


def test_an_unknown_preset_is_an_error_event(llvmpipe: Lane, server: str, package: Path) -> None:
    with opened(llvmpipe, server, package, 'server="/" preset="paper-halftone" paused') as (page, _):
        message = page.evaluate(
            "() => new Promise((done) => { const water = document.querySelector('seafoam-water');"
            " water.addEventListener('error', (event) => done(event.message), { once: true });"
            " water.setAttribute('preset', 'atlantis'); })"
        )
        assert "atlantis" in message


@contextmanager
def elsewhere(
    lane: Lane, package: Path, attributes: str, before: Callable[[Page], None] = lambda page: None
) -> Iterator[tuple[Page, list[str], str]]:
    """A page of another site, its complaints and its origin. before: what is done with it before it loads."""
    html = HTML.format(module="dist/seafoam-water.js", attributes=attributes)
    (package.parent / "page.html").write_text(html)
    with site(package.parent) as origin:
        page = lane.browser.new_page(viewport={"width": 400, "height": 300})
        complaints: list[str] = []
        page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        before(page)
        try:
            page.goto(f"{origin}/page.html")
            yield page, complaints, origin
        finally:
            # Left open after a failure it would draw on beside all other tests.
            page.close()


def test_another_sites_page_shows_the_still_and_then_the_water(llvmpipe: Lane, server: str, package: Path) -> None:
    attributes = f'preset="paper-halftone" quality="draft" server="{server}"'
    held: list[Held] = []
    with elsewhere(llvmpipe, package, attributes, lambda page: held.append(Held(page, "**/api/plans/*"))) as (
        page,
        complaints,
        _,
    ):
        expect(page.locator("seafoam-water img")).to_have_attribute("src", f"{server}/stills/paper-halftone.avif")
        held[0].arrived()
        held[0].let_go()
        page.wait_for_function("() => document.querySelector('seafoam-water').frames > 3", timeout=60_000)
        assert page.locator("seafoam-water img").count() == 0
        assert shown(page).std() > 5.0
        assert complaints == []


def test_a_server_that_does_not_allow_the_page_is_told_from_one_that_is_gone(
    llvmpipe: Lane, server: str, package: Path
) -> None:
    with proxied(server, "/water", frozenset({"access-control-allow-origin"})) as closed:
        attributes = f'preset="paper-halftone" server="{closed}"'
        with elsewhere(llvmpipe, package, attributes) as (page, _, origin):
            expect(page.locator("seafoam-water [role=alert]")).to_contain_text(f"SEAFOAM_CORS_ORIGINS={origin}")
            page.wait_for_function(
                "() => document.querySelector('seafoam-water').shadowRoot.querySelector('img')?.naturalWidth > 0"
            )
            assert shown(page).std() > 5.0
    with elsewhere(llvmpipe, package, f'server="http://127.0.0.1:{free_port()}"') as (page, _, _):
        expect(page.locator("seafoam-water [role=alert]")).to_have_text("The server does not respond.")
