"""The planner: a scene and a quality become a frame plan, here and nowhere else."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import lru_cache

from seafoam.effects import EFFECTS
from seafoam.effects.contribution import (
    ABOVE,
    BENEATH,
    CameraRule,
    Const,
    Contribution,
    FixedSize,
    Fullscreen,
    Grid,
    Mesh,
    PassSpec,
    PlanError,
    SlotFile,
    Target,
    TargetInput,
    TextureInput,
    TextureUse,
    Uniform,
    Viewport,
    ViewportSize,
    number,
    significant,
    vector,
)
from seafoam.plan.adaptive import PLACE, SPREAD, Seen, Spent, spend
from seafoam.plan.assemble import assemble, declared_uniforms, slot_pieces
from seafoam.plan.model import EffectNote, Eye, FramePlan, Pass, Program, State, Texture
from seafoam.plan.setup import with_setup
from seafoam.plan.slots import (
    LAND,
    LAND_COLOR,
    LAND_FOAM,
    MAIN,
    SKY_PASS_SLOTS,
    TONE,
    UNDER_SLOTS,
    WAVES,
    Slot,
    land_slots,
    slots_named,
    surface_slots,
)
from seafoam.plan.view import everywhere
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.textures import texture

_COMMON = ("common/numbers.glsl", "common/camera.glsl")
_MARCH = SlotFile("marched", "surface/begin.glsl", needs=("surface/step.glsl",))
_SAMPLED = (*_COMMON, PLACE)
_FALLING = (*_COMMON, "vertex/horizon.glsl", "vertex/falling.glsl")
_RISING = (*_COMMON, "vertex/horizon.glsl", "vertex/rising.glsl")
_FULL = ("vertex/fullscreen.glsl",)
_AT_FRONT = {"FULLSCREEN_DEPTH": 0.0}
_HORIZON_DEPTH = 0.9999995
"""Clip-space depth of the sky: behind all water, before the cleared depth."""


NEGLIGIBLE = 0.5 / 255.0
"""Half a level of exposed linear light: what can change a pixel by less is left out."""


START_TILE = 4
"""Pixels along a side of the tiles for whose rays one start is found."""


START_SHARE = 0.25
"""Of its tile's height: a shorter step ends the search for a start."""


LOWEST = -100.0
"""Where there is no floor an eye may dive so deep, m: there is nothing more to see."""


MOST_SAMPLERS = 16
"""Textures that one fragment shader may read: no WebGL2 promises more (MAX_TEXTURE_IMAGE_UNITS)."""


class AssemblyError(RuntimeError):
    """The effects contradict each other or their GLSL: a mistake in Seafoam, never in a scene."""


