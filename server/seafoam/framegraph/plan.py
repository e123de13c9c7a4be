"""FramePlan: everything an executor needs to draw a frame at any time, from any camera, at any size.

Shaders, and passes: what is drawn, how, and where it can be visible.
"""

import hashlib
import json
import re
from collections.abc import Mapping
from functools import cached_property, lru_cache
from typing import Annotated, Literal

from pydantic import Field

from seafoam.framegraph.resources import Target, TargetInput, Texture, TextureInput
from seafoam.framegraph.rules import PlanPart, Uniform


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


_UNIFORM = re.compile(r"^uniform\s+(?P<type>\w+)\s+(?P<name>\w+)", re.MULTILINE)
_SAMPLERS = ("sampler2D", "usampler2D", "sampler2DArray")


@lru_cache(maxsize=1024)
def _declared(text: str) -> tuple[tuple[str, bool], ...]:
    return tuple((match["name"], match["type"] in _SAMPLERS) for match in _UNIFORM.finditer(text))


def declared_uniforms(shader: Shader) -> dict[str, bool]:
    """Return the uniforms that the source declares, and whether each is a sampler."""
    return dict(_declared(shader.text))


class Fullscreen(PlanPart):
    """A triangle that covers the target; without attributes, from gl_VertexID."""

    rule: Literal["fullscreen"] = "fullscreen"


class Grid(PlanPart):
    """rows × columns cells, two triangles each; attribute ``a_grid`` (vec2) covers [0, 1]², columns first."""

    rule: Literal["grid"] = "grid"
    rows: int = Field(ge=1)
    columns: int = Field(ge=1)


class Points(PlanPart):
    """``count`` points without attributes; gl_VertexID is the index, gl_PointSize the side in pixels."""

    rule: Literal["points"] = "points"
    count: int = Field(ge=1, le=1 << 20)


class Quads(PlanPart):
    """``count`` quadrilaterals of two triangles each, without attributes; gl_VertexID is 6 times the index and more."""

    rule: Literal["quads"] = "quads"
    count: int = Field(ge=1, le=1 << 20)


Mesh = Annotated[Fullscreen | Grid | Points | Quads, Field(discriminator="rule")]
Blend = Literal["none", "add", "over"]
"""Blending of a pass: replaces the target's content, adds to it, or blends over it with premultiplied alpha."""


class BoundingSphere(PlanPart):
    """A bounding sphere of everything that a pass draws, at any time: ``centre`` (x, y, z) and ``radius``, m."""

    centre: tuple[float, float, float]
    radius: float


View = Literal["any", "rising", "falling"] | tuple[BoundingSphere, ...]
"""Where a pass can be visible: anywhere; where a ray of the picture rises, or falls, or for both where crests can be
above the camera; or in one of these bounding spheres."""
Eye = Literal["over", "between", "under"]
"""Height of the camera: over all crests, between the highest crest and the deepest trough, under all troughs."""
Eyes = Literal["any"] | tuple[Eye, ...]


class State(PlanPart):
    """Fixed-function state of a pass; everything else is disabled."""

    depth: bool = Field(default=False, description="Draw only before what is drawn already, and write the depth")
    equal: bool = False
    """With depth: draw only where the depth is the pass's own, not before it"""
    clear: bool = Field(default=False, description="Clear the target to (0, 0, 0, 0) and depth to 1 first")
    blend: Blend = "none"
    """Blending. none: replace the target's content; add: add to it; over: blend over it, with premultiplied alpha.
    Never used with 32-bit float targets, whose blending WebGL2 does not guarantee"""


class Pass(PlanPart):
    """One draw call."""

    name: str
    when: Literal["setup", "frame"]
    """When the pass is drawn. setup: neither camera nor picture size affects the pass or what it reads, and time only
    by rules with a step; it is drawn when its target is first needed, and again only if a number of these rules, or a
    live field, among its uniforms or those of what it reads changes. frame: in every frame that needs its target. All
    passes into one target have the same value"""
    eye: Eyes = "any"
    """Camera heights for which the pass is drawn. over: at the plan's top or higher; under: below its trough; between:
    neither. Passes for two of them draw nothing from the other side of the water"""
    view: View = "any"
    """Where the pass can be visible, for culling. rising, falling: only if some ray of the picture rises or falls, or
    the camera is below the plan's top; spheres: only if one of these bounding spheres is in the picture"""
    program: str
    target: str = Field(description="Name of a target of the plan, or 'screen': the RGBA8 picture itself")
    mesh: Mesh
    inputs: dict[str, TextureInput | TargetInput] = Field(default_factory=dict)
    """Sampler name -> source of its data"""
    uniforms: dict[str, Uniform] = Field(default_factory=dict)
    """Uniforms of this pass only; they override the plan's"""
    state: State = State()


def uniforms_of(drawn: Pass, program: Program, uniforms: Mapping[str, Uniform]) -> dict[str, Uniform]:
    """Return the uniforms that a pass's program declares, its own or the plan's."""
    declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
    return {name: drawn.uniforms.get(name) or uniforms[name] for name, sampler in declared.items() if not sampler}


class EffectNote(PlanPart):
    """An effect, and why it runs or does not."""

    name: str
    why: str
    files: tuple[str, ...] = ()
    bound: float | None = None
    """For a skipped effect: upper bound of its change to any pixel, display white = 1"""


class FramePlan(PlanPart):
    """A compiled scene. The same scene and quality give the same bytes."""

    version: int = 1
    effects: tuple[EffectNote, ...]
    skipped: tuple[EffectNote, ...]
    programs: dict[str, Program]
    textures: dict[str, Texture]
    targets: dict[str, Target]
    passes: tuple[Pass, ...]
    kept: dict[str, str]
    """Targets of setup passes that other passes read -> SHA-256 of everything that determines their pixels: programs,
    numbers, textures, meshes, states and formats, including those of their inputs. Plans with the same hash can share
    the target as long as no live field and no number of a rule with a step changes. All other targets of setup passes
    are intermediate"""
    uniforms: dict[str, Uniform]
    linear: str = Field(description="Target that holds the finished linear frame: exposed RGB, A = foam coverage")
    samples: int = Field(description="Samples per pixel")
    top: float = Field(description="Upper bound of the crests' height, m: a camera at or above it is above the water")
    trough: float = Field(description="Lower bound of the troughs' height, m: a camera below it is under the water")
    bottom: float = Field(description="Lowest camera height from which more than ground is visible, m")
    live: tuple[str, ...] = Field(description="JSON pointers of scene fields that can change without a new plan")

    @cached_property
    def numbers(self) -> tuple[tuple[dict[str, Uniform], dict[str, Uniform]], ...]:
        """For each pass: its uniforms of constants alone, and the others."""
        used = [uniforms_of(drawn, self.programs[drawn.program], self.uniforms).items() for drawn in self.passes]
        return tuple(
            ({name: of for name, of in own if of.constant}, {name: of for name, of in own if not of.constant})
            for own in used
        )

    def __copy__(self) -> "FramePlan":
        return FramePlan.model_construct(self.model_fields_set, **dict(self))

    def canonical_json(self) -> bytes:
        """The plan's bytes: JSON with sorted keys and no spaces."""
        document = self.model_dump(mode="json")
        return json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.canonical_json()).hexdigest()
