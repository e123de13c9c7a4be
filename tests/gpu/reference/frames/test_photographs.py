"""The open sea as photographed from a ship: drawn foam, and what AWE counts, against the law of the wind."""

import numpy as np
import pytest
from docs.make_whitecaps import FOV, PITCH, QUALITY, seascape, spread

from seafoam.ocean.waves.cascades import LOOP
from seafoam.planner import make_plan
from seafoam.render.gl.executor import Executor
from support.pictures import draw
from support.report import Report
from support.scenes import Camera
from support.sweep import crossed

HEIGHT = 200.0
"""Of an aeroplane, m: a photograph from a ship holds so few whitecaps that hundreds of them are needed
(``docs/make_whitecaps.py --photographs``), one from here forty times the sea."""
FRAMES, SEAS = 32, 8
SURE = 0.08
"""Standard error of the mean: under half of the bound, so that it is not chance that passes."""


@pytest.mark.parametrize(("wind", "own"), crossed([10.0, 15.0], [False, True], 2))
def test_a_photograph_holds_what_the_wind_raises(executor: Executor, report: Report, wind: float, own: bool) -> None:
    """Within 20 % of Monahan and O'Muircheartaigh (1980): foam of the last 3 s, and the preset's that lasts; unlit."""
    random = np.random.default_rng(2)
    drawn = []
    for seed in range(SEAS):
        yaw = float(random.uniform(-3.0, 3.0))
        scene = seascape(wind, 300 + seed, yaw, own=own).model_copy(update={"light": None})
        plan = make_plan(scene, QUALITY)
        for _ in range(FRAMES // SEAS):
            x, z, time = (float(value) for value in random.uniform((-2e3, -2e3, 0.0), (2e3, 2e3, LOOP)))
            camera = Camera(position=(x, HEIGHT, z), pitch=PITCH, yaw=yaw, fov=FOV)
            frame = draw(executor, plan, camera, time=time, size=(256, 192), output="linear")
            drawn.append(float(frame[..., 3].mean(dtype=np.float64)))
    law = 3.84e-6 * wind**3.41
    sure = spread(drawn)
    report.add(
        "Whitecaps in photographs from 200 m",
        foam="lasting" if own else "of the last 3 s",
        wind=f"{wind:g} m/s",
        law=f"{100 * law:.3f} %",
        drawn=f"{100 * np.mean(drawn):.3f} %",
        sure_to=f"{100 * sure:.0f} %",
    )
    assert sure <= SURE
    assert abs(np.mean(drawn) / law - 1.0) <= 0.2