class _Draft:
    """What the effects gave, joined."""

    def __init__(self, scene: Scene, quality: Quality, economy: bool) -> None:
        self.effects: list[EffectNote] = []
        self.skipped: list[EffectNote] = []
        self.slots: list[SlotFile] = []
        self.consts: dict[str, Const] = {}
        self.uniforms: dict[str, Uniform] = {}
        self.inputs: dict[str, TextureInput | TargetInput] = {}
        self.textures: dict[str, TextureUse] = {}
        self.targets: dict[str, Target] = {}
        self.passes: list[PassSpec] = []
        self.top = 0.0
        self.trough = 0.0
        self.grain = 0.0
        self.steepest = 0.0
        self.bounds = [0.0, 0.0, 0.0]
        """Height, slope and curvature at most of what does not measure its own."""
        self.bottom = LOWEST
        self.march = 1
        self.bound_fields: set[str] = set()
        self.readers: dict[str, str] = {}
        """Sampler -> the effect that brings it."""
        for effect in EFFECTS:
            given = effect.contribute(scene, quality)
            if given is None:
                continue
            if economy and given.bound is not None and given.bound.value < NEGLIGIBLE:
                self.skipped.append(EffectNote(name=effect.name, why=given.bound.why, bound=given.bound.value))
                self.bound_fields.update(given.bound.fields)
            else:
                self._add(effect.name, given)

    def _add(self, name: str, given: Contribution) -> None:
        files = [*given.slots]
        paths = {path.partition("?")[0] for file in files for path in (*file.needs, file.path)}
        pieces = {piece for spec in given.passes for piece in (*spec.vertex, *spec.fragment)}
        paths |= {piece.partition("?")[0] for piece in pieces if not piece.startswith("@")}
        self.effects.append(EffectNote(name=name, why=given.why, files=tuple(sorted(paths))))
        self.readers |= dict.fromkeys(given.inputs, name)
        self.slots += files
        self.passes += given.passes
        self.top += given.top
        self.trough += given.trough
        self.grain += given.grain
        self.steepest += given.steepest
        if not any(file.slot == "bounds" for file in files):
            more = (given.top, given.steepest, given.curvature)
            self.bounds = [a + b for a, b in zip(self.bounds, more, strict=True)]
        self.bottom = given.bottom if given.bottom is not None else self.bottom
        self.march = max(self.march, given.march)
        for mine, theirs in (
            (self.consts, given.consts),
            (self.uniforms, given.uniforms),
            (self.inputs, given.inputs),
            (self.textures, given.textures),
            (self.targets, given.targets),
        ):
            taken = mine.keys() & theirs.keys()
            if taken:
                raise AssemblyError(f"{name} defines {sorted(taken)} a second time")
            mine.update(theirs)  # type: ignore[arg-type]

    def add_starts(self, side: int) -> None:
        """The pass that finds, for tiles of the picture, where their rays may begin to look for water and land."""
        self.targets["start"] = Target(size=ViewportSize(scale=side, part=START_TILE), format="RGBA16F")
        self.inputs["u_start"] = TargetInput(target="start")
        if any(file.slot == "bounds" for file in self.slots):
            self.targets["surface_now"] = Target(size=FixedSize(width=1, height=1), format="RGBA16F")
            self.inputs["u_surface_now"] = TargetInput(target="surface_now")
            self.slots.append(SlotFile("now", "surface/now_measured.glsl"))
            self.passes.append(
                PassSpec(
                    name="bounds of the surface",
                    program="surface_now",
                    fragment=(*_COMMON, "@waves", "@bounds", "@short bounds", "surface/now_pass.glsl"),
                    target="surface_now",
                )
            )
        self.passes.append(
            PassSpec(
                name="where rays begin",
                program="start",
                fragment=(*_COMMON, "@waves", "@beyond", "@bounds", "@start", "surface/start_pass.glsl"),
                target="start",
            )
        )


