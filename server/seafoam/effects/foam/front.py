"""Foam saturation from the wave's front (Yingst, Alford and Parberry 2011). docs/formulae.md, section 4."""

import math
from dataclasses import replace

from seafoam.effects.bounds import SATURATION_CAP, parametric_wave_height
from seafoam.effects.effect import Bound, Contribution, Resources, SaturationSource, TextureUse, foam_effect
from seafoam.effects.shader import PERLIN_3, Piece, SlotFile, drifting_noise
from seafoam.effects.waves.parametric import front_files, profile_square, scaled_files, shares_phase
from seafoam.framegraph.rules import Phase, Uniform, array, constants, number, rounded, significant, vector
from seafoam.ocean.basics.dispersion import angular_frequency, wavevector
from seafoam.ocean.waves.groups import group_velocity
from seafoam.ocean.waves.stokes import foam_drift, follows_orbits, orbit
from seafoam.quality import Quality
from seafoam.scene import Foam, FrontSaturation, Scene
from seafoam.sums import summed
from seafoam.textures.waves import FRONT_NODES, FrontIntegral, front_fading, front_full

PATCH_CHANGE = 25.0
"""Time in which the patches of a front change, s."""
LEAST_RATE = 1e-3
"""Least mean frequency of the waves as drifting water meets them, rad/s."""
_SEED = 64 * 91


_CONSTANTS = {"text": (math.pi / 2.0, 2.0 * math.pi, 1.0), "listing": (1.07, 6.28, math.log(2.718))}
"""Of the published text and of its listing: the offset of the phase, rad; the number in place of 2π in the wavenumbers;
the natural logarithm of the base of the profile."""


def draw(scene: Scene, foam: Foam, front: FrontSaturation, quality: Quality) -> Contribution:
    if not scene.waves:
        return Contribution.invisible("no wave, so no front")
    out_of_reach = "the group's threshold is above the greatest possible sum of the waves"
    bound = Bound.zero_if(front_limit(front, scene) == 0.0, out_of_reach)
    filtered = foam.look == "filtered"
    if front.decay is not None:
        contribution = _decaying(scene, front, front.decay, filtered=filtered)
    else:
        contribution = _present(scene, front, f"{foam.pointer(front)}/intensity", filtered=filtered)
    return replace(contribution, bound=bound)


def _present(scene: Scene, front: FrontSaturation, pointer: str, *, filtered: bool) -> Contribution:
    """Foam of the fronts that there are: where they are, or averaged over footprints by a table of its integral."""
    delta, turn, log_base = _CONSTANTS[front.constants]
    needs = (*_phase_files(scene), "foam/saturation/front.glsl@gate", "foam/saturation/front.glsl@profile")
    plain = SlotFile("saturation", "foam/saturation/front.glsl@plain", prefix="front", needs=needs)
    present = Contribution(
        why=f"front saturation of {_waves(scene)}, constants of the {front.constants}",
        slots=() if filtered else (plain,),
        consts={"FRONT_COUNT": len(scene.waves), "FRONT_GATED": _gated(front)},
        uniforms={
            **_phase_uniforms(scene, front.constants),
            "u_front_log_base": number(log_base),
            "u_front_group": _group(front),
            # The table contains the intensity too, so that the uniform cannot change alone.
            "u_front_intensity": number(front.intensity, None if filtered else pointer),
        },
    )
    if not filtered:
        return present
    seen = (*needs, "foam/saturation/front.glsl@seen")
    integral = FrontIntegral(intensity=front.intensity, log_base=log_base)
    averaged = Resources(
        slots=(SlotFile("saturation", "foam/saturation/front.glsl@filtered", prefix="front", needs=seen),),
        consts={
            "FRONT_CREST": 2.0 * delta - math.pi / 2.0,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(front.intensity, log_base),
            "FRONT_FADING": front_fading(front.intensity, log_base),
        },
        uniforms={"u_front_relief": number(significant(_relief(scene, turn / (2.0 * math.pi))))},
        textures={"front_integral": TextureUse(integral, wrap="clamp_to_edge")},
    )
    return replace(present, why=f"{present.why}, averaged over footprints").joined(averaged)


