"""FramePlan: everything an executor needs to draw a frame at any time, from any camera, at any size."""

import hashlib
from typing import Literal

from pydantic import Field

from seafoam.effects.contribution import (
    Blend,
    Filter,
    Mesh,
    PlanPart,
    Target,
    TargetInput,
    TextureInput,
    Uniform,
    View,
    WrapMode,
)

PLAN_VERSION = 1


class SourceFile(PlanPart):
    """A file of the assembled source, and the line (from 1) at which it starts."""

    path: str
    line: int


class Shader(PlanPart):
    """Assembled GLSL ES 3.00 source. ``sha256``: of the UTF-8 text."""

    text: str
    sha256: str
    files: tuple[SourceFile, ...]


class Program(PlanPart):
    """A vertex and a fragment shader."""

    vertex: Shader
    fragment: Shader


class Texture(PlanPart):
    """Texture data: mip levels, largest first, concatenated; rows from v = 0, tightly packed, little-endian."""

    url: str = Field(description="Path of the bytes, relative to the server's address")
    sha256: str = Field(description="SHA-256 of the bytes")
    format: Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]
    width: int
    height: int
    levels: int
    filter: Filter
    wrap: WrapMode


Eye = Literal["any", "over", "under"]


class State(PlanPart):
    """Fixed-function state of a pass; everything else is disabled."""

    depth: bool = False
    clear: bool = Field(default=False, description="Clear the target to (0, 0, 0, 0) and depth to 1 first")
    blend: Blend = Field(
        default="none",
        description="Blending. none: replace the target's content; add: add to it; over: blend over it, with "
        "premultiplied alpha. Never used with 32-bit float targets, whose blending WebGL2 does "
        "not guarantee",
    )


class Pass(PlanPart):
    """One draw call."""

    name: str
    when: Literal["setup", "frame"] = Field(
        description="When the pass is drawn. setup: neither time, camera nor picture size affects the pass or "
        "what it reads; it is drawn when its target is first needed, and again only if a live "
        "field among its uniforms, or those of what it reads, changes. frame: in every frame that "
        "needs its target. All passes into one target have the same value"
    )
    eye: Eye = Field(
        default="any",
        description="Camera height for which the pass is drawn. over: at the plan's top or higher; under: "
        "below it, and correct at any height",
    )
    view: View = Field(
        default="any",
        description="Where the pass can be visible, for culling. rising, falling: only if some ray of the "
        "picture rises or falls, or the camera is below the plan's top; balls: only if one of "
        "these bounding spheres is in the picture",
    )
    program: str
    target: str = Field(description="Name of a target of the plan, or 'screen': the RGBA8 picture itself")
    mesh: Mesh
    inputs: dict[str, TextureInput | TargetInput] = Field(
        default_factory=dict, description="Sampler name -> source of its data"
    )
    uniforms: dict[str, Uniform] = Field(
        default_factory=dict, description="Uniforms of this pass only; they override the plan's"
    )
    state: State = State()


class EffectNote(PlanPart):
    """An effect, and why it runs or does not."""

    name: str
    why: str
    files: tuple[str, ...] = ()
    bound: float | None = Field(
        default=None, description="For a skipped effect: upper bound of its change to any pixel, display white = 1"
    )


class FramePlan(PlanPart):
    """A compiled scene. The same scene and quality give the same bytes."""

    version: int = PLAN_VERSION
    effects: tuple[EffectNote, ...]
    skipped: tuple[EffectNote, ...]
    programs: dict[str, Program]
    textures: dict[str, Texture]
    targets: dict[str, Target]
    passes: tuple[Pass, ...]
    kept: dict[str, str] = Field(
        description="Targets of setup passes that other passes read -> SHA-256 of everything that determines "
        "their pixels: programs, numbers, textures, meshes, states and formats, including those "
        "of their inputs. Plans with the same hash can share the target as long as no live field "
        "changes. All other targets of setup passes are intermediate"
    )
    uniforms: dict[str, Uniform]
    linear: str = Field(description="Target that holds the finished linear frame: exposed RGB, A = foam coverage")
    samples: int = Field(description="Samples per pixel")
    top: float = Field(description="Upper bound of the crests' height, m: a camera at or above it is above the water")
    bottom: float = Field(description="Lowest camera height from which more than ground is visible, m")
    live: tuple[str, ...] = Field(description="JSON pointers of scene fields that can change without a new plan")

    def canonical_json(self) -> bytes:
        """The plan's bytes: JSON with sorted keys and no spaces."""
        return _canonical(self)

    @property
    def sha256(self) -> str:
        """SHA-256 of the plan's bytes."""
        return hashlib.sha256(self.canonical_json()).hexdigest()


def _canonical(plan: FramePlan) -> bytes:
    import json

    return json.dumps(plan.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
