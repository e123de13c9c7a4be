"""``/api/export``: a scene to take home, as a zip archive that runs without a server.

Pages opened from the file system may not fetch files, so the player's data are classic scripts: plan and recipe as
JSON, textures in base64. No path is made of what a request says: names are numbers and names of the plan, reduced to
lower-case letters, digits and hyphens.
"""

import base64
import json
import re
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fastapi import APIRouter
from starlette.responses import Response, StreamingResponse

from seafoam.api.context import InContext
from seafoam.api.frames.plans import CompiledPlan
from seafoam.api.http.answers import NO_STORE, content, problems
from seafoam.api.http.parameters import ExportRequest, quality_of
from seafoam.api.http.problems import ExportTooLargeError, NotBuiltError
from seafoam.api.http.validation import Strict, known_preset
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.framegraph.plan import FramePlan, Pass, declared_uniforms
from seafoam.render.service.jobs import FrameJob
from seafoam.resources import data_dir
from seafoam.scene import load_preset
from seafoam.textures.store import spec_of, texture

router = APIRouter(prefix="/api", tags=["export"])

TEXTURES_LIMIT = 1 << 26
"""Bytes of all textures of a plan together."""
PLAYER = ("index.html", "README.md", "LICENSE", "player.js")
"""Files of the build that every archive has; the first two are templates."""
EPOCH = (1980, 1, 1, 0, 0, 0)
"""Time of every entry: the earliest that zip can hold."""
LEVEL = 6
_REGULAR_FILE = 0o100644
_GLOBAL = "globalThis.seafoamData ??= { textures: {} };\n"
ANY_RENDERER = {"renderer": "WebGL2", "version": "drawn by the browser that opens it"}
_RESPONSES = content(
    "A zip archive; its index.html draws the scene when it is opened from the file system. The same request gives the "
    "same bytes",
    "application/zip",
    headers={"Seafoam-Plan": "SHA-256 of the frame plan"},
)


@dataclass(frozen=True, slots=True)
class Export:
    """What is taken home: the frame that the page opens with, its plan and its recipe."""

    job: FrameJob
    compiled: CompiledPlan
    recipe: str
    title: str


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


def texture_bytes(plan: FramePlan) -> dict[str, bytes]:
    """Return the bytes of the plan's textures by SHA-256. Raises :class:`ExportTooLargeError`."""
    found: dict[str, bytes] = {}
    for spec in plan.textures.values():
        found[spec.sha256] = texture(spec_of(spec.url)).data
        size = sum(map(len, found.values()))
        if size > TEXTURES_LIMIT:
            raise ExportTooLargeError(
                f"the scene's textures have more than {TEXTURES_LIMIT >> 20} MiB: lower the quality's sizes"
            )
    return found


def entries(export: Export, textures: dict[str, bytes], player: dict[str, bytes]) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every file, in order."""
    scripts = ["data/plan.js", "data/recipe.js"]
    # Textures with the same bytes share a file, of the first one's name.
    names: dict[str, str] = {}
    for name, spec in export.compiled.plan.textures.items():
        names.setdefault(spec.sha256, f"data/texture-{len(names):02d}-{slug(name)}.js")
    html = _filled(player["index.html"], export)
    tags = "".join(f'    <script src="{path}"></script>\n' for path in (*scripts, *names.values()))
    yield "index.html", html.replace("    <!-- data -->\n", tags).encode()
    yield "README.md", _filled(player["README.md"], export).encode()
    for name in (*PLAYER[2:], *sorted(set(player) - set(PLAYER))):
        yield name, player[name]
    yield "data/plan.js", (_GLOBAL + "seafoamData.plan = ").encode() + export.compiled.content + b";\n"
    yield "data/recipe.js", f"{_GLOBAL}seafoamData.recipe = {export.recipe};\n".encode()
    for sha256, path in names.items():
        encoded = base64.b64encode(textures[sha256]).decode()
        yield path, f'{_GLOBAL}seafoamData.textures["{sha256}"] =\n  "{encoded}";\n'.encode()
    for index, (name, program) in enumerate(export.compiled.plan.programs.items()):
        yield f"programs/{index:02d}-{slug(name)}.vert.glsl", program.vertex.text.encode()
        yield f"programs/{index:02d}-{slug(name)}.frag.glsl", program.fragment.text.encode()
    yield "uniforms.json", json.dumps(uniforms(export), indent=1).encode() + b"\n"


def slug(name: str) -> str:
    """Return a name reduced to lower-case letters, digits and single hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-") or "unnamed"


