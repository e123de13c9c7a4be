"""Foam advected by a flow: a current, Stokes drift, vortices. docs/formulae.md, section 14."""

import math
from statistics import NormalDist

from seafoam.effects import effect
from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.shader import VALUE_NOISE, Const, Piece, SlotFile, Source
from seafoam.framegraph.plan import Points
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Loop, array, constants, number, rounded, significant, to_camera, vector
from seafoam.ocean.waves.stokes import steady_drift
from seafoam.quality import Quality
from seafoam.scene import Drift, DriftSaturation, Foam, Scene, Vortex

GENERATIONS = 4
"""Generations of patches that are alive together."""
PARTS = 8
"""Parts of a generation's interval after which displacements are stored; a frame interpolates between two."""
PART_TURN = 1.2
"""Maximum rotation of a vortex in a part, rad, up to which interpolation errs by at most 0.006 of its radius."""
COUNTED = 1024
"""Number of generations after which the same patches appear again."""
REACH = (3.0, 6.0)
"""Distances at which a vortex begins to fade and ends, in radii."""
PEAK = 1.25643121
"""Solution y of e^y = 1 + 2y: with the exponent -y (r/R)², a Lamb-Oseen vortex is fastest at its radius R."""
MOST_TURN = 200.0
"""Maximum rotation of a vortex in the lifetime of a patch, rad: after thirty turns its foam is mixed evenly."""
STEP_TURN = 1.0
"""Maximum rotation of a vortex in a time step of a second or more, rad; proportionally less in a shorter step."""
POINTS_SIDE = 512
"""Maximum cells along a side from which points are moved."""
MOVES = 64
"""Maximum steps of forward mapping; each is a pass."""
APART = (3.37, 5.61)
"""Offset between the two copies of an advected mask, in tiles, so that they nowhere have the same threshold."""
NOISE_DEVIATION = 0.138
SOFTNESS = 0.1
"""Of the noise whose threshold makes the patches: its standard deviation, and half the width of the soft threshold."""
_NUMBERS = ("lib/numbers.glsl", "foam/drift.glsl@square")
_FLOW_MAP = ("lib/texels.glsl@bilinear", "foam/drift.glsl@flow_map")


def draw(scene: Scene, foam: Foam, source: DriftSaturation, quality: Quality) -> effect.Contribution:
    if scene.drift is None:
        return effect.Contribution.invisible("the scene has no drift")
    amount = f"{foam.pointer(source)}/amount"
    advection = _Advection(scene, foam, scene.drift, source, quality)
    common = effect.Contribution(
        why=advection.why,
        consts=advection.consts,
        uniforms={
            **advection.square,
            **advection.clock,
            "u_drift_place": array("vec2", to_camera(*scene.drift.place), 1),
            "u_drift_foam": number(source.amount, amount),
        },
        bound=effect.Bound.zero_if(source.amount == 0.0, "the foam's amount is 0", (amount,)),
    )
    files: tuple[Piece, ...] = ("foam/drift.glsl@square", "foam/drift.glsl@clock")
    if quality.drift == "exact":
        back = ("foam/drift.glsl@ago", "foam/drift.glsl@back", "foam/saturation/drift.glsl@rim")
        needs = (*files, "foam/drift.glsl@flow", *VALUE_NOISE, "foam/drift.glsl@patches", *back)
        slot = SlotFile("saturation", "foam/saturation/drift.glsl@exact", prefix="drift", needs=needs)
        return common.joined(effect.Resources(slots=(slot,), uniforms={**advection.flow, **advection.patches}))
    needs = (*files, "foam/saturation/drift.glsl@rim")
    own = effect.Resources(
        slots=(SlotFile("saturation", "foam/saturation/drift.glsl@map", prefix="drift", needs=needs),),
        inputs={"u_drift_map": "drift"},
        targets=advection.targets(),
        passes=advection.passes(),
    )
    return common.joined(own)


