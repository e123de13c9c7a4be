"""The moderngl executor: draws frame plans in the GL context of its process.

Constraints: one context per process, used by one thread only (GL calls from another thread give no error and return
zeros), and every object is released explicitly (moderngl's garbage-collected release fails on released objects).
"""

import os
import threading
import time as clock
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import moderngl
import numpy as np
from numpy.typing import NDArray

from seafoam.allocator import keep_freed_memory
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.framegraph.plan import Blend, FramePlan, Grid, Mesh, Pass, Points, Program, Quads, uniforms_of
from seafoam.framegraph.resources import MIPMAPPED, Target, Texture, TextureInput
from seafoam.framegraph.rules import Loop, Uniform
from seafoam.framegraph.visibility import drawn_passes, passes_into, reads
from seafoam.render.gl.compilers import COLD_SECONDS, CompileRequest, SecondCompiler, may_assist
from seafoam.render.gl.context import NoRendererError, attach_layers, create_context
from seafoam.render.gl.formats import FORMAT_BYTES, READ, TARGET_FORMATS, TEXTURE_FORMATS, Cache, Output
from seafoam.scene import Camera
from seafoam.textures.store import spec_of, texture

__all__ = ["Executor", "NoRendererError", "Output", "RenderedPixels", "ShaderError"]

_BLENDS: dict[Blend, tuple[int, int]] = {
    "none": (moderngl.ONE, moderngl.ZERO),
    "add": (moderngl.ONE, moderngl.ONE),
    "over": (moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA),
}

_FILTERS = {
    "nearest": (moderngl.NEAREST, moderngl.NEAREST),
    "linear": (moderngl.LINEAR, moderngl.LINEAR),
    "linear_mipmap_linear": (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR),
}

_PROGRAMS_KEPT = 96
_TEXTURES_KEPT = 48
_TARGETS_KEPT = 48
_STATIC_KEPT = 24
"""Targets that setup passes drew, for this plan and earlier ones: a plan has up to three, the largest 10 MB."""


class ShaderError(RuntimeError):
    """A program of a plan does not compile on this GL."""


@dataclass(frozen=True)
class RenderedPixels:
    """A frame, top row first.

    ``pixels``: (height, width, 4) uint8 sRGB for ``rgba8``, uint16 for ``rgba16``; float32 linear with A = foam
    coverage for ``linear``; the same before the mean of samples, (height·n, width·n, 4), for ``samples``. ``timings``:
    seconds spent in ``render`` (draw until finished) and ``read``.
    """

    pixels: NDArray[np.uint8] | NDArray[np.uint16] | NDArray[np.float32]
    timings: dict[str, float]


class _Linked:
    """A linked program and its vertex arrays, with the same lifetime: GL reuses the names of released objects."""

    def __init__(self, context: moderngl.Context, program: moderngl.Program) -> None:
        self._context = context
        self.program = program
        self.members: dict[str, Any] = {name: program[name] for name in program}
        self._units: dict[str, int] = {}
        self.constants: Mapping[str, Uniform] = {}
        self._arrays: dict[Grid | None, tuple[Any, ...]] = {}

    def read(self, name: str, unit: int) -> None:
        """Let a sampler read a unit."""
        if self._units.get(name) != unit:
            self.members[name].value = self._units[name] = unit

    def write(self, name: str, values: NDArray[np.float32]) -> None:
        """Set a uniform; one that the compiler has removed is declared in the source but missing in the program."""
        if member := self.members.get(name):
            # Drivers shorten arrays whose last elements are never read.
            member.write(values[: member.array_length * member.dimension].tobytes())

    def draw(self, mesh: Mesh) -> None:
        if isinstance(mesh, Grid):
            self._array(mesh).render(moderngl.TRIANGLES)
        elif isinstance(mesh, Points):
            self._array(None).render(moderngl.POINTS, vertices=mesh.count)
        else:
            self._array(None).render(moderngl.TRIANGLES, vertices=6 * mesh.count if isinstance(mesh, Quads) else 3)

    def _array(self, mesh: Grid | None) -> moderngl.VertexArray:
        """Return the vertex array that feeds ``mesh``; None: no attributes."""
        if mesh is None and mesh not in self._arrays:
            self._arrays[mesh] = (self._context.vertex_array(self.program, []),)
        elif mesh is not None and mesh not in self._arrays:
            vertices, indices = (self._context.buffer(part.tobytes()) for part in grid(mesh.rows, mesh.columns))
            array = self._context.vertex_array(self.program, [(vertices, "2f", "a_grid")], indices)
            self._arrays[mesh] = array, vertices, indices
        return cast(moderngl.VertexArray, self._arrays[mesh][0])

    def release(self) -> None:
        for parts in self._arrays.values():
            for part in parts:
                part.release()
        self.program.release()


