"""Foam saturation from the wave's front (Yingst, Alford and Parberry 2011). docs/formulae.md, section 4."""

import math

from seafoam.effects.bounds import front_limit, waves_top
from seafoam.effects.effect import Bound, Const, Contribution, Effect, SlotFile, TextureUse
from seafoam.effects.foam.living import carries
from seafoam.effects.waves.parametric import profile_square, shares_phase
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, array, number, significant, vector
from seafoam.ocean.dispersion import angular_frequency, wavevector
from seafoam.ocean.stokes import foam_drift, orbit
from seafoam.quality import Quality
from seafoam.scene.foam import FrontSaturation
from seafoam.scene.models import Scene
from seafoam.textures import FRONT_NODES, FrontIntegral, front_fading, front_full

LEAST_RATE = 1e-3
"""Mean frequency of the waves, rad/s, where the foam drifts as fast as they run."""
_CONSTANTS = {"text": (math.pi / 2.0, 2.0 * math.pi, 1.0), "listing": (1.07, 6.28, math.log(2.718))}
"""δ (rad), the number that stands for 2π in the spatial phase, and ln E."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``front``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, FrontSaturation)]
    if not found:
        return None
    index, front = found[0]
    if not scene.waves:
        return Contribution(why="", bound=Bound(0.0, "no wave, so no front"))
    bound = None
    if front_limit(front, scene) == 0.0:
        bound = Bound(0.0, "crests foam only above the greatest possible sum of the waves")
    filtered = scene.foam.look == "filtered"
    if front.decay is not None:
        return _living(scene, front, front.decay, filtered, bound)
    delta, turn, log_base = _CONSTANTS[front.constants]
    consts: dict[str, Const] = {}
    if shares_phase(scene):
        waves_of, own = "foam/saturation/front_shared.glsl", _shared_waves(scene)
    else:
        waves_of, own = "foam/saturation/front_own.glsl", _own_waves(scene, delta, turn)
        consts["FRONT_COUNT"] = len(scene.waves)
    gated = front.group != (0.0, 0.0)
    pointer = f"/foam/saturation/{index}"
    consts["FRONT_GATED"] = gated
    uniforms: dict[str, Uniform] = {
        **own,
        # The filtered look reads C from a table as well, so there it is not free to move.
        "u_front_intensity": number(front.intensity, None if filtered else f"{pointer}/intensity"),
        "u_front_log_base": number(log_base),
        "u_front_group": _group(front),
    }
    count = len(scene.waves)
    why = f"front saturation of {count} wave{'s' if count > 1 else ''}, constants of the {front.constants}"
    needs: tuple[str, ...] = (waves_of, "foam/saturation/front_gate.glsl", "foam/saturation/front_profile.glsl")
    if filtered:
        needs = (*needs, "foam/saturation/front_seen.glsl")
    if not filtered:
        return Contribution(
            why=why,
            slots=(SlotFile("saturation", "foam/saturation/front.glsl", prefix="front", needs=needs),),
            consts=consts,
            uniforms=uniforms,
            bound=bound,
        )
    uniforms["u_front_relief"] = number(significant(_relief(scene, turn / (2.0 * math.pi))))
    integral = FrontIntegral(intensity=front.intensity, log_base=log_base)
    return Contribution(
        why=f"{why}, averaged over footprints",
        slots=(SlotFile("saturation", "foam/saturation/front_filtered.glsl", prefix="front", needs=needs),),
        consts={
            **consts,
            "FRONT_CREST": 2.0 * delta - math.pi / 2.0,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(front.intensity, log_base),
            "FRONT_FADING": front_fading(front.intensity, log_base),
        },
        uniforms=uniforms,
        inputs={"u_front_integral": TextureInput(texture="front_integral")},
        textures={"front_integral": TextureUse(integral, wrap="clamp_to_edge")},
        bound=bound,
    )


def _living(scene: Scene, front: FrontSaturation, decay: float, filtered: bool, bound: Bound | None) -> Contribution:
    """Foam that stays where fronts have left it."""
    shared = shares_phase(scene)
    waves, mean = _drifting(scene, shared)
    of_waves = _shared_waves(scene) if shared else _own_waves(scene, *_CONSTANTS["text"][:2])
    way = "none"
    if carries(scene):
        way = "shared" if shared else "own"
        if not shared:
            of_waves["u_front_orbit"] = _orbits(scene)
    life = significant(mean * decay)
    born = significant(front_full(front.intensity, 1.0))
    count = len(scene.waves)
    return Contribution(
        why=f"foam of {count} wave{'s' if count > 1 else ''} left by the last three fronts, {decay:g} s to 1/e",
        slots=(
            SlotFile(
                "saturation",
                "foam/saturation/front_living.glsl",
                prefix="front",
                needs=(
                    f"foam/saturation/front_{'shared' if shared else 'own'}.glsl",
                    "foam/saturation/front_gate.glsl",
                    "foam/saturation/front_seen.glsl",
                    f"foam/saturation/way_{way}.glsl",
                ),
            ),
        ),
        consts={
            "FRONT_COUNT": len(waves),
            "FRONT_GATED": front.group != (0.0, 0.0),
            "FRONT_FILTERED": filtered,
            "FRONT_CREST": math.pi / 2.0,
            "FRONT_BORN": born,
            "FRONT_LIFE": life,
            "FRONT_WHOLE": significant(born + life * -math.expm1((born - 2.0 * math.pi) / life)),
        },
        uniforms={
            **of_waves,
            "u_living": array("vec4", waves, len(waves)),
            "u_front_relief": number(significant(_relief(scene, 1.0))),
            "u_front_group": _group(front),
        },
        bound=bound,
    )


def _drifting(scene: Scene, shared: bool) -> tuple[list[Constant], float]:
    """Of each wave what its past fronts need, as water that drifts meets them; and their mean frequency, rad/s.

    ``shared``: of the waves that the surface has, which are those with height.
    """
    x, z = foam_drift(scene)
    met = []
    for wave, weight in zip(scene.waves, _weights(scene), strict=True):
        kx, kz = wavevector(wave, scene.water.depth)
        # Water that drifts along with a wave meets it less often.
        met.append((wave, weight, angular_frequency(wave) - kx * x - kz * z))
    mean = max(sum(weight * rate for _, weight, rate in met), LEAST_RATE)
    made: list[Constant] = []
    for wave, weight, rate in met:
        if wave.amplitude > 0.0 or not shared:
            turn = 2.0 * math.pi * rate / mean
            past = (rate / mean, math.cos(turn), math.sin(turn))
            made.append(Constant(value=(*(significant(value) for value in past), weight)))
    return made, mean


def _orbits(scene: Scene) -> Uniform:
    """How far each wave carries its water along its heading, (x, z) m."""
    reaches = [(orbit(wave, scene.water.depth), wave.direction) for wave in scene.waves]
    along = [Constant(value=(significant(r * math.cos(d)), significant(r * math.sin(d)))) for r, d in reaches]
    return array("vec2", along, len(along))


def _weights(scene: Scene) -> list[float]:
    """Each wave's share of the sum of all amplitudes; of none, the same share each."""
    total = waves_top(scene)
    return [wave.amplitude / total if total > 0.0 else 1.0 / len(scene.waves) for wave in scene.waves]


