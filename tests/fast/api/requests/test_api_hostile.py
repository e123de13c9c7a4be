"""Bad scenes by the thousand, to all that takes one, to a server of its own: no 500, no hang, no memory."""

import copy
import json
import random
import time
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
import requests

from seafoam.scene.presets import load_preset, preset_names
from support.report import Report
from support.serving import served
from support.sweep import REST

HUNG = 20.0
"""Seconds; the server's deadline for a frame is ten."""
SCENES = {
    "/api/scenes": {},
    "/api/plans": {"quality": "fast"},
    "/api/frames": {"quality": "fast", "time": 1.0, "width": 16, "height": 16, "format": "png"},
    "/api/export": {"quality": "fast"},
    "/api/streams": {"quality": "fast"},
    "/api/sequences": {"stop": 0.1, "width": 16, "height": 16, "quality": "fast", "format": "zip"},
}
"""Bodies that hold a whole scene, which is what is made bad in them: random ones take seconds each to make."""
JSON = {"Content-Type": "application/json"}
WRONG: list[Any] = [
    None, True, -1, 0, 1e308, -1e308, 1e-320, 2**70, "", "x" * 5000, "\x00", "../../etc/passwd", "💧", [], {},
    [[]] * 50, {"model": "tsunami"}, "NaN", "Infinity", float("nan"), float("inf"),
]  # fmt: skip


def spoilt(document: Any, chance: random.Random) -> Any:
    """The document with one of its values made wrong, removed, or joined by one that nobody knows."""
    result = copy.deepcopy(document)
    inner: Any = result
    while True:
        keys = list(inner) if isinstance(inner, dict) else list(range(len(inner)))
        if not keys:
            break
        key = chance.choice(keys)
        if isinstance(inner[key], dict | list) and inner[key] and chance.random() < 0.8:
            inner = inner[key]
            continue
        match chance.randrange(6):
            case 0:
                del inner[key]
            case 1 if isinstance(inner, dict):
                inner["unknown"] = chance.choice(WRONG)
            case _:
                inner[key] = chance.choice(WRONG)
        break
    return result


class Judge:
    """Sends requests, counts how they end, and watches the server's memory."""

    def __init__(self, address: str, pid: int) -> None:
        self.address = address
        self.process = psutil.Process(pid)
        self.statuses: Counter[int] = Counter()
        self.slowest = 0.0
        self.memory: list[tuple[int, float]] = []

    @property
    def bad(self) -> int:
        """Requests that were refused as bad."""
        return sum(number for status, number in self.statuses.items() if 400 <= status < 500)

    def note(self, ask: Callable[[], Any], what: str) -> None:
        began = time.perf_counter()
        status = ask().status_code
        seconds = time.perf_counter() - began
        assert status < 500 or status in (503, 504), f"{status} for {what[:2000]}"
        self.statuses[status] += 1
        self.slowest = max(self.slowest, seconds)
        done = sum(self.statuses.values())
        if done % 20 == 0:
            self.memory.append((done, self.process.memory_info().rss / 1e6))

    def fill(self, count: int) -> None:
        """Plans of good scenes, until the server's caches of plans and textures are full."""
        chance = random.Random(29)
        with requests.Session() as session:
            for number in range(count):
                scene = load_preset(preset_names()[number % len(preset_names())]).scene.model_dump(mode="json")
                for part, value in (("water", "roughness"), ("foam", "mask_tile"), ("wind", "speed")):
                    if scene[part]:
                        scene[part][value] *= chance.uniform(1.0, 1.1)
                quality = chance.choice(("fast", "standard", "high"))
                answer = session.post(
                    f"{self.address}/api/plans", json={"scene": scene, "quality": quality}, timeout=60
                )
                assert answer.status_code == 200, answer.text[:500]

    def scenes(self, until: int) -> None:
        """Scenes of presets with something wrong, to all that takes a scene, until so many requests were bad."""
        chance = random.Random(17)
        scenes = [load_preset(name).scene.model_dump(mode="json") for name in preset_names()]
        with requests.Session() as session:
            while self.bad < until:
                path, others = chance.choice(list(SCENES.items()))
                scene = chance.choice(scenes)
                whole = scene if path == "/api/scenes" else {"scene": scene, **others}
                body = json.dumps(spoilt(whole, chance))
                if chance.random() < 0.05:
                    body = body[: chance.randrange(len(body))]
                send = partial(session.post, self.address + path, body, headers=JSON, timeout=2 * HUNG)
                self.note(send, f"{path} {body}")


@pytest.mark.parametrize("least", [200, pytest.param(10_000, marks=REST)])
def test_bad_scenes_are_refused_and_cost_nothing(least: int, tmp_path: Path, report: Report) -> None:
    with served(tmp_path, SEAFOAM_QUEUE="64", SEAFOAM_CACHE=str(tmp_path), SEAFOAM_MAX_SIDE="64") as (address, process):
        judge = Judge(address, process.pid)
        # Else the first thousands would: some spoilt scenes are still good.
        judge.fill(1000 if least >= 10_000 else 0)
        judge.scenes(until=least)
        assert requests.get(f"{address}/healthz", timeout=HUNG).status_code == 200
    done, sizes = np.array(judge.memory[len(judge.memory) // 2 :]).T
    slope = 1000 * np.polynomial.Polynomial.fit(done, sizes, 1).convert().coef[1] if len(done) > 1 else 0.0
    assert judge.bad >= least
    assert least < 10_000 or slope < 1.0, f"{slope:.2f} MB for 1,000 requests"
    report.add(
        "Bad scenes",
        requests=f"{sum(judge.statuses.values())}",
        refused=f"{judge.bad}",
        statuses=", ".join(f"{number} × {status}" for status, number in sorted(judge.statuses.items())),
        slowest=f"{judge.slowest:.2f} s",
        memory=f"{sizes[-1]:.0f} MB",
        growth=f"{slope:+.2f} MB for 1,000",
    )