@dataclass
class _Kept:
    """A target that setup passes draw, their uniforms by rules with a step, and the numbers that it was drawn by."""

    target: tuple[Any, ...]
    stepped: tuple[Uniform, ...]
    drawn: bytes | None = None

    def numbers(self, frame: "_Frame") -> bytes:
        return b"".join(frame.values(uniform, (1, 1)).tobytes() for uniform in self.stepped)

    def release(self) -> None:
        Cache.release(self.target)


class _Frame:
    """A frame's time, camera and size, and the values of its uniforms, each computed once for a size of targets."""

    def __init__(self, time: float, camera: Camera, width: int, height: int) -> None:
        self._state = partial(FrameState, time, camera, width, height)
        self._values: dict[tuple[int, tuple[int, int]], NDArray[np.float32]] = {}

    def values(self, uniform: Uniform, size: tuple[int, int]) -> NDArray[np.float32]:
        key = id(uniform), size
        if key not in self._values:
            self._values[key] = evaluate(uniform, self._state(*size))
        return self._values[key]


class Executor:
    """Draws plans. Owns the process's GL context; raises :class:`NoRendererError` if there is none.

    ``assisted``: a software renderer, which compiles on one core, shares the work with a second process where there are
    two; not if this process has had a context. ``optimized``: if not, llvmpipe compiles in half of the time code that
    takes 1.6 times as long to draw the same bytes; the first context of a process decides.
    """

    def __init__(self, device_index: int | None = None, *, assisted: bool = False, optimized: bool = True) -> None:
        if not optimized:
            os.environ.setdefault("GALLIVM_PERF", "nopt")
        self._thread = threading.get_ident()
        assisted = assisted and may_assist()
        self._second = SecondCompiler(lambda: Executor(device_index).compile_frame) if assisted else None
        try:
            self._context = create_context(device_index)
        except NoRendererError:
            self._close_second()
            raise
        # Bound while others are released, since moderngl binds the last framebuffer again when it creates an object.
        self._resting = self._context.framebuffer([self._context.texture((1, 1), 4)])
        names = ("vendor", "renderer", "version")
        self.info: dict[str, str] = {name: self._context.info[f"GL_{name.upper()}"] for name in names}
        self.max_side = int(self._context.info["GL_MAX_TEXTURE_SIZE"])
        # llvmpipe compiles two variants of a program for an opaque state, and one for a blended state. So blending is
        # always enabled there; the factors (1, 0) make it opaque.
        self._always_blends = "llvmpipe" in self.info["renderer"]
        if self._always_blends:
            keep_freed_memory()
        else:
            self._close_second()
        self._programs = Cache(_PROGRAMS_KEPT)
        self._textures = Cache(_TEXTURES_KEPT)
        self._targets = Cache(_TARGETS_KEPT)
        self._static = Cache(_STATIC_KEPT)

    def render(
        self, plan: FramePlan, *, time: float, camera: Camera, width: int, height: int, output: Output = "rgba8"
    ) -> RenderedPixels:
        """Draw a frame of ``plan`` at ``time`` (s, up to ±1e9) from ``camera``, ``width`` × ``height`` pixels.

        Raises :class:`ShaderError` if a program does not compile, ``RuntimeError`` after any GL error or if called from
        a thread other than the one that created the executor.
        """
        self._own_thread()
        start = clock.perf_counter()
        _, dtype, kind = READ[output]
        target_name = _shown(plan, output)
        drawn = drawn_passes(plan, camera, width, height, target_name)
        shown = [index for index, visible in drawn.items() if visible]
        if self._second and (new := self._new(plan, shown)):
            passes = [i for i in longest_first(plan, shown) if i in new]
            self._compile_in_two(self._second, CompileRequest(plan, passes, camera, width, height, output))
        setup = {step.target for step in plan.passes if step.when == "setup"}
        framebuffers = {
            name: self._target(name, target, width, height)
            for name, target in plan.targets.items()
            if name not in setup
        }
        framebuffers["screen"] = self._screen(width, height, output)
        framebuffers |= self._set_up(plan, shown, _Frame(time, camera, 1, 1))
        frame = _Frame(time, camera, width, height)
        # All frame passes are drawn, since plans share their targets and may have overwritten those of earlier frames.
        for index, visible in drawn.items():
            step = plan.passes[index]
            if step.when == "setup":
                continue
            if visible:
                self._draw(plan, index, framebuffers, frame)
            else:
                self._clear(framebuffers[step.target][0])
        self._context.finish()
        finished = clock.perf_counter()
        framebuffer = framebuffers[target_name][0]
        layers = range(len(framebuffer.color_attachments))
        raw = b"".join(framebuffer.read(components=4, attachment=layer, alignment=1, dtype=dtype) for layer in layers)
        shape = (len(layers) * framebuffer.height, framebuffer.width, 4)
        pixels = np.frombuffer(raw, kind).reshape(shape)[::-1]
        error = self._context.error
        if error != "GL_NO_ERROR":
            # Kept targets may have wrong content.
            self._resting.use()
            self._static.clear()
            raise RuntimeError(f"OpenGL error while drawing: {error}")
        self._resting.use()
        for cache in self._caches():
            cache.trim()
        timings = {"render": finished - start, "read": clock.perf_counter() - finished}
        return RenderedPixels(np.ascontiguousarray(pixels), timings)

    def compile_frame(self, request: CompileRequest, passes: Iterable[int]) -> None:
        """Compile the programs of some of the request's passes."""
        self._own_thread()
        plan, size = request.plan, (request.width, request.height)
        into = {name: self._target(name, target, *size) for name, target in plan.targets.items()}
        into["screen"] = self._screen(*size, request.output)
        for name, target in plan.targets.items():
            if target.filter == MIPMAPPED:
                # Drivers compile another program for a texture without levels.
                into[name][1].build_mipmaps()
        frame = _Frame(0.0, request.camera, *size)
        for index in passes:
            framebuffer = into[plan.passes[index].target][0]
            # A driver compiles also for what draws no pixel.
            framebuffer.scissor = (0, 0, 0, 0)
            self._draw(plan, index, into, frame)
            framebuffer.scissor = None

    def _new(self, plan: FramePlan, shown: Iterable[int]) -> set[int]:
        """Return those of the passes whose programs have not been drawn."""
        return {index for index in shown if _key(plan.programs[plan.passes[index].program]) not in self._programs}

    def _compile_in_two(self, second: SecondCompiler, request: CompileRequest) -> None:
        """Compile what a frame draws for the first time in two processes, unless the driver has kept it."""
        own = second.ask(request)
        began = clock.thread_time()
        self._program(request.plan.programs[request.plan.passes[request.passes[0]].program])
        if clock.thread_time() - began > COLD_SECONDS:
            self.compile_frame(request, own)
            second.wait()
        else:
            second.withdraw()

    def _close_second(self) -> None:
        second, self._second = self._second, None
        if second:
            second.close()

    def forget(self) -> None:
        """Release everything cached for later frames: programs, textures and targets."""
        self._own_thread()
        self._resting.use()
        for cache in self._caches():
            cache.clear()

    def close(self) -> None:
        """Release everything, the context last."""
        self._close_second()
        self.forget()
        self._resting.release()
        self._context.release()

    def _caches(self) -> tuple[Cache, ...]:
        return self._programs, self._textures, self._targets, self._static

    def _own_thread(self) -> None:
        if threading.get_ident() != self._thread:
            raise RuntimeError(
                "a GL context draws only in the thread that created it; in others it draws nothing, without an error"
            )

    def _set_up(self, plan: FramePlan, shown: Iterable[int], frame: _Frame) -> dict[str, tuple[Any, ...]]:
        """Return the kept targets that passes of ``shown`` read, with the content that setup passes draw.

        Targets that no earlier frame has drawn, of this plan or of one with the same hash, or that it drew with other
        numbers of rules with a step, are drawn now; on nothing else of the frame they depend.
        """
        setup = {index: plan.passes[index] for index in shown if plan.passes[index].when == "setup"}
        wanted = {name for index in shown if index not in setup for name in reads(plan.passes[index])}
        needed = {name: digest for name, digest in plan.kept.items() if name in wanted}
        kept: dict[str, _Kept] = {
            name: self._static.get(digest, partial(self._keep, plan, name, setup)) for name, digest in needed.items()
        }
        missing = {name: numbers for name, one in kept.items() if (numbers := one.numbers(frame)) != one.drawn}
        if missing:
            steps = passes_into(setup, missing)
            into = {step.target: self._target(step.target, plan.targets[step.target]) for step in steps.values()}
            into |= {name: kept[name].target for name in missing}
            for name in missing:
                kept[name].drawn = None
            for index in steps:
                self._draw(plan, index, into, frame)
            for name, numbers in missing.items():
                kept[name].drawn = numbers
        return {name: one.target for name, one in kept.items()}

    def _keep(self, plan: FramePlan, name: str, setup: Mapping[int, Pass]) -> _Kept:
        """Return the kept target ``name``, which passes of ``setup`` are to draw."""
        steps = passes_into(setup, [name]).values()
        used = [uniforms_of(step, plan.programs[step.program], plan.uniforms).values() for step in steps]
        loops = ((uniform, rule) for own in used for uniform in own for rule in uniform.rules if isinstance(rule, Loop))
        stepped = {id(uniform): uniform for uniform, rule in loops if rule.step is not None}
        return _Kept(self._create(plan.targets[name]), tuple(stepped.values()))

    def _draw(self, plan: FramePlan, index: int, framebuffers: dict[str, tuple[Any, ...]], frame: _Frame) -> None:
        """Draw a pass of a frame, which is given but for the pass and the size of its target."""
        step = plan.passes[index]
        framebuffer = framebuffers[step.target][0]
        model = plan.programs[step.program]
        linked = self._program(model)
        framebuffer.use()
        framebuffer.viewport = (0, 0, framebuffer.width, framebuffer.height)
        depth = moderngl.DEPTH_TEST if step.state.depth else 0
        blend = moderngl.BLEND if step.state.blend != "none" or self._always_blends else 0
        self._context.enable_only(moderngl.PROGRAM_POINT_SIZE | depth | blend)
        self._context.depth_func = "==" if step.state.equal else "<"
        self._context.blend_func = _BLENDS[step.state.blend]
        if step.state.clear:
            self._clear(framebuffer)
        for unit, (name, source) in enumerate(step.inputs.items()):
            if name not in linked.members:
                continue
            if isinstance(source, TextureInput):
                image = self._texture(source.texture, plan.textures[source.texture])
            else:
                image = framebuffers[source.target][1]
            image.use(unit)
            linked.read(name, unit)
        constants, others = plan.numbers[index]
        # A program keeps its uniforms.
        for name, uniform in (others if linked.constants is constants else {**constants, **others}).items():
            linked.write(name, frame.values(uniform, framebuffer.size))
        linked.constants = constants
        linked.draw(step.mesh)
        if step.target in plan.targets and plan.targets[step.target].filter == MIPMAPPED:
            # Means of 2 × 2 texels, level by level; moderngl also sets the filter to trilinear.
            framebuffers[step.target][1].build_mipmaps()

    @staticmethod
    def _clear(framebuffer: Any) -> None:
        framebuffer.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)

    def _program(self, model: Program) -> _Linked:
        def make() -> _Linked:
            try:
                program = self._context.program(vertex_shader=model.vertex.text, fragment_shader=model.fragment.text)
            except moderngl.Error as error:
                raise ShaderError(f"{error}\n{_listing(model)}") from error
            return _Linked(self._context, program)

        return cast(_Linked, self._programs.get(_key(model), make))

    def _texture(self, name: str, model: Texture) -> moderngl.Texture:
        def make() -> moderngl.Texture:
            data = texture(spec_of(model.url))
            if data.sha256 != model.sha256:
                raise RuntimeError(f"texture {name}: its bytes do not have the SHA-256 that the plan states")
            components, dtype = TEXTURE_FORMATS[model.format]
            created = self._context.texture((model.width, model.height), components, dtype=dtype, alignment=1)
            if model.levels > 1:
                # Moderngl allocates levels in no other way; they are written one by one below.
                created.build_mipmaps(0, model.levels - 1)
            offset = 0
            for level in range(model.levels):
                level_width, level_height = max(model.width >> level, 1), max(model.height >> level, 1)
                size = level_width * level_height * components * FORMAT_BYTES[dtype]
                created.write(data.data[offset : offset + size], level=level, alignment=1)
                offset += size
            created.filter = _FILTERS[model.filter]
            created.repeat_x = created.repeat_y = model.wrap == "repeat"
            return created

        return cast(moderngl.Texture, self._textures.get((model.sha256, model.filter, model.wrap), make))

    def _screen(self, width: int, height: int, output: Output) -> tuple[Any, ...]:
        shown = READ[output][0]
        key = "screen", width, height, shown
        make = partial(self._framebuffer, (width, height), shown, depth=False)
        return cast(tuple[Any, ...], self._targets.get(key, make))

    def _target(self, name: str, target: Target, width: int = 0, height: int = 0) -> tuple[Any, ...]:
        size = target.size.of_picture(width, height)
        key = (name, size, target.layers, target.format, target.depth, target.filter, target.wrap)
        return cast(tuple[Any, ...], self._targets.get(key, partial(self._create, target, width, height)))

    def _create(self, target: Target, width: int = 0, height: int = 0) -> tuple[Any, ...]:
        """Create a target for a picture of ``width`` × ``height`` pixels, which targets of fixed size ignore."""
        size = target.size.of_picture(width, height)
        created = self._framebuffer(size, target.format, depth=target.depth, layers=target.layers)
        created[1].filter = _FILTERS[target.filter]
        created[1].repeat_x = created[1].repeat_y = target.wrap == "repeat"
        return created

    def _framebuffer(self, size: tuple[int, int], kind: str, *, depth: bool, layers: int = 1) -> tuple[Any, ...]:
        if max(size) > self.max_side:
            raise ValueError(f"{size[0]} × {size[1]} exceeds this renderer's limit of {self.max_side} pixels per side")
        components, dtype = TARGET_FORMATS[kind]
        color = self._context.texture(size, components, dtype=dtype, alignment=1)
        color.filter = _FILTERS["nearest"]
        color.repeat_x = color.repeat_y = False
        buffers = [self._context.depth_renderbuffer(size)] if depth else []
        framebuffer = self._context.framebuffer([color] * layers, *buffers)
        if layers == 1:
            return framebuffer, color, *buffers
        array = self._context.texture_array((*size, layers), components, dtype=dtype, alignment=1)
        attach_layers(self._context, framebuffer, array)
        color.release()
        return framebuffer, array, *buffers


