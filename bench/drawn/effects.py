"""Cost of each effect alone, switched on in the default scene, in ms and as a share of the frame."""

from bench.drawn.economy import QUALITY, SIZE
from bench.drawn.frames import side_by_side
from bench.drawn.isolation import switch
from bench.report import Column, Spread, Table, count, ms
from bench.watch import Watch
from seafoam.effects import EFFECTS
from seafoam.planner import make_plan
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset

PRESET = "default"


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Draw the default scene with and without each effect, side by side."""
    scene = load_preset(PRESET).scene
    rows = []
    for effect in EFFECTS:
        found = switch(effect, scene, QUALITY)
        if found is None:
            raise RuntimeError(f"no preset and no hard case switches {effect.name} on in the default scene")
        plans = {"on": make_plan(found.on, QUALITY), "off": make_plan(found.off, QUALITY)}
        rounds = watch.rounds(f"{effect.name}, alone", 21, 8.0, least=3)
        costs = side_by_side(executor, plans, scene.camera, SIZE, rounds)
        pairs = list(zip(costs["on"], costs["off"], strict=True))
        rows.append(
            (
                effect.name,
                ", ".join(found.fields) + (" emptied" if found.given else ""),
                ", ".join((*found.needs, *found.others)),
                Spread.of([on.cpu - off.cpu for on, off in pairs]),
                Spread.of([on.wall - off.wall for on, off in pairs]),
                Spread.of([1.0 - off.cpu / on.cpu for on, off in pairs]),
                len(plans["on"].passes) - len(plans["off"].passes),
                len(pairs),
            )
        )
    return [
        Table(
            "Each effect alone",
            f"Preset {PRESET} with the effect and without it, {SIZE[0]} x {SIZE[1]}, quality standard; medians of "
            "per-round differences (interquartile range). Switch: the field that differs; emptied: of an effect that "
            "the scene itself has. Besides: fields that it needs, which both frames have, and effects that come or go "
            "with it. Share: of the frame that has it, processor time. Passes: what it draws beside the surface.",
            (
                Column("effect", "effect"),
                Column("switch", "switch"),
                Column("others", "besides"),
                Column("cpu", "processor, ms", _added),
                Column("wall", "wall, ms", _added),
                Column("share", "share of the frame", _share),
                Column("passes", "passes", lambda passes: f"{passes:+d}" if passes else "0"),
                Column("rounds", "rounds", count),
            ),
            rows,
        )
    ]


def _added(seconds: Spread) -> str:
    low, high = _signed(seconds.low), _signed(seconds.high)
    return f"{_signed(seconds.median)}  ({low} to {high})"


def _signed(seconds: float) -> str:
    return f"{'-' if seconds < 0.0 else '+'}{ms(abs(seconds))}"


def _share(share: Spread) -> str:
    low, high = 100.0 * share.low, 100.0 * share.high
    return f"{100.0 * share.median:.1f} %  ({low:.1f} to {high:.1f})"