@lru_cache(maxsize=256)
def make_plan(scene: Scene, quality: Quality, *, economy: bool = True) -> FramePlan:
    """The frame plan of a scene at a quality.

    ``economy``: leave out what can change no pixel by more than :data:`NEGLIGIBLE`, and say of passes where they can
    be seen; without it everything that the scene names is drawn from everywhere, which is how both are tested. Pure:
    the same arguments give the same bytes. Raises :class:`seafoam.effects.contribution.PlanError` where the scene asks
    for what does not exist, such as an unknown mask, or for more effects together than one shader can read the textures
    of.
    """
    scene = _kept(scene, quality.waves)
    draft = _Draft(scene, quality, economy)
    side = math.isqrt(quality.samples)
    level = draft.top == 0.0
    shore = any(file.slot == "shore" for file in draft.slots)
    below = any(file.slot == "below" for file in draft.slots)
    # Land stands above the horizon, where no mesh of the sea reaches.
    mesh = quality.surface.method == "mesh" and not level and not shore

    if not level or shore:
        draft.add_starts(side)

    consts: dict[str, Const] = {
        **draft.consts,
        "SURFACE_FILTER": quality.surface.filter,
        "REFINE": quality.surface.refine,
        "MARCH_STEPS": quality.surface.steps * draft.march,
        "MARCH_TOLERANCE": quality.surface.tolerance,
        "START_SHARE": START_SHARE,
        "SAMPLE_SIDE": side,
    }
    find = "plane" if level else "newton" if mesh else "march"
    # Where there is land, a pass before the surface's finds which of them a ray meets.
    chosen = [
        file for file in draft.slots if not shore or file.slot not in (LAND.name, LAND_COLOR.name, LAND_FOAM.name)
    ]
    chosen.append(SlotFile("find", f"surface/{'met' if shore else find}.glsl"))
    if find == "march" and not shore:
        chosen.append(_MARCH)
    combine = scene.foam.combine if scene.foam else "max"
    # Passes, and eyes that crests may cover, march to the surface whatever finds it for the eye: they have no mesh.
    marched = [
        *draft.slots,
        SlotFile("find", f"surface/{'plane' if level else 'march'}.glsl"),
        SlotFile("ceiling", f"below/{'plane' if level else 'find'}.glsl"),
        SlotFile("bounds", "surface/declared_bounds.glsl", prefix="declared"),
        *(
            ()
            if level
            else (
                _MARCH,
                SlotFile(
                    "start", "surface/start.glsl", prefix="water", needs=("surface/step.glsl", "surface/pyramid.glsl")
                ),
            )
        ),
    ]
    surface_fragment = [*_SAMPLED]
    again_fragment = [*_SAMPLED]
    under_fragment = [*_SAMPLED]
    for slot in surface_slots(combine, shore):
        surface_fragment += slot_pieces(slot, chosen)
        again_fragment += slot_pieces(slot, marched)
        under_fragment += _seen_from_above(slot, slot_pieces(slot, marched))
    for slot in UNDER_SLOTS if below else ():
        under_fragment += slot_pieces(slot, marched)
    sky_fragment = [*_SAMPLED, *(piece for slot in SKY_PASS_SLOTS for piece in slot_pieces(slot, chosen))]
    surface_vertex = [*_COMMON, *slot_pieces(WAVES, chosen), "vertex/polar_grid.glsl"] if mesh else _FALLING
    whole = assemble(_FULL, _AT_FRONT)
    programs = {
        "surface": Program(
            vertex=assemble(surface_vertex, {**consts, **_AT_FRONT}),
            fragment=assemble(surface_fragment, consts),
        ),
        "sky": Program(
            vertex=assemble(_FULL, {"FULLSCREEN_DEPTH": _HORIZON_DEPTH}),
            fragment=assemble(sky_fragment, consts),
        ),
        "present": Program(
            vertex=whole,
            fragment=assemble([*slot_pieces(TONE, chosen), "output/present.glsl"], consts),
        ),
    }
    if shore:
        met = [*_SAMPLED, *_pieces(("@waves", "@find", "@land"), marched, shore)]
        land_fragment = [*_SAMPLED]
        for slot in land_slots(combine, any(file.slot == LAND_FOAM.name for file in draft.slots)):
            land_fragment += slot_pieces(slot, marched)
        for name, vertex_of, pieces in (
            ("met", _FALLING, [*met, "surface/met_pass.glsl"]),
            ("met, rising", _RISING, [*met, "surface/met_rising_pass.glsl"]),
            ("land", _FULL, [*land_fragment, "shore/land_pass.glsl"]),
        ):
            programs[name] = Program(vertex=assemble(vertex_of, _AT_FRONT), fragment=assemble(pieces, consts))
        draft.inputs["u_met"] = TargetInput(target="met")
    if below:
        programs["surface, low eye"] = Program(
            vertex=whole,
            fragment=assemble(under_fragment, consts),
        )
    for spec in draft.passes:
        vertex = assemble(_pieces(spec.vertex, marched, shore), {**consts, **_AT_FRONT})
        for name, files in ((spec.program, spec.fragment), (f"{spec.program}, low eye", spec.under if below else ())):
            if files:
                programs[name] = Program(vertex=vertex, fragment=assemble(_pieces(files, marched, shore), consts))
    targets = {
        **draft.targets,
        "samples": Target(size=ViewportSize(scale=side), format=quality.target, depth=True),
    }
    if shore:
        targets["met"] = Target(size=ViewportSize(scale=side), format="RGBA32F")
    drawn = "samples"
    compose: list[Pass] = []
    after = [one for spec in draft.passes if spec.stage == "after" for one in _passes(spec, draft.inputs, below)]
    if after:
        drawn = BENEATH
        targets[BENEATH] = targets["samples"]
        targets[ABOVE] = Target(size=ViewportSize(scale=side), format="RGBA16F")
        targets["samples"] = Target(size=ViewportSize(scale=side), format=quality.target)
        programs["compose"] = Program(
            vertex=whole,
            fragment=assemble(["common/numbers.glsl", "output/compose.glsl"], {}),
        )
        first = next(one for one in after if one.target == ABOVE).name
        after = [
            one.model_copy(update={"state": one.state.model_copy(update={"clear": True})}) if one.name == first else one
            for one in after
        ]
        compose = [
            *after,
            Pass(
                name="what stands before the water",
                when="frame",
                program="compose",
                target="samples",
                mesh=Fullscreen(),
                inputs={"u_beneath": TargetInput(target=BENEATH), "u_above": TargetInput(target=ABOVE)},
            ),
        ]
    linear = "samples"
    resolve: list[Pass] = []
    if side > 1:
        linear = "linear"
        targets[linear] = Target(size=ViewportSize(), format="RGBA32F")
        programs["resolve"] = Program(
            vertex=whole,
            fragment=assemble(["output/resolve.glsl"], consts),
        )
        resolve = [
            Pass(
                name="mean of the samples",
                when="frame",
                program="resolve",
                target=linear,
                mesh=Fullscreen(),
                inputs={"u_samples": TargetInput(target="samples")},
            )
        ]
    own: Mesh = Grid(rows=quality.surface.cells, columns=quality.surface.cells) if mesh else Fullscreen()
    surfaces: list[tuple[Eye, str, Mesh]] = [("over" if below else "any", "surface", own)]
    if below:
        surfaces.append(("under", "surface, low eye", Fullscreen()))
    ashore = [
        Pass(
            name=name,
            when="frame",
            eye=surfaces[0][0],
            program=program,
            target=target,
            mesh=Fullscreen(),
            inputs=draft.inputs,
            state=state,
        )
        for name, program, target, state in (
            ("what rising rays meet", "met, rising", "met", State()),
            ("what rays meet", "met", "met", State()),
            ("land", "land", drawn, State(depth=True)),
        )
        if shore
    ]
    finding, land = ashore[:2], ashore[2:]
    scenery = [
        *(
            Pass(
                name="surface",
                when="frame",
                eye=eye,
                # Land rises over the horizon.
                view="any" if shore else "falling",
                program=program,
                target=drawn,
                mesh=mesh_of,
                inputs=draft.inputs,
                state=State(depth=True, clear=True),
            )
            for eye, program, mesh_of in surfaces
        ),
        *land,
        Pass(
            name="sky",
            when="frame",
            # A mesh ends before the horizon, and a march may go between crests that an eye is among.
            view="any" if mesh else "rising",
            program="sky",
            target=drawn,
            mesh=Fullscreen(),
            state=State(depth=True),
        ),
    ]
    spent: Spent | None = None
    # Without light a sample costs less than its choice.
    if quality.chosen_samples and scene.light is not None:
        fragments = {"surface": again_fragment, "surface, low eye": under_fragment, "sky": sky_fragment}
        depths = {"sky": _HORIZON_DEPTH}
        seen = (
            Seen(one, tuple(fragments[one.program]), depths.get(one.program, 0.0))
            for one in scenery
            if one.program in fragments
        )
        laid, layers = _laid(draft, marched, shore, below)
        for alone in layers:
            targets[alone.target] = targets[ABOVE]
        spent = spend(quality, linear, "finished", tuple(seen), laid, consts)
        spent.passes[:0] = layers
        programs |= spent.programs
        targets |= spent.targets
        linear = "finished"
    passes = [
        *(one for spec in draft.passes if spec.stage == "before" for one in _passes(spec, draft.inputs, below)),
        *finding,
        *scenery,
        *compose,
        *resolve,
        *(spent.passes if spent else ()),
        Pass(
            name="tone",
            when="frame",
            program="present",
            target="screen",
            mesh=Fullscreen(),
            inputs={"u_linear": TargetInput(target=linear)},
        ),
    ]
    for program in programs.values():
        _refuse_too_many(program, draft.readers)
    for one in passes:
        _refuse_whole_numbers(one, targets)
    camera = _camera_uniforms(draft.top, draft.trough, draft.steepest, draft.grain, draft.bounds)
    uniforms = {**draft.uniforms, **camera, **(spent.uniforms if spent else {})}
    textures = {name: _texture(use) for name, use in draft.textures.items()}
    timed, kept = with_setup([_bound(one, programs, uniforms) for one in passes], programs, uniforms, targets, textures)
    plan = FramePlan(
        effects=tuple(draft.effects),
        skipped=tuple(draft.skipped),
        programs=programs,
        textures=textures,
        targets=targets,
        passes=timed,
        kept=kept,
        uniforms=_used(uniforms, programs),
        linear=linear,
        samples=quality.samples,
        top=draft.top,
        bottom=draft.bottom,
        live=tuple(sorted(_live(_used(uniforms, programs)) - draft.bound_fields)),
    )
    return plan if economy else everywhere(plan)


