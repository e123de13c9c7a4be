"""Foam saturation from the wave's front (Yingst, Alford and Parberry 2011). docs/formulae.md, section 4."""

import math

from seafoam.effects.bounds import front_limit, waves_top
from seafoam.effects.effect import Bound, Const, Contribution, Effect, HardCase, SlotFile, TextureUse
from seafoam.effects.foam.living import carries
from seafoam.effects.waves.parametric import profile_square, shares_phase
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, array, number, significant, vector
from seafoam.ocean.dispersion import angular_frequency, wavevector
from seafoam.ocean.stokes import foam_drift, orbit
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Foam,
    FrontSaturation,
    HeightSaturation,
    ParametricWave,
    Scene,
)
from seafoam.textures import FRONT_NODES, front_fading, front_full, front_integral_name

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
        waves_of, own = "saturation/front_shared.glsl", {"u_front_share": number(significant(1.0 / waves_top(scene)))}
    else:
        waves_of, own = "saturation/front_own.glsl", _own_waves(scene, delta, turn)
        consts["FRONT_COUNT"] = len(scene.waves)
    gated = front.group != (0.0, 0.0)
    pointer = f"/foam/saturation/{index}"
    consts["FRONT_GATED"] = gated
    uniforms: dict[str, Uniform] = {
        **own,
        # The filtered look reads C from a table as well, so there it is not free to move.
        "u_front_intensity": number(front.intensity, None if filtered else f"{pointer}/intensity"),
        "u_front_log_base": number(log_base),
        "u_front_group": vector((front.group[0], max(front.group[1], front.group[0] + 1e-4))),
    }
    count = len(scene.waves)
    why = f"front saturation of {count} wave{'s' if count > 1 else ''}, constants of the {front.constants}"
    needs: tuple[str, ...] = (waves_of, "saturation/front_gate.glsl", "saturation/front_profile.glsl")
    if filtered:
        needs = (*needs, "saturation/front_seen.glsl")
    if not filtered:
        return Contribution(
            why=why,
            slots=(SlotFile("saturation", "saturation/front.glsl", prefix="front", needs=needs),),
            consts=consts,
            uniforms=uniforms,
            bound=bound,
        )
    uniforms["u_front_relief"] = number(significant(_relief(scene, turn / (2.0 * math.pi))))
    return Contribution(
        why=f"{why}, averaged over footprints",
        slots=(SlotFile("saturation", "saturation/front_filtered.glsl", prefix="front", needs=needs),),
        consts={
            **consts,
            "FRONT_CREST": 2.0 * delta - math.pi / 2.0,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(front.intensity, log_base),
            "FRONT_FADING": front_fading(front.intensity, log_base),
        },
        uniforms=uniforms,
        inputs={"u_front_integral": TextureInput(texture="front_integral")},
        textures={"front_integral": TextureUse(front_integral_name(front.intensity, log_base), wrap="clamp_to_edge")},
        bound=bound,
    )


def _living(scene: Scene, front: FrontSaturation, decay: float, filtered: bool, bound: Bound | None) -> Contribution:
    """Foam that stays where fronts have left it."""
    total, count = waves_top(scene), len(scene.waves)
    drift = foam_drift(scene)
    shared = shares_phase(scene)
    delta, turn, _ = _CONSTANTS["text"]
    of_waves: dict[str, Uniform] = _own_waves(scene, delta, turn)
    if shared:
        of_waves = {"u_front_share": number(significant(1.0 / total))}
    weights, rates = [], []
    for wave in scene.waves:
        kx, kz = wavevector(wave, scene.water.depth)
        weights.append(wave.amplitude / total if total > 0.0 else 1.0 / count)
        # Water that drifts along with a wave meets it less often.
        rates.append(angular_frequency(wave) - kx * drift[0] - kz * drift[1])
    way = "shared" if shared else "own"
    if not carries(scene):
        way = "none"
    elif not shared:
        reaches = [(orbit(wave, scene.water.depth), wave.direction) for wave in scene.waves]
        along = [Constant(value=(significant(r * math.cos(d)), significant(r * math.sin(d)))) for r, d in reaches]
        of_waves["u_front_orbit"] = array("vec2", along, count)
    mean = max(sum(weight * rate for weight, rate in zip(weights, rates, strict=True)), LEAST_RATE)
    data: list[Constant] = []
    turns: list[Constant] = []
    phases: list[Phase] = []
    for wave, weight, rate in zip(scene.waves, weights, rates, strict=True):
        kx, kz = wavevector(wave, scene.water.depth)
        data.append(Constant(value=(kx, kz, weight, significant(rate / mean))))
        angle = 2.0 * math.pi * rate / mean
        turns.append(Constant(value=(significant(math.cos(angle)), significant(math.sin(angle)))))
        phases.append(Phase(offset=wave.phase, rate=angular_frequency(wave), k=(-kx, -kz)))
    life = significant(mean * decay)
    born = significant(front_full(front.intensity, 1.0))
    return Contribution(
        why=f"foam of {count} wave{'s' if count > 1 else ''} left by the last three fronts, {decay:g} s to 1/e",
        slots=(
            SlotFile(
                "saturation",
                "saturation/front_living.glsl",
                prefix="front",
                needs=(
                    f"saturation/front_{'shared' if shared else 'own'}.glsl",
                    "saturation/front_gate.glsl",
                    "saturation/front_seen.glsl",
                    f"saturation/way_{way}.glsl",
                ),
            ),
        ),
        consts={
            "FRONT_COUNT": count,
            "FRONT_GATED": front.group != (0.0, 0.0),
            "FRONT_FILTERED": filtered,
            "FRONT_CREST": math.pi / 2.0,
            "FRONT_BORN": born,
            "FRONT_LIFE": life,
            "FRONT_WHOLE": significant(born + life * -math.expm1((born - 2.0 * math.pi) / life)),
        },
        uniforms={
            **of_waves,
            "u_living_wave": array("vec4", data, count),
            "u_living_turn": array("vec2", turns, count),
            "u_living_phase": array("float", phases, count),
            "u_front_relief": number(significant(_relief(scene, 1.0))),
            "u_front_group": vector((front.group[0], max(front.group[1], front.group[0] + 1e-4))),
        },
        bound=bound,
    )


