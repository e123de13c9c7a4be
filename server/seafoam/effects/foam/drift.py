"""Foam that a flow carries: a current, the waves' own drift, vortices. docs/formulae.md, section 14."""

import math
from statistics import NormalDist

from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.effect import (
    Bound,
    Const,
    Contribution,
    Effect,
    Knob,
    PassSpec,
    Piece,
    PlanError,
    SlotFile,
    Source,
)
from seafoam.effects.light.noise import VALUE_NOISE
from seafoam.framegraph.passes import Points
from seafoam.framegraph.resources import FixedSize, Target, TargetFormat, TargetInput, TextureInput
from seafoam.framegraph.rules import Constant, Held, Loop, Uniform, array, number, significant, vector
from seafoam.ocean.stokes import steady_drift
from seafoam.quality import Quality
from seafoam.scene.drift import Drift, Vortex
from seafoam.scene.foam import DriftSaturation, Foam
from seafoam.scene.models import Scene

GENERATIONS = 4
"""Generations of patches that are alive together."""
PARTS = 4
"""Parts of a generation at which ways back are known beforehand: a frame follows the rest, an eighth in the mean."""
COUNTED = 1024
"""Generations after which the same patches come up again."""
REACH = (3.0, 6.0)
"""Radii from which a vortex fades, and where it ends."""
PEAK = 1.25643121
"""y with e^y = 1 + 2y: (r/a)² of Lamb and Oseen's vortex where it turns fastest is y over this."""
MOST_TURN = 200.0
"""rad that a vortex may turn in the life of a patch: past thirty turns its foam is ground to nothing anyway."""
STEP_TURN = 1.0
"""rad that a vortex turns in a step of a second or more at most; in a shorter one, its share of it."""
POINTS_SIDE = 512
"""Cells along a side that points are moved from at most."""
MOVES = 64
"""Steps of forward mapping at most; each is a pass."""
APART = (3.37, 5.61)
"""Between the two copies of a mask that is carried, in tiles: no two places have the same threshold."""
NOISE_DEVIATION = 0.138
SOFTNESS = 0.1
"""Of the noise that patches are cut from: its standard deviation, and half the width of the cut."""
_FAR = 1e8
"""Places are held so far from the eye, m: no picture reaches there."""
_NUMBERS = ("lib/numbers.glsl", "foam/drift/square.glsl")
_FLOW_MAP = ("lib/bilinear.glsl", "foam/drift/flow_map.glsl")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``drift``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, DriftSaturation)]
    if not found:
        return None
    index, source = found[0]
    drift = scene.drift
    if drift is None:
        return Contribution(
            why="no flow to carry foam",
            bound=Bound(0.0, "there is no drift"),
        )
    generation = source.life / GENERATIONS
    generations = min(max(math.ceil(quality.drift_window / generation), 1), GENERATIONS)
    fastest = _fastest(drift, source)
    longest = min(quality.drift_step, STEP_TURN * min(quality.drift_step, 1.0) / max(fastest, 1e-6))
    steps = math.ceil(generation / longest)
    bound = (
        Bound(0.0, "its foam has no amount", (f"/foam/saturation/{index}/amount",)) if source.amount == 0.0 else None
    )
    given = _Given(scene, scene.foam, drift, source, quality, generation, generations, steps)
    common: dict[str, Uniform] = {
        **given.square,
        **given.clock,
        "u_drift_place": array("vec2", _to_eye(drift.place), 1),
        "u_drift_foam": number(source.amount, f"/foam/saturation/{index}/amount"),
    }
    if quality.drift == "exact":
        return Contribution(
            why=f"patches of {source.life:g} s followed back in {generations * steps} steps, at each sample",
            slots=(
                SlotFile(
                    "saturation",
                    "foam/saturation/drift_exact.glsl",
                    prefix="drift",
                    needs=(
                        "foam/drift/square.glsl",
                        "foam/drift/clock.glsl",
                        "foam/drift/flow.glsl",
                        *VALUE_NOISE,
                        "foam/drift/patches.glsl",
                        "foam/drift/ago.glsl",
                        "foam/drift/back.glsl",
                        "foam/saturation/drift_rim.glsl",
                    ),
                ),
            ),
            consts=given.consts,
            uniforms={**common, **given.flow, **given.patches},
            bound=bound,
        )
    size = given.size
    ways = "back" if quality.drift == "backward" else "forward"
    return Contribution(
        why=f"patches of {source.life:g} s followed {ways}, on a map of {size} texels a side",
        slots=(
            SlotFile(
                "saturation",
                "foam/saturation/drift.glsl",
                prefix="drift",
                needs=(
                    "lib/bilinear.glsl",
                    "foam/drift/square.glsl",
                    "foam/drift/clock.glsl",
                    "foam/saturation/drift_rim.glsl",
                ),
            ),
        ),
        consts=given.consts,
        uniforms=common,
        inputs={
            "u_drift_map": TargetInput(target="drift"),
            "u_drift_coarse": TargetInput(target="drift_coarse"),
            **({} if given.forward else {"u_drift_way": TargetInput(target="drift_way")}),
        },
        targets=given.targets(),
        passes=given.passes(),
        bound=bound,
    )