def longest_first(plan: FramePlan, shown: Iterable[int]) -> list[int]:
    """Return one of the passes for each program and way of drawing with it; those with the longest source first."""
    ways: dict[tuple[Any, ...], int] = {}
    for index in shown:
        step = plan.passes[index]
        target = plan.targets.get(step.target)
        form = (target.format, target.layers, target.depth) if target else None
        ways.setdefault((step.program, step.state.model_copy(update={"clear": False}), form), index)
    return sorted(ways.values(), key=lambda index: -len(plan.programs[plan.passes[index].program].fragment.text))


def _key(program: Program) -> tuple[str, str]:
    return program.vertex.sha256, program.fragment.sha256


def _shown(plan: FramePlan, output: Output) -> str:
    """Return the target whose pixels are read."""
    return {"linear": plan.linear, "samples": "samples"}.get(output, "screen")


def grid(rows: int, columns: int) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Vertices ((rows + 1)(columns + 1), 2) in [0, 1]², columns first, and the indices of two triangles per cell."""
    u = np.arange(columns + 1, dtype=np.float64) / columns
    v = np.arange(rows + 1, dtype=np.float64) / rows
    vertices = np.stack(np.meshgrid(u, v, indexing="xy"), axis=-1).reshape(-1, 2).astype(np.float32)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    first = row * (columns + 1) + column
    corners = np.stack([first, first + 1, first + columns + 1, first + columns + 2], axis=-1)
    indices = corners[..., [0, 1, 2, 2, 1, 3]].reshape(-1).astype(np.uint32)
    return vertices, indices


def _listing(model: Program) -> str:
    parts = []
    for stage, shader in (("vertex", model.vertex), ("fragment", model.fragment)):
        files = ", ".join(f"{file.path} from line {file.line}" for file in shader.files)
        parts.append(f"{stage}: {files}")
    return "\n".join(parts)
