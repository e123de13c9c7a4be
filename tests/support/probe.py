"""Runs functions of ``shaders/`` on arrays of inputs, so that they can be held against float64."""

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from seafoam.effects.effect import Contribution
from seafoam.effects.shader import Inline, Piece
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.framegraph.plan import Program, Shader, State
from seafoam.planner import FramePlan, make_plan
from seafoam.planner.glsl import assemble
from seafoam.quality import Quality
from seafoam.render.gl.executor import TEXTURE_FORMATS, Executor
from seafoam.textures.spec import TextureSpec
from seafoam.textures.store import spec_at, texture
from support.exact import EXACT, everywhere
from support.pictures import draw
from support.scenes import Camera, Scene

WHOLE = assemble(["vertex/vertex.glsl@fullscreen"], {"FULLSCREEN_DEPTH": 0.0})
"""The vertex shader over the whole target."""
STAND_INS = Path(__file__).with_name("stand_ins.glsl")


def stand_in(part: str) -> str:
    """A part of ``stand_ins.glsl``."""
    return f"{STAND_INS}@{part}"


class Probe:
    """A float32 input texel in, a float32 output texel out, through GLSL assembled as the planner does."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self._context = executor._context
        self._resting = self._context.framebuffer([self._context.texture((1, 1), 4)])

    def __call__(
        self,
        files: Sequence[Piece],
        body: str,
        inputs: NDArray[Any],
        *,
        consts: Mapping[str, Any] | None = None,
        uniforms: Mapping[str, Any] | None = None,
        textures: Mapping[str, TextureSpec | str] | None = None,
    ) -> NDArray[np.float32]:
        """Evaluate ``body`` (statements that read ``vec4 x`` and set ``vec4 y``) for each row of ``inputs`` (n, ≤ 4).

        Returns (n, 4) float32.
        """
        count = len(inputs)
        width = min(count, 4096)
        height = -(-count // width)
        packed = np.zeros((height * width, 4), np.float32)
        packed[:count, : inputs.shape[1]] = inputs
        main = Inline(
            "uniform sampler2D u_probe;\nout vec4 o_probe;\nvoid main() {\n"
            "    vec4 x = texelFetch(u_probe, ivec2(gl_FragCoord.xy), 0);\n    vec4 y = vec4(0.0);\n"
            f"{body}\n    o_probe = y;\n}}\n"
        )
        text = assemble([*files, main], {"FOOTPRINT_X": 1.0, **(consts or {})}).text
        context = self._context
        program = context.program(vertex_shader=WHOLE.text, fragment_shader=text)
        source = context.texture((width, height), 4, packed.tobytes(), dtype="f4")
        source.filter = (moderngl.NEAREST, moderngl.NEAREST)
        target = context.texture((width, height), 4, dtype="f4")
        framebuffer = context.framebuffer([target])
        held = [source, target, framebuffer, program]
        source.use(0)
        program["u_probe"] = 0
        for unit, (name, stored) in enumerate((textures or {}).items(), start=1):
            made = self._texture(stored)
            held.append(made)
            made.use(unit)
            program[name] = unit
        for name, value in (uniforms or {}).items():
            if name in program:
                program[name].write(np.asarray(value, np.float32).tobytes())
        framebuffer.use()
        framebuffer.viewport = (0, 0, width, height)
        context.enable_only(0)
        array = context.vertex_array(program, [])
        array.render(moderngl.TRIANGLES, vertices=3)
        raw = framebuffer.read(components=4, dtype="f4")
        error = context.error
        assert error == "GL_NO_ERROR", error
        # moderngl binds the last framebuffer again whenever it makes an object: it must outlive this call.
        self._resting.use()
        for item in (array, *held):
            item.release()
        return np.frombuffer(raw, np.float32).reshape(-1, 4)[:count].copy()

    def contributed(
        self,
        made: Contribution | None,
        files: Sequence[Piece],
        body: str,
        places: NDArray[Any],
        *,
        time: float = 0.0,
        origin: tuple[float, float] = (0.0, 0.0),
        filtered: bool = False,
    ) -> NDArray[np.float64]:
        """Evaluate ``body`` as above with an effect's constants and uniforms; eye over ``origin`` (x, z, m)."""
        assert made is not None, "the effect takes no part in the scene"
        state = FrameState(time, Camera(position=(origin[0], 5.0, origin[1])), 1, 1, 1, 1)
        uniforms = {name: evaluate(uniform, state) for name, uniform in made.uniforms.items()}
        consts = {**made.consts, "SURFACE_FILTER": filtered}
        return self(files, body, places, consts=consts, uniforms=uniforms).astype(np.float64)

    def _texture(self, stored: TextureSpec | str) -> moderngl.Texture:
        data = texture(spec_at(stored) if isinstance(stored, str) else stored)
        components, dtype = TEXTURE_FORMATS[data.format]
        bytes_a_texel = components * int(dtype[1])
        made = self._context.texture((data.width, data.height), components, dtype=dtype, alignment=1)
        if data.levels > 1:
            made.build_mipmaps(0, data.levels - 1)
        offset = 0
        for level in range(data.levels):
            size = max(data.width >> level, 1) * max(data.height >> level, 1) * bytes_a_texel
            made.write(data.data[offset : offset + size], level=level, alignment=1)
            offset += size
        if data.format == "R16F":
            made.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
        else:
            made.filter = (moderngl.NEAREST_MIPMAP_NEAREST if data.levels > 1 else moderngl.NEAREST, moderngl.NEAREST)
        return made


SIDE = 100
"""Places along each side of what :func:`shown` evaluates: 10,000 in all."""


def patched(plan: FramePlan, main: str, name: str = "surface") -> FramePlan:
    """The plan with another main function in its surface's shader, or with that of another program in its place.

    It is drawn all over the target, whatever the eye.
    """
    program = plan.programs[name]
    old = program.fragment.text
    assert old.count("void main()") == 1
    text = old.replace("void main()", "void drawn_main()") + main
    fragment = Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=())
    programs = {**plan.programs, "surface": Program(vertex=WHOLE, fragment=fragment)}
    kept = [one for one in everywhere(plan).passes if one.program not in ("sky", "land", "land, shown")]
    first = next(index for index, one in enumerate(kept) if one.program == "surface")
    kept[first] = kept[first].model_copy(update={"state": State(depth=True, clear=True)})
    return plan.model_copy(update={"programs": programs, "passes": tuple(kept), "top": -1e9})


def shown(
    executor: Executor,
    scene: Scene,
    body: str,
    side: float,
    *,
    time: float = 0.0,
    quality: Quality = EXACT,
    name: str = "surface",
) -> NDArray[np.float64]:
    """(10,000, 4): what ``body`` (reads ``vec2 p``, m from the eye; sets o_color) gives evenly over a square, m."""
    main = f"""
void main() {{
    float i = floor(gl_FragCoord.y) * {SIDE}.0 + floor(gl_FragCoord.x) + 1.0;
    vec2 p = (fract(i * vec2(0.754877666, 0.569840291)) - 0.5) * {side:.1f};
    {body}
}}
"""
    plan = patched(make_plan(scene, quality), main, name)
    pixels = draw(executor, plan, scene.camera, time=time, size=(SIDE, SIDE), output="samples")
    return pixels.reshape(-1, 4).astype(np.float64)


def grid_of(*axes: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, len(axes)).astype(np.float32)
