"""Cost of octaves, milky water and foam's history in the filtered look: frame time, and GPU instructions."""

from dataclasses import dataclass
from statistics import median

from bench.compiler import Use, compiled, missing
from bench.drawn.frames import SIZE, ratios, side_by_side
from bench.report import Column, Table, count, extra, ms, percent, ratio_columns
from bench.watch import Watch
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import Foam, Scene, load_preset

PRESETS = ("default", "storm", "island-surf")


LIVES = ("", "left", "carried", "of its age", "thick")
"""Steps of the foam's history, each added to all before it."""
_STILL = {"front": {"decay": None, "variation": 0.0}, "whitecap": {"lasting": False}, "surf": {"line": 0.0}}
"""By source of foam: values of the fields by which it ages or decays, with which it does not."""


def lying_still(foam: Foam) -> Foam:
    """The same foam without what becomes of it after its birth: born anew at each moment, uncarried, flat."""
    made = tuple(one.model_copy(update=_STILL.get(one.source, {})) for one in foam.saturation)
    return foam.model_copy(update={"saturation": made, "life": None, "thickness": 0.0})


@dataclass(frozen=True)
class Variant:
    """A variant of a preset's foam: number of octaves, water clear or milky as in the preset, and its history."""

    octaves: int
    milky: bool
    life: str = ""

    def of(self, scene: Scene) -> Scene:
        """The scene in this variant."""
        assert scene.foam is not None
        lives = LIVES.index(self.life)
        foam = scene.foam if lives else lying_still(scene.foam)
        life = foam.life if lives > 1 else None
        if life is not None and lives == 2:
            life = life.model_copy(update={"masks": (), "windrows": 0.0})
        thickness = foam.thickness if lives == 4 else 0.0
        foam = foam.model_copy(update={"octaves": self.octaves, "life": life, "thickness": thickness})
        water = scene.water if self.milky else scene.water.model_copy(update={"aeration": 0.0})
        return scene.model_copy(update={"foam": foam, "water": water})

    def __str__(self) -> str:
        octaves = f"{self.octaves} {'octave' if self.octaves == 1 else 'octaves'}{', milky' if self.milky else ''}"
        return f"{octaves}, {self.life}" if self.life else octaves


BASE = Variant(1, False)
VARIANTS = (
    BASE,
    Variant(2, False),
    Variant(4, False),
    Variant(1, True),
    Variant(2, True),
    Variant(4, True),
    *(Variant(4, True, life) for life in LIVES[1:]),
)


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Draw presets with one, two and four octaves, in clear and in milky water, and with foam's history."""
    quality = TIERS["standard"].model_copy(update={"foam_relief": True})
    plans = {
        name: {variant: make_plan(variant.of(load_preset(name).scene), quality) for variant in VARIANTS}
        for name in PRESETS
    }
    uses = {
        (name, variant): (Use(name, str(variant), "surface"), plan.programs["surface"])
        for name, by in plans.items()
        for variant, plan in by.items()
    }
    figures = {} if missing() else compiled(dict(uses.values())).figures
    rows = []
    for name, by in plans.items():
        rounds = watch.rounds(f"octaves, {name}", 15, 20.0, least=3)
        costs = side_by_side(executor, by, load_preset(name).scene.camera, SIZE, rounds)
        base = figures.get(str(uses[name, BASE][0]))
        for variant, taken in costs.items():
            compiled_to = figures.get(str(uses[name, variant][0]))
            rows.append(
                (
                    name,
                    str(variant),
                    *ratios(taken, costs[BASE]),
                    median(cost.cpu for cost in taken),
                    len(taken),
                    compiled_to.instructions if compiled_to else None,
                    compiled_to.instructions / base.instructions - 1.0 if compiled_to and base else None,
                    compiled_to.vgprs if compiled_to else None,
                )
            )
    return [
        Table(
            "Octaves, milky water and foam that lives",
            f"Frames of {SIZE[0]} x {SIZE[1]}, quality standard with foam_relief, against one octave in clear water, "
            "lying still; medians of per-round ratios (interquartile range). Left on the water or the sand; also "
            "carried; also of its age and in rows; also with a thickness. Instructions and VGPR: of the surface's "
            "program, by a GPU's compiler.",
            (
                Column("preset", "preset"),
                Column("foam", "foam"),
                *ratio_columns(extra),
                Column("cpu", "processor, ms", ms),
                Column("rounds", "rounds", count),
                Column("instructions", "instructions", count),
                Column("more", "more", percent),
                Column("vgprs", "VGPR", count),
            ),
            rows,
        )
    ]
