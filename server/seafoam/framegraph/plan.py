"""FramePlan: everything an executor needs to draw a frame at any time, from any camera, at any size."""

import hashlib
import json

from pydantic import Field

from seafoam.framegraph.passes import Pass
from seafoam.framegraph.resources import Target, Texture
from seafoam.framegraph.rules import PlanPart, Uniform
from seafoam.framegraph.shader import Program

PLAN_VERSION = 1


class EffectNote(PlanPart):
    """An effect, and why it runs or does not."""

    name: str
    why: str
    files: tuple[str, ...] = ()
    bound: float | None = None
    """For a skipped effect: upper bound of its change to any pixel, display white = 1"""


class FramePlan(PlanPart):
    """A compiled scene. The same scene and quality give the same bytes."""

    version: int = PLAN_VERSION
    effects: tuple[EffectNote, ...]
    skipped: tuple[EffectNote, ...]
    programs: dict[str, Program]
    textures: dict[str, Texture]
    targets: dict[str, Target]
    passes: tuple[Pass, ...]
    kept: dict[str, str]
    """Targets of setup passes that other passes read -> SHA-256 of everything that determines their pixels: programs,
    numbers, textures, meshes, states and formats, including those of their inputs. Plans with the same hash can share
    the target as long as no live field changes. All other targets of setup passes are intermediate"""
    uniforms: dict[str, Uniform]
    linear: str = Field(description="Target that holds the finished linear frame: exposed RGB, A = foam coverage")
    samples: int = Field(description="Samples per pixel")
    top: float = Field(description="Upper bound of the crests' height, m: a camera at or above it is above the water")
    trough: float = Field(description="Lower bound of the troughs' height, m: a camera below it is under the water")
    bottom: float = Field(description="Lowest camera height from which more than ground is visible, m")
    live: tuple[str, ...] = Field(description="JSON pointers of scene fields that can change without a new plan")

    def canonical_json(self) -> bytes:
        """The plan's bytes: JSON with sorted keys and no spaces."""
        document = self.model_dump(mode="json")
        return json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.canonical_json()).hexdigest()