class _Advection:
    """What passes and surface share. Raises ``PlanError`` for a vortex that turns too fast."""

    def __init__(self, scene: Scene, foam: Foam, drift: Drift, source: DriftSaturation, quality: Quality) -> None:
        interval = source.life / GENERATIONS
        generations = min(max(math.ceil(quality.drift_window / interval), 1), GENERATIONS)
        fastest = _fastest(drift, source)
        longest = min(quality.drift_step, STEP_TURN * min(quality.drift_step, 1.0) / max(fastest, 1e-6))
        steps = math.ceil(interval / longest)
        self.forward = quality.drift == "forward"
        self.size = min(quality.drift_size, POINTS_SIDE) if self.forward else quality.drift_size
        self.moves = min(generations * steps, MOVES)
        direction = "forward" if self.forward else "back"
        self.why = f"patches of {source.life:g} s followed {direction}, on a map of {self.size} texels a side"
        if quality.drift == "exact":
            self.why = f"patches of {source.life:g} s followed back in {generations * steps} steps, at each sample"
        vortices = drift.vortices or (Vortex(place=drift.place, speed=0.0),)
        self.consts: dict[str, Const] = {
            "DRIFT_VORTICES": len(vortices),
            "DRIFT_REACH_FROM": REACH[0],
            "DRIFT_REACH": REACH[1],
            "DRIFT_GENERATION": interval,
            "DRIFT_GENERATIONS": generations,
            "DRIFT_STEPS": steps,
            "DRIFT_MOVES": self.moves,
            "DRIFT_SIZE": self.size,
            "DRIFT_PARTS": PARTS,
            "DRIFT_SMOOTH": fastest * interval / PARTS <= PART_TURN,
            "DRIFT_SEED": source.seed,
            "DRIFT_CUT": quality.drift_window < source.life,
            "DRIFT_WINDOW": quality.drift_window,
            "DRIFT_APART_X": significant(APART[0] * foam.mask_tile),
            "DRIFT_APART_Z": significant(APART[1] * foam.mask_tile),
            "DRIFT_CAP": 1.0 if foam.look == "filtered" else SATURATION_CAP,
        }
        self.square = {"u_drift_half": number(0.5 * drift.size)}
        self.clock = {"u_drift_clock": array("vec2", [Loop(period=COUNTED * interval), Loop(period=interval)], 1)}
        # Of each vortex: place relative to the square's and radius, m, and angular velocity, rad/s.
        x, z = drift.place
        turns = [(*rounded((of.place[0] - x, of.place[1] - z)), of.radius, significant(turning(of))) for of in vortices]
        self.flow = {"u_drift_steady": vector(rounded(steady_drift(scene))), "u_drift_vortex": constants("vec4", turns)}
        middle = 0.5 + NOISE_DEVIATION * NormalDist().inv_cdf(1.0 - source.coverage)
        self.patches = {
            "u_drift_scale": number(significant(1.0 / source.patch)),
            "u_drift_cut": vector(rounded((middle - SOFTNESS, middle + SOFTNESS))),
        }
        self.texel = {"u_drift_texel": number(significant(drift.size / self.size))}
        self.coverage = {"u_drift_coverage": number(source.coverage)}

    def targets(self) -> dict[str, Target]:
        """Targets of :meth:`passes`; what is integrated is not filtered: some GPUs interpolate in only 256 steps."""
        side = FixedSize.square(self.size)
        targets = {
            "drift_flow": Target(size=side, format="RGBA32F"),
            "drift": Target(size=side, format="RGBA16F", filter="linear"),
            "drift_coarse": Target(size=FixedSize.square(self.size // 4), format="RGBA16F", filter="linear"),
        }
        if self.forward:
            return {**targets, "drift_moved": Target(size=side, format="RGBA16F", filter="linear")}
        parts = Target(size=FixedSize(width=self.size, height=(PARTS + 1) * self.size), format="RGBA32F")
        way = Target(size=side, format="RGBA32F")
        return {**targets, "drift_way": way, "drift_still": parts, "drift_older": parts}

    def passes(self) -> tuple[effect.PassSpec, ...]:
        files = (*_NUMBERS, "foam/drift.glsl@flow", "foam/drift_passes.glsl@flow")
        return (
            effect.PassSpec("flow of drift", "drift_flow", files, {}, {**self.square, **self.flow, **self.texel}),
            *(self._forward() if self.forward else self._backward()),
            effect.PassSpec("drift, means", "drift_coarse", ("foam/drift_passes.glsl@coarse",)),
        )

    def _backward(self) -> tuple[effect.PassSpec, ...]:
        """Every texel traced back along the flow to where its water was when each generation appeared."""
        square, clock, texel, spec = self.square, self.clock, self.texel, effect.PassSpec
        way = (*_NUMBERS, "foam/drift.glsl@clock", *_FLOW_MAP, "foam/drift.glsl@ago", "foam/drift.glsl@rest")
        youngest = (*way, "foam/drift_passes.glsl@way")
        patches = (*way, *VALUE_NOISE, "foam/drift.glsl@patches", "foam/drift_passes.glsl@backward")
        # Without drift.glsl@clock, whose time-dependent uniform would have these passes drawn in every frame.
        still = (*_NUMBERS, *_FLOW_MAP, "foam/drift.glsl@ago")
        back, further = (*still, "foam/drift_passes.glsl@still"), (*still, "foam/drift_passes.glsl@still_older")
        all_uniforms = {**square, **clock, **self.patches, **texel, **self.coverage}
        return (
            spec("drift, parts of a generation back", "drift_still", back, {}, {**square, **texel}),
            spec("drift, two generations further back", "drift_still_older", further, {}, square, "drift_older"),
            spec("drift, ways of the youngest", "drift_way", youngest, {}, {**square, **clock, **texel}),
            spec("drift, followed back", "drift", patches, {}, all_uniforms),
        )

    def _forward(self) -> tuple[effect.PassSpec, ...]:
        """Points moved along the flow from where the patches appeared."""
        # The last move ends in the map that the surface reads.
        order = ("drift", "drift_moved") if self.moves % 2 == 0 else ("drift_moved", "drift")
        clock = (*_NUMBERS, "foam/drift.glsl@clock")
        files = (*clock, *VALUE_NOISE, "foam/drift.glsl@patches", "foam/drift_passes.glsl@start")
        moved = {**self.square, **self.clock, **self.texel}
        start = effect.PassSpec(
            "drift, where it comes up", "drift_start", files, {}, {**moved, **self.patches}, target=order[0]
        )
        moves = (
            effect.PassSpec(
                f"drift, move {i + 1} of {self.moves}",
                "drift_move",
                ("foam/drift_passes.glsl@forward",),
                {"u_drift_from": order[i % 2]},
                moved,
                target=order[(i + 1) % 2],
                vertex=(*clock, *_FLOW_MAP, "foam/drift_passes.glsl@forward_vertex"),
                mesh=Points(count=GENERATIONS * self.size * self.size),
                blend="add",
                clear=True,
            )
            for i in range(self.moves)
        )
        return (start, *moves)


def advects_mask(scene: Scene, quality: Quality) -> bool:
    """Whether the flow advects the mask too: in the filtered look, which can blend two copies of it."""
    if scene.foam is None or scene.drift is None or scene.foam.look != "filtered" or quality.drift == "forward":
        return False
    source = scene.foam.source(DriftSaturation)
    return source is not None and source.amount > 0.0


def advected_look(look: str, quality: Quality) -> tuple[str, tuple[Piece, ...]]:
    """The file that replaces a look's file where the flow advects the mask, and the files that it needs."""
    exact = quality.drift == "exact"
    paths = ("foam/drift.glsl@way_exact",) if exact else ("lib/texels.glsl@bilinear", "foam/drift.glsl@way_map")
    still = Source(look, (("foam_amount", "still_amount"),))
    return "foam/drift.glsl@carried", (*paths, "foam/shading.glsl@cover", still)


def turning(vortex: Vortex) -> float:
    """Angular velocity at the centre of a vortex, rad/s."""
    return vortex.speed / vortex.radius * PEAK / -math.expm1(-PEAK)


def _fastest(drift: Drift, source: DriftSaturation) -> float:
    """Angular velocity of the fastest vortex, rad/s. Raises ``PlanError`` if one turns by more than MOST_TURN."""
    for i, vortex in enumerate(drift.vortices):
        if abs(turning(vortex)) * source.life > MOST_TURN:
            raise effect.PlanError(
                f"/drift/vortices/{i}/speed",
                f"turns {abs(turning(vortex)) * source.life / (2.0 * math.pi):.3g} times in the lifetime of a patch; "
                f"at most {MOST_TURN / (2.0 * math.pi):.3g} are allowed: reduce its speed or the lifetime, or increase "
                "its radius",
            )
    return max((abs(turning(vortex)) for vortex in drift.vortices), default=0.0)


def drift_limit(source: DriftSaturation, scene: Scene) -> float:
    """Return the greatest drift saturation: the weights of overlapping ages add up to 2."""
    return min(2.0 * source.amount, SATURATION_CAP) if scene.drift is not None else 0.0


EFFECT = effect.foam_effect(
    "drifting foam",
    draw,
    effect.SaturationSource(DriftSaturation, drift_limit, ("amount",)),
    effect.QualityParameter("/drift", "drift", ("forward", "backward", "exact"), "geometry"),
    effect.QualityParameter("/drift_size", "texels of the drift maps", (64, 128, 256, 512), "geometry"),
    effect.QualityParameter("/drift_window", "maximum age of drifting foam, s", (6.0, 12.0, 24.0, 120.0), "geometry"),
    effect.QualityParameter(
        "/drift_step", "maximum time step along the flow, s", (4.0, 2.0, 1.0, 0.5, 0.25), "geometry"
    ),
    fields=("/drift", "/drift/vortices"),
)