def _own_waves(scene: Scene, delta: float, turn: float) -> dict[str, Uniform]:
    """Wavenumbers, weights and phases of the front's own."""
    total = waves_top(scene)
    data: list[Constant] = []
    phases: list[Phase] = []
    for wave in scene.waves:
        kx, kz = (turn / (2.0 * math.pi) * k for k in wavevector(wave, scene.water.depth))
        weight = wave.amplitude / total if total > 0.0 else 1.0 / len(scene.waves)
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


EFFECT = Effect(
    "front foam",
    contribute,
    invisible=(
        Scene(foam=Foam()),
        Scene(waves=(ParametricWave(),), foam=Foam(saturation=(FrontSaturation(group=(1.0, 1.0)),), look="halftone")),
    ),
    hard_cases=(
        HardCase(
            name="the pole of every crest, C 0.25",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0, wavelength=2.0),),
                foam=Foam(saturation=(FrontSaturation(intensity=0.25),), look="halftone"),
            ),
            guard="the pole is the number 0, f = 4 on it, and the exponent is held in [-80, 80] "
            "(saturation/front_profile.glsl)",
            without="nothing on llvmpipe; f = 0 instead of 4 where the signal is (1, -0)",
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="the pole of the listing, C 100",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0, wavelength=2.0),),
                foam=Foam(saturation=(FrontSaturation(intensity=100.0, constants="listing"),), look="listing"),
            ),
            guard="the half angle's cotangent stands for the tangent (saturation/front_profile.glsl)",
            without="by the tangent: f infinite at 2 pi, and 0 instead of 4 at the pole",
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="no phase at all: waves in antiphase",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0), ParametricWave(amplitude=0.0, phase=math.pi)),
                foam=Foam(look="textured"),
            ),
            guard="0/0 taken as exponent 0 (saturation/front_profile.glsl)",
            without="6 % of samples off by more than 2 levels, by up to 133",
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="filtered, where the phase turns endlessly fast",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.0), ParametricWave(amplitude=0.0, phase=math.pi)), foam=Foam()
            ),
            guard="rho^2 at least 1e-4 in the phase's gradient, its width at most 1e4 (saturation/front_filtered.glsl)",
            without="4 % of samples flipped, off by up to 237 levels",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="a gate without width",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.3), ParametricWave(amplitude=0.3, direction=0.5)),
                foam=Foam(
                    saturation=(FrontSaturation(group=(0.5, 0.5)), HeightSaturation(base=-0.5, full=2.0)),
                    look="halftone",
                    combine="max",
                ),
            ),
            guard="the gate's end at least 1e-4 after its start (effects/foam/front.py)",
            without="smoothstep(a, a): undefined in GLSL, a bare step on llvmpipe",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="footprints from a hair to the horizon",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=0.01, wavelength=0.05),
                    ParametricWave(amplitude=0.3, wavelength=2000.0),
                ),
                foam=Foam(),
            ),
            guard="whole periods first, Gauss on short spans (saturation/front_filtered.glsl)",
            without="differences of the table on short spans: off by up to 19 levels",
            times=(0.0, 1e9),
            camera=Camera(position=(0.0, 0.8, 0.0), pitch=-0.2),
        ),
        HardCase(
            name="waves that hide their backs, an eye as high as their crests",
            scene=Scene(
                waves=(
                    ParametricWave(amplitude=0.5, wavelength=8.0, exponent=2.0),
                    ParametricWave(amplitude=0.2, wavelength=5.0, direction=0.6),
                ),
                foam=Foam(),
            ),
            guard="the fall of a ray over no relief: at least 1e-20 under it, arcs of at least 1e-5 rad "
            "(saturation/front_filtered.glsl)",
            without="nothing on llvmpipe; where neither falls nor rises anything, 0/0",
            times=(0.0, 1e9),
            camera=Camera(position=(0.37, 0.4375, -0.21), yaw=1.2, pitch=-0.05),
        ),
    ),
)