def _shared_waves(scene: Scene) -> dict[str, Uniform]:
    return {"u_front_share": number(significant(1.0 / waves_top(scene)))}


def _group(front: FrontSaturation) -> Uniform:
    return vector((front.group[0], max(front.group[1], front.group[0] + 1e-4)))


def _own_waves(scene: Scene, delta: float, turn: float) -> dict[str, Uniform]:
    """Wavenumbers, weights and phases of the front's own."""
    data: list[Constant] = []
    phases: list[Phase] = []
    for wave, weight in zip(scene.waves, _weights(scene), strict=True):
        kx, kz = (turn / (2.0 * math.pi) * k for k in wavevector(wave, scene.water.depth))
        data.append(Constant(value=(kx, kz, weight, 0.0)))
        phases.append(Phase(offset=wave.phase + (2.0 * delta - math.pi), rate=angular_frequency(wave), k=(-kx, -kz)))
    return {
        "u_front_wave": array("vec4", data, len(data)),
        "u_front_phase": array("float", phases, len(data)),
    }


def _relief(scene: Scene, spatial: float) -> float:
    """Slope amplitude of the sinusoid whose mean square slope is that of all waves together, wavenumbers scaled."""
    total = 0.0
    for wave in scene.waves:
        square = profile_square(wave.exponent)
        total += (spatial * math.hypot(*wavevector(wave, scene.water.depth)) * wave.amplitude) ** 2 * square
    return math.sqrt(2.0 * total)


EFFECT = Effect("front foam", contribute)
