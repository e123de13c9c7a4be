"""Water in foreign pages: the element's package, packed by npm, and the example of docs/three."""

import base64
import json
import os
import shutil
import subprocess
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from support.browser.lanes import Lane, complaints_of
from support.browser.proxy import proxied, site
from support.browser.visits import BLANK, Held, Pixels, Visit, differs, pixels_of, visit
from support.command import free_port

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "webclient" / "element"
NODE = str(ROOT / "scripts" / "node.sh")
HTML = """<!doctype html><html lang="en"><head><title>A page</title><link rel="icon" href="data:," />
<script type="module" src="/package/dist/seafoam-water.js"></script>
<style>body {{ margin: 0 }} seafoam-water {{ width: 320px; height: 180px }} .far {{ height: 3000px }}</style></head>
<body>{waters}<div class="far"></div></body></html>"""
WATER = '<seafoam-water preset="paper-halftone" time="4" quality="fast" server="{server}"></seafoam-water>'
SIZE = (400, 300)


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
def opened(lane: Lane, package: Path, *servers: str, script: str = "") -> Iterator[tuple[Visit, str, Held]]:
    """A page of another site with an element for each server, its origin, and requests for plans, which are held."""
    waters = "".join(WATER.format(server=server) for server in servers)
    (package.parent / "index.html").write_text(HTML.format(waters=waters))
    with site(package.parent) as origin, visit(lane, origin, BLANK, size=SIZE, settle=False) as made:
        held = Held(made.page, "**/api/plans/*")
        made.page.add_init_script(script)
        made.page.goto(f"{origin}/index.html")
        yield made, origin, held


def shown(made: Visit) -> Pixels:
    return pixels_of(made.page.locator("seafoam-water").first.screenshot())


def water(made: Visit, code: str) -> Any:
    """The value of an expression of ``water``, the element."""
    return made.page.evaluate(f"() => {{ const water = document.querySelector('seafoam-water'); return {code}; }}")


def drew(made: Visit, more_than: int = 3) -> None:
    """Wait until the element has drawn more frames than that."""
    condition = "(count) => document.querySelector('seafoam-water').frames > count"
    made.page.wait_for_function(condition, arg=more_than, timeout=60_000)


def test_the_package_has_what_it_names(package: Path) -> None:
    files = {str(path.relative_to(package)) for path in package.rglob("*") if path.is_file()}
    snippets = {f"snippets/{path.name}" for path in (ROOT / "docs/snippets").iterdir()}
    assert files == {"package.json", "README.md", "index.d.ts", "dist/seafoam-water.js", "dist/LICENSE"} | snippets
    for name in snippets:
        assert (package / name).read_bytes() == (ROOT / "docs" / name).read_bytes()
    exports = json.loads((package / "package.json").read_text())["exports"]["."]
    assert exports == {"types": "./index.d.ts", "default": "./dist/seafoam-water.js"}


def test_another_sites_page_shows_the_still_and_then_water_that_moves_rests_and_takes_attributes(
    llvmpipe: Lane, server: str, package: Path
) -> None:
    with opened(llvmpipe, package, server) as (made, _, held):
        still = made.page.locator("seafoam-water img")
        expect(still).to_have_attribute("src", f"{server}/stills/paper-halftone.avif")
        held.arrived()
        held.let_go()
        drew(made)
        assert still.count() == 0
        assert shown(made).std() > 5.0
        assert water(made, "water.currentTime") > 4.0
        assert made.page.evaluate("() => Object.keys(window).filter((name) => /seafoam/i.test(name))") == []
        made.page.evaluate("() => window.scrollTo(0, 2500)")
        # The observer tells in a later frame; after it nothing is drawn.
        made.page.wait_for_timeout(500)
        resting = water(made, "water.frames")
        made.page.wait_for_timeout(700)
        assert water(made, "water.frames") == resting
        made.page.evaluate("() => window.scrollTo(0, 0)")
        drew(made, resting)
        water(
            made,
            "new Promise((done) => { water.addEventListener('load', done, { once: true });"
            " water.setAttribute('paused', ''); water.setAttribute('preset', 'paper-height');"
            " water.setAttribute('time', '7'); })",
        )
        assert water(made, "water.currentTime") == 7.0
        assert made.complaints == []
        message = water(
            made,
            "new Promise((done) => { water.addEventListener('error', ({ message }) => done(message), { once: true });"
            " water.setAttribute('preset', 'atlantis'); })",
        )
        assert "atlantis" in message
        # Chromium may tell of it later than the element.
        made.expected = "404"
        water(made, "water.remove()")
        made.page.wait_for_timeout(300)


