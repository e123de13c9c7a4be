"""``/api/export``: a scene to take home, as a zip archive that runs without a server."""

from fastapi import APIRouter
from starlette.responses import Response, StreamingResponse

from seafoam.api.bundle import Export, entries, player_files, texture_bytes, zipped
from seafoam.api.context import InContext
from seafoam.api.http.answers import NO_STORE, content, problems
from seafoam.api.http.parameters import ExportRequest, quality_of
from seafoam.api.http.validation import Strict, known_preset
from seafoam.render.service.jobs import FrameJob
from seafoam.scene.presets import load_preset

router = APIRouter(prefix="/api", tags=["export"])

ANY_RENDERER = {"renderer": "WebGL2", "version": "drawn by the browser that opens it"}
_RESPONSES = content(
    "A zip archive; its index.html draws the scene when it is opened from the file system. The same request gives the "
    "same bytes",
    "application/zip",
    headers={"Seafoam-Plan": "SHA-256 of the frame plan"},
)


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
