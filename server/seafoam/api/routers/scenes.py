"""``/api/schema``: the JSON schemas of scene and quality. ``/api/scenes``: scenes checked and completed."""

import json
import re
from typing import Any

from fastapi import APIRouter, Request
from pydantic import Field

from seafoam.api.context import InContext
from seafoam.api.http.openapi import problem_responses
from seafoam.api.http.validation import NoParameters, Strict
from seafoam.described import Described
from seafoam.quality import TIERS, Tier
from seafoam.scene.models import Scene

router = APIRouter(prefix="/api", tags=["presets"])

ROOTS = ("Scene", "Quality")
_REFERENCE = re.compile(r'"#/components/schemas/(\w+)"')


class Schemas(Described):
    """Schemas of what a client edits."""

    tiers: list[Tier] = Field(description="Names of the quality tiers, fastest first")
    components: dict[str, dict[str, Any]]
    """`schemas`: the JSON schemas of Scene, Quality and their parts, as in the OpenAPI document"""


def reduced(document: dict[str, Any]) -> dict[str, Any]:
    """Return the schemas of scene and quality, and of all that they refer to, by name.

    document: OpenAPI document of the application.
    """
    schemas = document["components"]["schemas"]
    found: dict[str, Any] = {}
    names = [name for name in ROOTS if name in schemas]
    while names:
        name = names.pop()
        if name not in found:
            found[name] = schemas[name]
            names += _REFERENCE.findall(json.dumps(schemas[name]))
    return dict(sorted(found.items()))


@router.get("/schema", responses=problem_responses(422))
async def get_schema(_: NoParameters, request: Request) -> Schemas:
    """Get the JSON schemas of scene and quality alone, a third of the OpenAPI document."""
    return Schemas(tiers=list(TIERS), components={"schemas": reduced(request.app.openapi())})


@router.post("/scenes", responses=problem_responses(413, 415, 422, 501, 503))
async def complete_scene(scene: Strict[Scene], context: InContext) -> Scene:
    """Check a scene sent as JSON, and return it with the default of every absent field."""
    await context.compiled(scene, TIERS["standard"])
    return scene
