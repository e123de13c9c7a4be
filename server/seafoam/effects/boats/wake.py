"""The waves of boats' wakes: from a map drawn each frame, or computed at each sample. docs/formulae.md, section 15."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from seafoam.effects.boats.boat import COURSE
from seafoam.effects.bounds import BLOCK
from seafoam.effects.effect import Bound, Contribution, PassSpec, QualityParameter, Resources, drawn_map, part_effect
from seafoam.effects.shader import Inline, Piece, SlotFile, Source
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import constants, number, rounded, significant
from seafoam.ocean.waves.wakes import NEAR, Wake, joint_height, joint_slope, wakes
from seafoam.quality import Quality
from seafoam.sums import summed

T = TypeVar("T")
ASIDE = 0.36
"""Width of a wake to each side over its length: slightly more than Kelvin's tan 19.47 degrees."""
AWAY = (0, 2, 4, 8)
"""Distances from a boat's middle, in boat lengths, from which on a bound of the wake's curvature is given: the
curvature is greatest at the bow, where the window fades the wake in."""
WAY = (COURSE, "boats/wake.glsl@way")
_PATTERN = "boats/wake.glsl@pattern"


@dataclass(frozen=True)
class WakeKind:
    """A kind of wakes: what makes them, and where on them a place is.

    ``name``: of targets and programs; ``prefix``: of the GLSL functions; ``places``: files that say where on a wake a
    point is. ``rename``: pairs of names in the files of boats' wakes, so that two kinds can be in a shader.
    """

    name: str
    prefix: str
    title: str
    still: str
    """Why there are no waves."""
    places: tuple[Piece, ...]
    declared: str
    """File of the bounds that are declared."""
    measured: str
    """Of those of the map."""
    bounds_need: tuple[Piece, ...] = ()
    gentler: str = ""
    """File of the rays that meet smaller slopes than the bound, or none; only for wakes with a map."""
    rename: tuple[tuple[str, str], ...] = ()

    def file(self, path: str) -> Piece:
        """A file of boats' wakes, for this kind."""
        return Source(path, self.rename) if self.rename else path

    def renamed(self, values: Mapping[str, T]) -> dict[str, T]:
        """Values by the names that this kind has for those of boats' wakes."""
        names = dict(self.rename)
        return {names.get(name, name): value for name, value in values.items()}


_BOUNDS = ("boats/wake_bounds.glsl@declared", "boats/wake_bounds.glsl@measured")
BOATS = WakeKind("wake", "wakes", "wakes", "no boat moves, or none makes waves", WAY, *_BOUNDS)


def wakes_of(kind: WakeKind, patterns: Sequence[Wake], quality: Quality) -> Contribution:
    mapped = quality.wake == "map"
    height = joint_height(patterns)
    map_error = significant(summed(wake.map_error(wake.length / quality.wake_size) for wake in patterns))
    # Wavenumber (rad/m), amplitude (m; 0: none), length (m), cut-off (rad/m); and the maker.
    forms = [(significant(of.k), of.boat.wake * of.shows, *rounded((of.length, of.shortest))) for of in patterns]
    makers = [(of.boat.length, of.boat.radius) for of in patterns]
    contribution = Contribution(
        why=f"{kind.title} up to {height:.2g} m high",
        slots=_slots(kind, mapped=mapped),
        consts={"WAKE_SIZE": quality.wake_size, "WAKE_ASIDE": ASIDE, "WAKE_NEAR": NEAR, "WAKE_AWAY": AWAY},
        uniforms=kind.renamed({"u_wake": constants("vec4", forms), "u_wake_boat": constants("vec2", makers)}),
        bound=Bound.zero_if(height == 0.0, kind.still),
        max_height=height,
        min_height=-height,
        max_slope=joint_slope(patterns),
        max_curvature=summed(significant(wake.curvature[0]) for wake in patterns),
        map_error=map_error if mapped else 0.0,
        march_factor=2,
    )
    if mapped:
        return contribution.joined(_map(kind, len(patterns), quality.wake_size))
    # No map is measured for the bounds of exact wakes.
    bounds = constants("vec3", [(significant(wake.max_slope), *map(significant, wake.curvature)) for wake in patterns])
    uniforms = kind.renamed({"u_wake_highest": number(height), "u_wake_bounds": bounds})
    return contribution.joined(Resources(uniforms=uniforms))


def _slots(kind: WakeKind, *, mapped: bool) -> tuple[SlotFile, ...]:
    """Waves and bounds. The pattern itself is the same for all kinds."""
    file = kind.file("boats/wake.glsl@map" if mapped else "boats/wake.glsl@exact")
    needs = (*kind.places, file) if mapped else (*kind.places, _PATTERN, file)
    bounds = kind.measured if mapped else kind.declared
    gentler = (SlotFile("gentler", kind.gentler, prefix=kind.prefix, needs=kind.bounds_need),)
    return (
        SlotFile("waves", kind.file("boats/wake.glsl@waves"), prefix=kind.prefix, needs=needs),
        SlotFile("bounds", bounds, prefix=kind.prefix, needs=kind.bounds_need),
        *(gentler if mapped and kind.gentler else ()),
    )


def _map(kind: WakeKind, count: int, size: int) -> Resources:
    name, form = kind.name, kind.file("boats/wake.glsl@form")
    blocks = FixedSize(width=size // BLOCK, height=size // 2 // BLOCK * count)
    of_map = ("lib/numbers.glsl", form, _PATTERN, kind.file("boats/wake.glsl@map_pass"))
    along = PassSpec(f"{kind.title}, {size} texels along", name, of_map)
    sizes, title = Inline(f"const int BOUNDS_BLOCK = {BLOCK};\n"), f"{kind.title}, greatest of"
    files = (sizes, form, kind.file("boats/wake_bounds.glsl@blocks"))
    of_blocks = PassSpec(f"{title} blocks", f"{name}_blocks", files, kind.renamed({"u_wake_map": name}))
    join, read = (form, kind.file("boats/wake_bounds.glsl@join")), kind.renamed({"u_wake_blocks": f"{name}_blocks"})
    of_all = PassSpec(f"{title} all", f"{name}_bounds", join, read)
    map_size, bounds_size = FixedSize(width=size, height=size // 2 * count), FixedSize(width=len(AWAY), height=count)
    return drawn_map(along, Target(size=map_size, format="RGBA16F", filter="linear")).joined(
        drawn_map(of_blocks, Target(size=blocks, format="RGBA16F")),
        drawn_map(of_all, Target(size=bounds_size, format="RGBA16F")),
        Resources(inputs=kind.renamed({"u_wake_map": name, "u_wake_bounds": f"{name}_bounds"})),
    )


EFFECT = part_effect(
    "wakes",
    lambda scene, boats, quality: wakes_of(BOATS, wakes(boats), quality),
    "/boats",
    QualityParameter("/wake", "wakes", ("map", "exact"), "geometry"),
    QualityParameter("/wake_size", "texels of the wake map", (128, 256, 512, 1024), "geometry"),
    fields=("/boats/wake",),
)
