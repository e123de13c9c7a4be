"""The example of docs/three: plans drawn by three.js, with the same GLSL, beside the server's frames."""

import base64
import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Route

from support.browser.lanes import Lane
from support.browser.proxy import proxied, site
from support.browser.visits import BLANK, differs, pixels_of, visit

ROOT = Path(__file__).parents[3]
WIDTH, HEIGHT = 320, 180
TIME = 9.0
PAGE = """<!doctype html><html><head><script type="importmap">{"imports": {"three": "./three.module.js"}}</script>
<script type="module">
import * as THREE from "three";
import { Water } from "./water.js";
const get = async (path) => (await fetch(path)).json();
window.frame = async (preset, time, width, height) => {
  const plan = await get(`/api/plans/${preset}?quality=fast`);
  const { scene } = await get(`/api/presets/${preset}`);
  const renderer = new THREE.WebGLRenderer({ antialias: false, depth: false, preserveDrawingBuffer: true });
  renderer.setSize(width, height, false);
  const water = await Water.load(renderer, plan, location.origin);
  for (const earlier of [time - 1, time]) water.draw({ time: earlier, camera: scene.camera });
  const gl = renderer.getContext();
  const sources = ({ program }) => gl.getAttachedShaders(program).map((shader) => gl.getShaderSource(shader));
  const held = renderer.info.programs.flatMap(sources);
  const url = renderer.domElement.toDataURL("image/png");
  renderer.dispose();
  return { png: url.split(",")[1], held, plan };
};
</script></head><body></body></html>"""


def answer(route: Route) -> None:
    name = route.request.url.rpartition("/")[2]
    folder = ROOT / ("webclient/node_modules/three/build" if name.startswith("three.") else "docs/three")
    content = PAGE if name == "index.html" else (folder / name).read_text(encoding="utf-8")
    route.fulfill(body=content, content_type="text/html" if name == "index.html" else "text/javascript")


@pytest.mark.parametrize("preset", ["paper-threshold", "paper-halftone", "default"])
def test_three_draws_the_servers_frame(llvmpipe: Lane, server: str, preset: str) -> None:
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        page = made.page
        page.route("**/three-example/*", answer)
        page.goto(f"{server}/three-example/index.html")
        page.wait_for_function("() => window.frame !== undefined")
        made.complaints.clear()
        drawn = page.evaluate(
            "async ([preset, time, width, height]) => {"
            " const { png, held, plan } = await window.frame(preset, time, width, height);"
            " const stages = Object.values(plan.programs).flatMap(({ vertex, fragment }) => [vertex, fragment]);"
            " const bare = stages.map(({ text }) => text.replace('#version 300 es\\n', ''));"
            " const same = held.every((text) => bare.some((one) => text.endsWith(one)));"
            " return { png, same, count: held.length }; }",
            [preset, TIME, WIDTH, HEIGHT],
        )
        query = f"quality=fast&dither=false&time={TIME:g}&width={WIDTH}&height={HEIGHT}"
        reply = page.request.get(f"{server}/api/frames/{preset}.png?{query}")
        assert drawn["count"] >= 6
        assert drawn["same"], "three.js holds other GLSL than the plan's"
        ours, truth = (pixels_of(data) for data in (base64.b64decode(drawn["png"]), reply.body()))
        assert truth.std() > 5.0
        assert differs(ours, truth) < 1e-4


def test_the_page_takes_a_server_of_another_site(llvmpipe: Lane, server: str, tmp_path: Path) -> None:
    folder = shutil.copytree(ROOT / "docs" / "three", tmp_path / "three-example")
    (folder / "three").symlink_to(ROOT / "webclient" / "node_modules" / "three")
    with proxied(server, "/water") as behind, site(folder) as origin:
        page = llvmpipe.browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        complaints: list[str] = []
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.goto(f"{origin}/index.html?server={behind}/#paper-halftone")
        page.wait_for_function("() => document.querySelector('canvas') !== null", timeout=60_000)
        for _ in range(60):
            if pixels_of(page.screenshot()).std() > 5.0:
                break
            page.wait_for_timeout(500)
        else:
            raise AssertionError(f"no water: {complaints}")
        page.close()