def _kept(scene: Scene, count: int) -> Scene:
    """The scene with its ``count`` steepest waves, in their own order."""
    if len(scene.waves) <= count:
        return scene
    order = sorted(range(len(scene.waves)), key=lambda i: -scene.waves[i].amplitude / scene.waves[i].wavelength)
    return scene.model_copy(update={"waves": tuple(scene.waves[i] for i in sorted(order[:count]))})


def _camera_uniforms(
    top: float, trough: float, steepest: float, grain: float, bounds: Sequence[float]
) -> dict[str, Uniform]:
    return {
        "u_viewport": Uniform(type="vec2", rules=(Viewport(),)),
        "u_eye_height": Uniform(type="float", rules=(CameraRule(what="eye_height"),)),
        "u_ray_x": Uniform(type="vec3", rules=(CameraRule(what="ray_x"),)),
        "u_ray_y": Uniform(type="vec3", rules=(CameraRule(what="ray_y"),)),
        "u_ray_z": Uniform(type="vec3", rules=(CameraRule(what="ray_z"),)),
        "u_view_projection": Uniform(type="mat4", rules=(CameraRule(what="view_projection", top=top),)),
        "u_surface_top": number(top),
        "u_surface_trough": number(significant(trough)),
        "u_surface_steepest": number(steepest),
        "u_surface_bounds": vector(tuple(bounds)),
        "u_surface_grain": number(significant(grain)),
    }