def _decaying(scene: Scene, front: FrontSaturation, decay: float, *, filtered: bool) -> Contribution:
    """Foam that remains where fronts have left it, and decays to 1/e in ``decay`` s."""
    shared, drift = shares_phase(scene), foam_drift(scene)
    waves, mean_rate = _past_waves(scene, shared)
    orbits: tuple[Piece, ...] = ("foam/saturation/front.glsl@way_none",)
    if follows_orbits(scene):
        own = scaled_files(scene, "foam/saturation/front.glsl@way_own", "waves/groups.glsl@way")
        orbits = ("foam/saturation/front.glsl@way_shared",) if shared else own
    # Horizontal amplitude of each wave's orbits, as a vector along its heading, m.
    orbit_of = [(orbit(wave, scene.water.depth), wave.direction) for wave in scene.waves]
    # The way of a group of waves past water that drifts, m/rad of the waves' mean phase.
    ways = [(part - past) / mean_rate for part, past in zip(group_velocity(scene), drift, strict=True)]
    life = significant(mean_rate * decay)
    born = significant(front_full(front.intensity, 1.0))
    patchy = front.variation > 0.0 and _gated(front)
    gate = ("foam/saturation/front.glsl@gate", "foam/saturation/front.glsl@seen")
    needs: tuple[Piece, ...] = (*_phase_files(scene), *front_files(scene), *gate, *orbits)
    patches = (*PERLIN_3, "foam/saturation/front.glsl@patches") if patchy else ("foam/saturation/front.glsl@even",)
    # The noise of the patches drifts as foam does.
    speed, heading = math.hypot(*drift), math.atan2(drift[1], drift[0])
    return Contribution(
        why=f"foam of {_waves(scene)} left by the last three fronts, {decay:g} s to 1/e",
        slots=(SlotFile("saturation", "foam/saturation/front.glsl@living", prefix="front", needs=(*needs, *patches)),),
        consts={
            "FRONT_COUNT": len(waves),
            "FRONT_GATED": _gated(front),
            "FRONT_FILTERED": filtered,
            "FRONT_CREST": math.pi / 2.0,
            "FRONT_BORN": born,
            "FRONT_LIFE": life,
            "FRONT_SEED": _SEED,
            "FRONT_WHOLE": significant(born + life * -math.expm1((born - 2.0 * math.pi) / life)),
        },
        uniforms={
            **_phase_uniforms(scene, "text"),
            "u_front_orbit": constants("vec2", (rounded((r * math.cos(d), r * math.sin(d))) for r, d in orbit_of)),
            "u_front_advance": vector(rounded(ways)),
            "u_living": constants("vec4", waves),
            "u_front_relief": number(significant(_relief(scene, 1.0))),
            "u_front_group": _group(front),
            "u_front_patch_phase": drifting_noise(front.variation_size, speed, heading, PATCH_CHANGE),
            "u_front_patch": vector(rounded((front.variation_size, front.variation))),
        },
    )


def _waves(scene: Scene) -> str:
    return f"{len(scene.waves)} wave{'s' if len(scene.waves) > 1 else ''}"


def _phase_files(scene: Scene) -> tuple[Piece, ...]:
    """The files that give the phase of the waves' sum: shared with the surface, or evaluated for the front."""
    if shares_phase(scene):
        return ("foam/saturation/front.glsl@shared",)
    return scaled_files(scene, "foam/saturation/front.glsl@own", "waves/groups.glsl@signal")


def _gated(front: FrontSaturation) -> bool:
    return front.group != (0.0, 0.0)


def _group(front: FrontSaturation) -> Uniform:
    return vector((front.group[0], max(front.group[1], front.group[0] + 1e-4)))


def _phase_uniforms(scene: Scene, published: str) -> dict[str, Uniform]:
    """What determines the phase of the waves' sum: all if the front has phases of its own, else one factor."""
    if shares_phase(scene):
        return {"u_front_share": number(significant(1.0 / parametric_wave_height(scene)))}
    delta, turn, _ = _CONSTANTS[published]
    waves: list[tuple[float, ...]] = []
    phases: list[Phase] = []
    for wave, weight in zip(scene.waves, _weights(scene), strict=True):
        kx, kz = (turn / (2.0 * math.pi) * k for k in wavevector(wave, scene.water.depth))
        waves.append((kx, kz, weight, 0.0))
        offset = wave.phase + (2.0 * delta - math.pi)
        phases.append(Phase(offset=offset, rate=angular_frequency(wave), k=(-kx, -kz)))
    return {"u_front_wave": constants("vec4", waves), "u_front_phase": array("float", phases, len(waves))}


def _past_waves(scene: Scene, shared: bool) -> tuple[list[tuple[float, ...]], float]:
    """Of each wave: q = frequency over the mean, cos and sin of 2πq, and its weight; and the mean frequency, rad/s.

    Frequencies are those that drifting water meets: it meets a wave less often that it drifts along with. ``shared``:
    only waves of the surface, whose amplitude is above 0.
    """
    drift, weights = foam_drift(scene), _weights(scene)
    vectors = [wavevector(wave, scene.water.depth) for wave in scene.waves]
    met = zip(scene.waves, vectors, strict=True)
    rates = [angular_frequency(wave) - kx * drift[0] - kz * drift[1] for wave, (kx, kz) in met]
    mean = max(summed(weight * rate for weight, rate in zip(weights, rates, strict=True)), LEAST_RATE)
    waves = [
        (*rounded((rate / mean, math.cos(2.0 * math.pi * rate / mean), math.sin(2.0 * math.pi * rate / mean))), weight)
        for wave, weight, rate in zip(scene.waves, weights, rates, strict=True)
        if wave.amplitude > 0.0 or not shared
    ]
    return waves, mean


def _weights(scene: Scene) -> list[float]:
    """Each wave's amplitude over the sum of all amplitudes; equal weights if that sum is 0."""
    total = parametric_wave_height(scene)
    return [wave.amplitude / total if total > 0.0 else 1.0 / len(scene.waves) for wave in scene.waves]


def _relief(scene: Scene, spatial: float) -> float:
    """Slope amplitude of a sinusoid with the mean square slope of all waves, their wavenumbers times ``spatial``."""
    slopes = (spatial * math.hypot(*wavevector(wave, scene.water.depth)) * wave.amplitude for wave in scene.waves)
    squares = (profile_square(wave.exponent) for wave in scene.waves)
    return math.sqrt(2.0 * summed(slope**2 * square for slope, square in zip(slopes, squares, strict=True)))


def front_limit(front: FrontSaturation, scene: Scene) -> float:
    """Return the greatest front saturation: the limit, which every front reaches, or 0 if the group threshold is 1."""
    return SATURATION_CAP if scene.waves and (front.group[0] < 1.0 or front.variation > 0.0) else 0.0


EFFECT = foam_effect("front foam", draw, SaturationSource(FrontSaturation, front_limit), afloat=("u_front_phase",))