def uniforms(export: Export) -> list[dict[str, Any]]:
    """Return each pass with the uniforms that its program declares: type, count, and float32 values in this frame."""
    return [
        {"pass": one.name, "program": one.program, "target": one.target, "uniforms": _values(export, one, index)}
        for index, one in enumerate(export.compiled.plan.passes)
    ]


def _values(export: Export, one: Pass, index: int) -> dict[str, Any]:
    plan, job = export.compiled.plan, export.job
    width, height = job.width, job.height
    if one.target != "screen":
        width, height = plan.targets[one.target].size.of_picture(width, height)
    state = FrameState(job.time, job.camera, job.width, job.height, width, height, index)
    program = plan.programs[one.program]
    declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
    values = {}
    for name in sorted(name for name, sampler in declared.items() if not sampler):
        uniform = one.uniforms.get(name) or plan.uniforms.get(name)
        if uniform is not None:
            said = [float(value) for value in evaluate(uniform, state)]
            values[name] = {"type": uniform.type, "count": uniform.count, "values": said}
    return values


def _filled(template: bytes, export: Export) -> str:
    """Return a template with the title and the hash of the plan. The title is a preset's, or fixed."""
    return template.decode().replace("{{title}}", export.title).replace("{{plan}}", export.compiled.sha256)


class _Sink(list[bytes]):
    """Keeps what is written until it is taken; cannot seek, so the archive is written from front to back."""

    def write(self, data: bytes) -> int:
        self.append(bytes(data))
        return len(data)

    def flush(self) -> None:
        """Nothing is held back."""

    close = flush

    def take(self) -> bytes:
        content = b"".join(self)
        self.clear()
        return content


def zipped(entries: Iterable[tuple[str, bytes]]) -> Iterator[bytes]:
    """Yield the parts of a zip archive with these entries (path, content) in their order.

    Times, permissions and the system are fixed, so the same entries give the same bytes with the same zlib.
    """
    sink = _Sink()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL) as archive:
        for path, content in entries:
            entry = zipfile.ZipInfo(path, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = _REGULAR_FILE << 16
            archive.writestr(entry, content, compresslevel=LEVEL)
            yield sink.take()
    yield sink.take()


@router.post("/export", responses=_RESPONSES | problems(413, 415, 422, 501, 503), response_class=StreamingResponse)
async def export_scene(body: Strict[ExportRequest], context: InContext) -> Response:
    """Pack a scene sent as JSON with its programs, textures, uniforms and a player."""
    known_preset(body.preset)
    quality = quality_of(body.quality)
    compiled = await context.compiled(body.scene, quality)
    camera = body.camera or body.scene.camera
    job = FrameJob(body.scene, quality, body.time, camera, body.width, body.height, "png", body.preset)
    title = load_preset(body.preset).title if body.preset else "A scene"
    made = Export(job, compiled, job.recipe(ANY_RENDERER, compiled.sha256), title)
    player = player_files()
    # Before the first byte: what fails now is a problem, what fails later only a broken archive.
    textures = await context.masks.run(texture_bytes, compiled.plan)
    name = f"seafoam-{body.preset or 'scene'}.zip"
    headers = {
        "Content-Disposition": f'attachment; filename="{name}"',
        "Cache-Control": NO_STORE,
        "Seafoam-Plan": compiled.sha256,
    }
    return StreamingResponse(zipped(entries(made, textures, player)), headers=headers, media_type="application/zip")