def _pieces(parts: tuple[str, ...], chosen: Sequence[SlotFile], shore: bool) -> list[str]:
    """Files as they are; ``@name`` stands for the slot of that name, as the surface's shader has it."""
    pieces: list[str] = []
    for part in parts:
        if part.startswith("@"):
            for slot in slots_named(part[1:], shore):
                pieces += slot_pieces(slot, chosen)
        else:
            pieces.append(part)
    return pieces


def _refuse_too_many(program: Program, readers: Mapping[str, str]) -> None:
    samplers = [name for name, sampler in declared_uniforms(program.fragment).items() if sampler]
    if len(samplers) > MOST_SAMPLERS:
        shares = Counter(readers.get(name, "other") for name in samplers)
        most = ", ".join(f"{name} {count}" for name, count in shares.most_common())
        raise PlanError(
            "",
            f"too much at once: one shader would read {len(samplers)} textures, and at most {MOST_SAMPLERS} are "
            f"promised by every WebGL2 ({most}); leave out one of these",
        )


def _refuse_whole_numbers(one: Pass, targets: Mapping[str, Target]) -> None:
    """GL leaves open what clearing, blending and filtering make of targets that hold integers."""
    target = targets.get(one.target)
    if target is None or target.format != "RG32UI":
        return
    if one.state != State() or one.mesh != Fullscreen() or target.depth or target.filter != "nearest":
        raise AssemblyError(
            f"pass {one.name}: whole numbers are drawn all over, without depth, and read texel by texel"
        )


