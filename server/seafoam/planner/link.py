"""Linking: assigns to each pass the inputs that its program reads, and to each declared uniform its rule."""

from collections.abc import Mapping

from seafoam.effects.effect import AssemblyError, PlanError, TextureUse
from seafoam.framegraph.plan import Pass, Program, declared_uniforms
from seafoam.framegraph.resources import Input, Texture
from seafoam.framegraph.rules import CameraRule, Uniform, Viewport, number, significant, vector
from seafoam.planner.collect import Collection
from seafoam.textures.store import texture, url_of

MAX_SAMPLERS = 16
"""Maximum number of textures of a fragment shader that WebGL2 guarantees (MAX_TEXTURE_IMAGE_UNITS)."""


def camera_uniforms(given: Collection) -> dict[str, Uniform]:
    """Return the uniforms of the camera and of the surface's bounds, which any shader may declare."""
    return {
        "u_viewport": Uniform(type="vec2", rules=(Viewport(),)),
        "u_eye_height": Uniform(type="float", rules=(CameraRule(what="eye_height"),)),
        "u_ray_x": Uniform(type="vec3", rules=(CameraRule(what="ray_x"),)),
        "u_ray_y": Uniform(type="vec3", rules=(CameraRule(what="ray_y"),)),
        "u_ray_z": Uniform(type="vec3", rules=(CameraRule(what="ray_z"),)),
        "u_view_projection": Uniform(type="mat4", rules=(CameraRule(what="view_projection", top=given.max_height),)),
        "u_surface_top": number(given.max_height),
        "u_surface_trough": number(significant(given.min_height)),
        "u_surface_steepest": number(given.max_slope),
        "u_surface_bounds": vector(given.bounds),
        "u_surface_grain": number(significant(given.map_error)),
    }


def texture_entry(use: TextureUse) -> Texture:
    data = texture(use.source)
    return Texture(
        url=url_of(use.source),
        sha256=data.sha256,
        format=data.format,
        width=data.width,
        height=data.height,
        levels=data.levels,
        filter=use.filter,
        wrap=use.wrap,
    )


def with_inputs(
    drawn: Pass, programs: Mapping[str, Program], uniforms: Mapping[str, Uniform], known: Mapping[str, Input]
) -> Pass:
    """Return the pass with the inputs that its program reads: its own, and of those it has not the ``known`` ones.

    Raises :class:`AssemblyError` if a uniform has no rule or a sampler no input.
    """
    program = programs[drawn.program]
    declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
    samplers = {name for name, sampler in declared.items() if sampler}
    for name in sorted(declared.keys() - samplers):
        if name not in uniforms and name not in drawn.uniforms:
            raise AssemblyError(f"pass {drawn.name}: uniform {name} has no rule")
    sources = {**known, **drawn.inputs}
    missing = samplers - sources.keys()
    if missing:
        raise AssemblyError(f"pass {drawn.name}: no source for {sorted(missing)}")
    return drawn.model_copy(update={"inputs": {name: sources[name] for name in sorted(samplers)}})


def declared_in(uniforms: Mapping[str, Uniform], programs: Mapping[str, Program]) -> dict[str, Uniform]:
    shaders = (shader for program in programs.values() for shader in (program.vertex, program.fragment))
    declared = set[str]().union(*map(declared_uniforms, shaders))
    return {name: uniform for name, uniform in sorted(uniforms.items()) if name in declared}


def live_fields(uniforms: Mapping[str, Uniform]) -> set[str]:
    """Return the JSON pointers of scene fields that are constants: they can change without a new plan.

    Of lists that can change as a whole, the list's own pointer.
    """
    rules = [rule for uniform in uniforms.values() for rule in uniform.rules]
    constants = [rule for rule in rules if rule.rule == "constant" and rule.field is not None]
    return {_list_of(rule.field) if rule.absent is not None else rule.field for rule in constants if rule.field}


def _list_of(pointer: str) -> str:
    """The pointer of the outermost list that an element's field is in."""
    steps = pointer.split("/")
    return "/".join(steps[: next(i for i, step in enumerate(steps) if step.isdecimal())])


def refuse_too_many_samplers(program: Program) -> None:
    """Raise :class:`PlanError` if a shader reads more than :data:`MAX_SAMPLERS` textures."""
    read = [name for name, sampler in declared_uniforms(program.fragment).items() if sampler]
    if len(read) > MAX_SAMPLERS:
        what = f"one shader would read {len(read)} textures, and WebGL2 guarantees {MAX_SAMPLERS}"
        raise PlanError("", f"too many effects together: {what}; leave out an effect")
