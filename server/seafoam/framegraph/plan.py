"""FramePlan: everything an executor needs to draw a frame at any time, from any camera, at any size."""

import hashlib

from pydantic import Field

from seafoam.framegraph.passes import Pass
from seafoam.framegraph.resources import Target, Texture
from seafoam.framegraph.rules import PlanPart, Uniform
from seafoam.framegraph.shader import Program

PLAN_VERSION = 1


class EffectNote(PlanPart):
    """Why an effect runs, or why it does not."""

    name: str
    why: str
    files: tuple[str, ...] = ()
    bound: float | None = Field(
        default=None, description="Of a skipped effect: the most it could change in a pixel, display white = 1"
    )


class FramePlan(PlanPart):
    """A compiled scene. Same scene and quality, same bytes."""

    version: int = PLAN_VERSION
    effects: tuple[EffectNote, ...]
    skipped: tuple[EffectNote, ...]
    programs: dict[str, Program]
    textures: dict[str, Texture]
    targets: dict[str, Target]
    passes: tuple[Pass, ...]
    kept: dict[str, str] = Field(
        description="Targets of setup passes that other passes read -> SHA-256 of all that their pixels hang on: "
        "programs, numbers, textures, meshes, states and formats, those of what is read included. Plans with the same "
        "may share the target, as long as no live field moves. All other targets of setup passes are only on the way"
    )
    uniforms: dict[str, Uniform]
    linear: str = Field(description="The target that holds the finished linear frame: exposed RGB, A = foam coverage")
    samples: int = Field(description="Samples a pixel")
    top: float = Field(description="The highest that a crest can reach, m: an eye as high is over the water")
    bottom: float = Field(description="The lowest from where an eye sees more than ground, m")
    live: tuple[str, ...] = Field(description="JSON pointers of scene fields that may change without a new plan")

    def canonical_json(self) -> bytes:
        """The plan's bytes: JSON with sorted keys and no spaces."""
        return _canonical(self)

    @property
    def sha256(self) -> str:
        """The plan's identity."""
        return hashlib.sha256(self.canonical_json()).hexdigest()


def _canonical(plan: FramePlan) -> bytes:
    import json

    return json.dumps(plan.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