def _seen_from_above(slot: Slot, pieces: list[str]) -> list[str]:
    return [*pieces[:-1], f"{pieces[-1]}?main=seen_from_above"] if slot is MAIN else pieces


def _passes(spec: PassSpec, inputs: Mapping[str, TextureInput | TargetInput], below: bool) -> list[Pass]:
    """The pass of a spec, or one for each kind of eye where they differ."""
    brings = any(part.startswith("@") for part in (*spec.vertex, *spec.fragment))
    one = Pass(
        name=spec.name,
        when="frame",
        program=spec.program,
        target=spec.target,
        mesh=spec.mesh,
        inputs={**inputs, **spec.inputs} if brings else spec.inputs,
        uniforms=spec.uniforms,
        view=spec.view,
        state=State(clear=spec.clear, blend=spec.blend),
    )
    if not below or not spec.under:
        return [one]
    low = {"eye": "under", "program": f"{spec.program}, low eye"}
    return [one.model_copy(update={"eye": "over"}), one.model_copy(update=low)]


def _laid(
    draft: _Draft, chosen: Sequence[SlotFile], shore: bool, below: bool
) -> tuple[tuple[Seen, ...], tuple[Pass, ...]]:
    """What lies over surface and sky, as chosen pixels draw it again, and passes that draw points alone for that.

    Points cannot be drawn where chosen samples lie: these read them from where they were drawn over the whole picture.
    """
    specs = [spec for spec in draft.passes if spec.stage == "after" and spec.target == ABOVE]
    seen: list[Seen] = []
    layers: list[Pass] = []
    for spec in specs:
        for one in _passes(spec, draft.inputs, below):
            if isinstance(one.mesh, Fullscreen):
                files = spec.fragment if one.program == spec.program else spec.under
                seen.append(Seen(one, tuple(_pieces(files, chosen, shore))))
                continue
            layer = ABOVE
            if len(specs) > 1:
                layer = f"{spec.name}, alone"
                state = one.state.model_copy(update={"clear": True})
                layers.append(one.model_copy(update={"name": layer, "target": layer, "state": state}))
            reads = {"program": "points", "inputs": {"u_points": TargetInput(target=layer)}, "uniforms": {}}
            seen.append(Seen(one.model_copy(update=reads), SPREAD))
    return tuple(seen), tuple(layers)


def _texture(use: TextureUse) -> Texture:
    data = texture(use.source)
    return Texture(
        url=f"/api/textures/{use.source}",
        sha256=data.sha256,
        format=data.format,
        width=data.width,
        height=data.height,
        levels=data.levels,
        filter=use.filter,
        wrap=use.wrap,
    )


def _bound(one: Pass, programs: dict[str, Program], uniforms: dict[str, Uniform]) -> Pass:
    """The pass with the inputs that its program reads; raises where a uniform has no rule or a sampler no input."""
    program = programs[one.program]
    declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
    samplers = {name for name, sampler in declared.items() if sampler}
    for name in sorted(declared.keys() - samplers):
        if name not in uniforms and name not in one.uniforms:
            raise AssemblyError(f"pass {one.name}: uniform {name} has no rule")
    missing = samplers - one.inputs.keys()
    if missing:
        raise AssemblyError(f"pass {one.name}: nothing to read for {sorted(missing)}")
    return one.model_copy(update={"inputs": {name: source for name, source in one.inputs.items() if name in samplers}})


def _used(uniforms: dict[str, Uniform], programs: dict[str, Program]) -> dict[str, Uniform]:
    """The uniforms that some program declares."""
    declared: set[str] = set()
    for program in programs.values():
        declared |= declared_uniforms(program.vertex).keys() | declared_uniforms(program.fragment).keys()
    return {name: uniform for name, uniform in sorted(uniforms.items()) if name in declared}


def _live(uniforms: dict[str, Uniform]) -> set[str]:
    return {
        rule.field
        for uniform in uniforms.values()
        for rule in uniform.rules
        if rule.rule == "constant" and rule.field is not None
    }
