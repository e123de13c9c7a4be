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
    """A file of the assembled text, and the line (from 1) where it starts."""

    path: str
    line: int


class Shader(PlanPart):
    """Assembled GLSL ES 3.00. ``sha256`` is of the UTF-8 text."""

    text: str
    sha256: str
    files: tuple[SourceFile, ...]


class Program(PlanPart):
    """A vertex and a fragment shader."""

    vertex: Shader
    fragment: Shader


class Texture(PlanPart):
    """Texture data: levels from the largest, rows from v = 0, tightly packed little-endian, one after the other."""

    url: str = Field(description="Where the bytes are, below the server's address")
    sha256: str = Field(description="Of the bytes")
    format: Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]
    width: int
    height: int
    levels: int
    filter: Filter
    wrap: WrapMode


Eye = Literal["any", "over", "under"]


class State(PlanPart):
    """Fixed-function state of a pass; everything else is off."""

    depth: bool = False
    clear: bool = Field(default=False, description="Clear the target to (0, 0, 0, 0) and depth to 1 first")
    blend: Blend = Field(
        default="none",
        description="none: replace what the target holds; add: add to it; over: lie over it, alpha premultiplied. "
        "Never into 32-bit floats, which WebGL2 need not blend",
    )


class Pass(PlanPart):
    """One draw call."""

    name: str
    when: Literal["setup", "frame"] = Field(
        description="setup: no rule of time, camera or picture size reaches the pass or what it reads: drawn when its "
        "target is first needed, and again only where a live field among its numbers, or among those of what it reads, "
        "moves; frame: in every frame that needs its target. All passes into one target are of one kind"
    )
    eye: Eye = Field(
        default="any",
        description="over: drawn for eyes at the plan's top or higher; under: for all lower ones, and right for any",
    )
    view: View = Field(
        default="any",
        description="Where it can show something. rising, falling: only where a ray of the picture does, or the eye is "
        "lower than the plan's top; balls: only where one of them is in the picture",
    )
    program: str
    target: str = Field(description="A target of the plan, or 'screen': the RGBA8 picture itself")
    mesh: Mesh
    inputs: dict[str, TextureInput | TargetInput] = Field(
        default_factory=dict, description="Sampler name -> what it reads"
    )
    uniforms: dict[str, Uniform] = Field(
        default_factory=dict, description="Uniforms of this pass alone; they win over the plan's"
    )
    state: State = State()


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
