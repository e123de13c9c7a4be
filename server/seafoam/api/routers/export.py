"""``/api/export``: a scene to take home, as a zip archive that runs without a server.

Pages opened from the file system may not fetch files, so the player's data are classic scripts: plan and recipe as
JSON, textures in base64. No path is made of what a request says: names are numbers and names of the plan, reduced to
lower-case letters, digits and hyphens.
"""

import base64
import io
import json
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from fastapi import APIRouter
from starlette.responses import Response

from seafoam.api.context import InContext
from seafoam.api.frames.plans import CompiledPlan
from seafoam.api.http import answers
from seafoam.api.http.parameters import ViewRequest, quality_of
from seafoam.api.http.problems import NotBuiltError
from seafoam.api.http.validation import Strict, known_preset
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.framegraph.plan import FramePlan, Pass, uniforms_of
from seafoam.render.service.jobs import FrameJob
from seafoam.resources import data_dir
from seafoam.scene import load_preset
from seafoam.textures.store import spec_of, texture

router = APIRouter(prefix="/api", tags=["export"])

PLAYER = ("index.html", "README.md", "LICENSE", "player.js")
"""Files of the build that every archive has; the first two are templates."""
EPOCH = (1980, 1, 1, 0, 0, 0)
"""Time of every entry: the earliest that zip can hold."""
LEVEL = 6
_REGULAR_FILE = 0o100644
_GLOBAL = "globalThis.seafoamData ??= { textures: {} };\n"
ANY_RENDERER = {"renderer": "WebGL2", "version": "drawn by the browser that opens it"}
_RESPONSES = answers.content(
    "A zip archive; its index.html draws the scene when it is opened from the file system. The same request gives the "
    "same bytes",
    "application/zip",
    headers={"Seafoam-Plan": "SHA-256 of the frame plan"},
)


def player_files() -> dict[str, bytes]:
    """Return the player's files and the shader snippets by path, from the built web client.

    Raises :class:`NotBuiltError`.
    """
    folder = data_dir("webclient") / "export"
    snippets = (f"snippets/{path.name}" for path in sorted((folder / "snippets").glob("*")))
    try:
        return {name: (folder / name).read_bytes() for name in (*PLAYER, *snippets)}
    except FileNotFoundError as error:
        raise NotBuiltError(f"the player is not built: {Path(error.filename).name} is missing") from None


def entries(job: FrameJob, compiled: CompiledPlan, player: dict[str, bytes]) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every file, in order. job: the frame that the page opens with."""
    title = load_preset(job.preset).title if job.preset else "A scene"
    html, readme = (
        player[name].decode().replace("{{title}}", title).replace("{{plan}}", compiled.sha256) for name in PLAYER[:2]
    )
    scripts = ["data/plan.js", "data/recipe.js"]
    # Textures with the same bytes share a file, of the first one's name.
    textures: dict[str, tuple[str, str]] = {}
    for name, spec in compiled.plan.textures.items():
        textures.setdefault(spec.sha256, (f"data/texture-{len(textures):02d}-{slug(name)}.js", spec.url))
    tags = "".join(f'    <script src="{path}"></script>\n' for path in (*scripts, *dict(textures.values())))
    yield "index.html", html.replace("    <!-- data -->\n", tags).encode()
    yield "README.md", readme.encode()
    for name in (*PLAYER[2:], *sorted(set(player) - set(PLAYER))):
        yield name, player[name]
    yield "data/plan.js", (_GLOBAL + "seafoamData.plan = ").encode() + compiled.content + b";\n"
    recipe = job.recipe(ANY_RENDERER, compiled.sha256)
    yield "data/recipe.js", f"{_GLOBAL}seafoamData.recipe = {recipe};\n".encode()
    for sha256, (path, url) in textures.items():
        encoded = base64.b64encode(texture(spec_of(url)).data).decode()
        yield path, f'{_GLOBAL}seafoamData.textures["{sha256}"] =\n  "{encoded}";\n'.encode()
    for index, (name, program) in enumerate(compiled.plan.programs.items()):
        yield f"programs/{index:02d}-{slug(name)}.vert.glsl", program.vertex.text.encode()
        yield f"programs/{index:02d}-{slug(name)}.frag.glsl", program.fragment.text.encode()
    yield "uniforms.json", json.dumps(uniforms(job, compiled.plan), indent=1).encode() + b"\n"


def slug(name: str) -> str:
    """Return a name reduced to lower-case letters, digits and single hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-") or "unnamed"


def uniforms(job: FrameJob, plan: FramePlan) -> list[dict[str, Any]]:
    """Return each pass with the uniforms that its program declares: type, count, and float32 values in this frame."""
    return [
        {"pass": one.name, "program": one.program, "target": one.target, "uniforms": _values(job, plan, one)}
        for one in plan.passes
    ]


def _values(job: FrameJob, plan: FramePlan, one: Pass) -> dict[str, Any]:
    width, height = job.width, job.height
    if one.target != "screen":
        width, height = plan.targets[one.target].size.of_picture(width, height)
    state = FrameState(job.time, job.camera, job.width, job.height, width, height)
    used = sorted(uniforms_of(one, plan.programs[one.program], plan.uniforms).items())
    return {
        name: {"type": uniform.type, "count": uniform.count, "values": evaluate(uniform, state).tolist()}
        for name, uniform in used
    }


def zipped(job: FrameJob, compiled: CompiledPlan, player: dict[str, bytes]) -> bytes:
    """Return the archive.

    Times, permissions and the system are fixed, so the same files give the same bytes with the same zlib.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for path, content in entries(job, compiled, player):
            entry = zipfile.ZipInfo(path, EPOCH)
            entry.create_system = 3
            entry.external_attr = _REGULAR_FILE << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED, LEVEL)
    return buffer.getvalue()


@router.post("/export", responses=_RESPONSES | answers.problems(413, 415, 422, 501, 503), response_class=Response)
async def export_scene(body: Strict[ViewRequest], context: InContext) -> Response:
    """Pack a scene sent as JSON with its programs, textures, uniforms and a player."""
    known_preset(body.preset)
    quality = quality_of(body.quality)
    compiled = await context.compiled(body.scene, quality)
    camera = body.camera or body.scene.camera
    job = FrameJob(body.scene, quality, body.time, camera, body.width, body.height, "png", body.preset)
    content = await context.masks.run(zipped, job, compiled, player_files())
    name = f"seafoam-{body.preset or 'scene'}.zip"
    headers = {
        "Content-Disposition": f'attachment; filename="{name}"',
        "Cache-Control": answers.NO_STORE,
        "Seafoam-Plan": compiled.sha256,
    }
    return Response(content, headers=headers, media_type="application/zip")