def test_without_webgl_it_shows_the_servers_picture_and_says_what_is_refused_and_what_is_gone(
    llvmpipe: Lane, server: str, package: Path
) -> None:
    script = "HTMLCanvasElement.prototype.getContext = () => null"
    with (
        proxied(server, "/water", frozenset({"access-control-allow-origin"})) as closed,
        opened(llvmpipe, package, server, closed, f"http://127.0.0.1:{free_port()}", script=script) as (made, _, held),
    ):
        held.let_go()
        refused, gone = (made.page.locator("seafoam-water").nth(i) for i in (1, 2))
        expect(refused.get_by_role("alert")).to_contain_text("SEAFOAM_CORS_ORIGINS=http://127.0.0.1:")
        expect(gone.get_by_role("alert")).to_have_text("The server does not respond.")
        made.page.wait_for_function(
            "() => document.querySelector('seafoam-water')?.shadowRoot?.querySelector('img[src*=\"/api/\"]')?.complete",
            timeout=60_000,
        )
        query = "time=4&quality=fast&width=320&height=180"
        answer = made.page.request.get(f"{server}/api/frames/paper-halftone.png?{query}")
        made.page.wait_for_timeout(200)
        assert (shown(made) == pixels_of(answer.body())).all()
        # The browser itself notes both.
        made.complaints.clear()


WIDTH, HEIGHT = 320, 180
TIME = 9.0
FRAME = """async ([preset, time, width, height, server]) => {
  const load = (path) => import(new URL(path, location.href));
  const [THREE, { Water }] = [await load("three/build/three.module.js"), await load("water.js")];
  const get = async (path) => (await fetch(`${server}/api/${path}`)).json();
  const plan = await get(`plans/${preset}?quality=fast`);
  const { scene } = await get(`presets/${preset}`);
  const renderer = new THREE.WebGLRenderer({ antialias: false, depth: false, preserveDrawingBuffer: true });
  renderer.setSize(width, height, false);
  const water = await Water.load(renderer, plan, `${server}/`);
  for (const earlier of [time - 1, time]) water.draw({ time: earlier, camera: scene.camera });
  const gl = renderer.getContext();
  const held = renderer.info.programs.flatMap(({ program }) =>
    gl.getAttachedShaders(program).map((shader) => gl.getShaderSource(shader)));
  const stages = Object.values(plan.programs).flatMap(({ vertex, fragment }) => [vertex, fragment]);
  const bare = stages.map(({ text }) => text.replace("#version 300 es\\n", ""));
  const same = held.every((text) => bare.some((one) => text.endsWith(one)));
  const png = renderer.domElement.toDataURL("image/png").split(",")[1];
  renderer.dispose();
  return { png, same, count: held.length };
}"""


def test_three_draws_the_frames_of_a_server_of_another_site(llvmpipe: Lane, server: str, tmp_path: Path) -> None:
    folder = shutil.copytree(ROOT / "docs" / "three", tmp_path / "three-example")
    (folder / "three").symlink_to(ROOT / "webclient" / "node_modules" / "three")
    (folder / "favicon.ico").touch()
    with proxied(server, "/water") as behind, site(folder) as origin:
        page = llvmpipe.browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        complaints = complaints_of(page)
        page.goto(f"{origin}/index.html?server={behind}/#paper-halftone")
        page.wait_for_function("() => document.querySelector('canvas') !== null", timeout=60_000)
        for _ in range(60):
            if pixels_of(page.screenshot()).std() > 5.0:
                break
            page.wait_for_timeout(500)
        else:
            raise AssertionError(f"no water: {complaints}")
        for preset in ("paper-halftone", "default"):
            drawn = page.evaluate(FRAME, [preset, TIME, WIDTH, HEIGHT, behind])
            query = f"quality=fast&dither=false&time={TIME:g}&width={WIDTH}&height={HEIGHT}"
            reply = page.request.get(f"{server}/api/frames/{preset}.png?{query}")
            assert drawn["count"] >= 6, preset
            assert drawn["same"], f"{preset}: three.js holds other GLSL than the plan's"
            ours, truth = (pixels_of(data) for data in (base64.b64decode(drawn["png"]), reply.body()))
            assert truth.std() > 5.0
            assert differs(ours, truth) < 1e-4, preset
        assert complaints == []
        page.close()