class _Given:
    """What the passes and the surface share."""

    def __init__(
        self,
        scene: Scene,
        foam: Foam,
        drift: Drift,
        source: DriftSaturation,
        quality: Quality,
        generation: float,
        generations: int,
        steps: int,
    ) -> None:
        self.forward = quality.drift == "forward"
        self.size = min(quality.drift_size, POINTS_SIDE) if self.forward else quality.drift_size
        self.moves = min(generations * steps, MOVES)
        vortices = drift.vortices or (Vortex(place=drift.place, speed=0.0),)
        self.consts: dict[str, Const] = {
            "DRIFT_VORTICES": len(vortices),
            "DRIFT_REACH_FROM": REACH[0],
            "DRIFT_REACH": REACH[1],
            "DRIFT_GENERATION": generation,
            "DRIFT_GENERATIONS": generations,
            "DRIFT_STEPS": steps,
            "DRIFT_MOVES": self.moves,
            "DRIFT_SIZE": self.size,
            "DRIFT_PARTS": PARTS,
            "DRIFT_SEED": source.seed,
            "DRIFT_CUT": quality.drift_window < source.life,
            "DRIFT_WINDOW": quality.drift_window,
            "DRIFT_APART_X": significant(APART[0] * foam.mask_tile),
            "DRIFT_APART_Z": significant(APART[1] * foam.mask_tile),
            "DRIFT_CAP": 1.0 if foam.look == "filtered" else SATURATION_CAP,
        }
        steady = steady_drift(scene)
        self.square = {"u_drift_half": number(0.5 * drift.size)}
        self.clock = {"u_drift_clock": array("vec2", [Loop(period=COUNTED * generation), Loop(period=generation)], 1)}
        self.flow = {
            "u_drift_steady": vector((significant(steady[0]), significant(steady[1]))),
            "u_drift_vortex": array(
                "vec4",
                [
                    Constant(
                        value=(
                            significant(vortex.place[0] - drift.place[0]),
                            significant(vortex.place[1] - drift.place[1]),
                            vortex.radius,
                            significant(turning(vortex)),
                        )
                    )
                    for vortex in vortices
                ],
                len(vortices),
            ),
        }
        middle = 0.5 + NOISE_DEVIATION * NormalDist().inv_cdf(1.0 - source.coverage)
        self.patches = {
            "u_drift_scale": number(significant(1.0 / source.patch)),
            "u_drift_cut": vector((significant(middle - SOFTNESS), significant(middle + SOFTNESS))),
        }
        self.texel = {"u_drift_texel": number(significant(drift.size / self.size))}
        self.coverage = {"u_drift_coverage": number(source.coverage)}

    def targets(self) -> dict[str, Target]:
        # Every map is read texel by texel: samplers of some GPUs weigh texels in 256 steps.
        def square(side: int, kind: TargetFormat) -> Target:
            return Target(size=FixedSize(width=side, height=side), format=kind)

        made = {
            "drift_flow": square(self.size, "RGBA32F"),
            "drift": square(self.size, "RGBA16F"),
            "drift_coarse": square(self.size // 4, "RGBA16F"),
        }
        if self.forward:
            made["drift_moved"] = square(self.size, "RGBA16F")
        else:
            made["drift_way"] = square(self.size, "RGBA32F")
            parts = FixedSize(width=self.size, height=PARTS * self.size)
            for name in ("drift_still", "drift_older"):
                made[name] = Target(size=parts, format="RGBA32F")
        return made

    def passes(self) -> tuple[PassSpec, ...]:
        flow = PassSpec(
            name="flow of drift",
            program="drift_flow",
            fragment=(*_NUMBERS, "foam/drift/flow.glsl", "foam/drift/flow_pass.glsl"),
            target="drift_flow",
            uniforms={**self.square, **self.flow, **self.texel},
        )
        coarse = PassSpec(
            name="drift, means",
            program="drift_coarse",
            fragment=("foam/drift/coarse_pass.glsl",),
            target="drift_coarse",
            inputs={"u_drift_map": TargetInput(target="drift")},
        )
        return (flow, *(self._forward() if self.forward else self._backward()), coarse)

    def _backward(self) -> tuple[PassSpec, ...]:
        flow: dict[str, TextureInput | TargetInput] = {"u_drift_flow": TargetInput(target="drift_flow")}
        back = (
            *_NUMBERS,
            "foam/drift/clock.glsl",
            *_FLOW_MAP,
            "foam/drift/ago.glsl",
            "foam/drift/back.glsl",
        )
        # Without the clock, whose hands would have them drawn in every frame.
        still = (*_NUMBERS, *_FLOW_MAP, "foam/drift/ago.glsl")
        return (
            PassSpec(
                name="drift, quarters of a generation back",
                program="drift_still",
                fragment=(*still, "foam/drift/still_pass.glsl"),
                target="drift_still",
                inputs=flow,
                uniforms={**self.square, **self.texel},
            ),
            PassSpec(
                name="drift, two generations further back",
                program="drift_still_older",
                fragment=(*still, "foam/drift/still_older_pass.glsl"),
                target="drift_older",
                inputs={**flow, "u_drift_still": TargetInput(target="drift_still")},
                uniforms=self.square,
            ),
            PassSpec(
                name="drift, ways of the youngest",
                program="drift_way",
                fragment=(*back, "foam/drift/rest.glsl", "foam/drift/way_pass.glsl"),
                target="drift_way",
                inputs={**flow, "u_drift_still": TargetInput(target="drift_still")},
                uniforms={**self.square, **self.clock, **self.texel},
            ),
            PassSpec(
                name="drift, followed back",
                program="drift",
                fragment=(
                    *back,
                    "foam/drift/rest.glsl",
                    *VALUE_NOISE,
                    "foam/drift/patches.glsl",
                    "foam/drift/backward_pass.glsl",
                ),
                target="drift",
                inputs={
                    **flow,
                    "u_drift_way": TargetInput(target="drift_way"),
                    "u_drift_older": TargetInput(target="drift_older"),
                },
                uniforms={**self.square, **self.clock, **self.patches, **self.texel, **self.coverage},
            ),
        )

    def _forward(self) -> tuple[PassSpec, ...]:
        # The last move ends in the map that the surface reads.
        order = ("drift", "drift_moved") if self.moves % 2 == 0 else ("drift_moved", "drift")
        start = PassSpec(
            name="drift, where it comes up",
            program="drift_start",
            fragment=(
                *_NUMBERS,
                "foam/drift/clock.glsl",
                *VALUE_NOISE,
                "foam/drift/patches.glsl",
                "foam/drift/start_pass.glsl",
            ),
            target=order[0],
            uniforms={**self.square, **self.clock, **self.patches, **self.texel},
        )
        moves = (
            PassSpec(
                name=f"drift, move {i + 1} of {self.moves}",
                program="drift_move",
                vertex=(
                    *_NUMBERS,
                    "foam/drift/clock.glsl",
                    *_FLOW_MAP,
                    "foam/drift/forward_vertex.glsl",
                ),
                fragment=("foam/drift/forward_pass.glsl",),
                target=order[(i + 1) % 2],
                mesh=Points(count=GENERATIONS * self.size * self.size),
                inputs={
                    "u_drift_flow": TargetInput(target="drift_flow"),
                    "u_drift_from": TargetInput(target=order[i % 2]),
                },
                uniforms={**self.square, **self.clock, **self.texel},
                blend="add",
                clear=True,
            )
            for i in range(self.moves)
        )
        return (start, *moves)


def carries(scene: Scene, quality: Quality) -> bool:
    """Whether the flow carries the mask too: with the filtered look, whose copies can be laid over one another."""
    if scene.foam is None or scene.drift is None or scene.foam.look != "filtered" or quality.drift == "forward":
        return False
    return any(isinstance(one, DriftSaturation) and one.amount > 0.0 for one in scene.foam.saturation)


def carried(look: str, quality: Quality) -> tuple[str, tuple[Piece, ...]]:
    """The file that stands in for a look's where its mask is carried, and what it needs."""
    exact = quality.drift == "exact"
    ways = ("foam/drift/way_exact.glsl",) if exact else ("lib/bilinear.glsl", "foam/drift/way_map.glsl")
    return "foam/drift/carried.glsl", (*ways, "foam/cover.glsl", Source(look, (("foam_amount", "still_amount"),)))


def turning(vortex: Vortex) -> float:
    """Angular velocity at a vortex' centre, rad/s."""
    return vortex.speed / vortex.radius * PEAK / -math.expm1(-PEAK)


def _fastest(drift: Drift, source: DriftSaturation) -> float:
    """Angular velocity of the fastest vortex, rad/s. Raises ``PlanError`` where one turns too often to be followed."""
    for i, vortex in enumerate(drift.vortices):
        if abs(turning(vortex)) * source.life > MOST_TURN:
            raise PlanError(
                f"/drift/vortices/{i}/speed",
                f"turns {abs(turning(vortex)) * source.life / (2.0 * math.pi):.3g} times in the lifetime of a patch; "
                f"at most {MOST_TURN / (2.0 * math.pi):.3g} are allowed: reduce its speed or the lifetime, or increase "
                "its radius",
            )
    return max((abs(turning(vortex)) for vortex in drift.vortices), default=0.0)


def _to_eye(place: tuple[float, float]) -> tuple[Held, Held]:
    """From a place to the eye."""
    return (
        Held(offset=-place[0], k=(1.0, 0.0), low=-_FAR, high=_FAR),
        Held(offset=-place[1], k=(0.0, 1.0), low=-_FAR, high=_FAR),
    )


EFFECT = Effect(
    "drifting foam",
    contribute,
    knobs=(
        Knob("/drift", "drift", ("forward", "backward", "exact"), "geometry"),
        Knob("/drift_size", "texels of the drift maps", (64, 128, 256, 512), "geometry"),
        Knob("/drift_window", "maximum age of drifting foam, s", (6.0, 12.0, 24.0, 120.0), "geometry"),
        Knob("/drift_step", "maximum time step along the flow, s", (4.0, 2.0, 1.0, 0.5, 0.25), "geometry"),
    ),
)
