"""Bad scenes by the thousand, to all that takes one, to a server of its own: no 500, no hang, no memory."""

import copy
import json
import random
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
import requests

from seafoam.scene import load_preset, preset_names
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


def fill(address: str, count: int) -> None:
    """Plans of good scenes, until the server's caches of plans and textures are full."""
    chance = random.Random(29)
    for number in range(count):
        scene = load_preset(preset_names()[number % len(preset_names())]).scene.model_dump(mode="json")
        for part, value in (("water", "roughness"), ("foam", "mask_tile"), ("wind", "speed")):
            if scene[part]:
                scene[part][value] *= chance.uniform(1.0, 1.1)
        body = {"scene": scene, "quality": chance.choice(("fast", "standard", "high"))}
        answer = requests.post(f"{address}/api/plans", json=body, timeout=60)
        assert answer.status_code == 200, answer.text[:500]


@pytest.mark.parametrize("least", [200, pytest.param(10_000, marks=REST)])
def test_bad_scenes_are_refused_and_cost_nothing(least: int, tmp_path: Path, report: Report) -> None:
    """Scenes of presets with something wrong, to all that takes a scene, until so many requests were bad."""
    chance = random.Random(17)
    scenes = [load_preset(name).scene.model_dump(mode="json") for name in preset_names()]
    statuses: Counter[int] = Counter()
    memory: list[tuple[int, float]] = []
    server = served(tmp_path, SEAFOAM_QUEUE="64", SEAFOAM_CACHE=str(tmp_path), SEAFOAM_MAX_SIDE="64")
    with server as (address, process), requests.Session() as session:
        # Else the first thousands would: some spoilt scenes are still good.
        fill(address, 1000 if least >= 10_000 else 0)
        while sum(number for status, number in statuses.items() if 400 <= status < 500) < least:
            path, others = chance.choice(list(SCENES.items()))
            scene = chance.choice(scenes)
            body = json.dumps(spoilt(scene if path == "/api/scenes" else {"scene": scene, **others}, chance))
            if chance.random() < 0.05:
                body = body[: chance.randrange(len(body))]
            status = session.post(address + path, body, headers=JSON, timeout=2 * HUNG).status_code
            assert status < 500 or status in (503, 504), f"{status} for {path} {body[:2000]}"
            statuses[status] += 1
            if statuses.total() % 20 == 0:
                memory.append((statuses.total(), psutil.Process(process.pid).memory_info().rss / 1e6))
        assert requests.get(f"{address}/healthz", timeout=HUNG).status_code == 200
    done, sizes = np.array(memory[len(memory) // 2 :]).T
    slope = 1000 * np.polynomial.Polynomial.fit(done, sizes, 1).convert().coef[1] if len(done) > 1 else 0.0
    assert least < 10_000 or slope < 1.0, f"{slope:.2f} MB for 1,000 requests"
    told = ", ".join(f"{number} × {status}" for status, number in sorted(statuses.items()))
    report.add("Bad scenes", statuses=told, memory=f"{sizes[-1]:.0f} MB", growth=f"{slope:+.2f} MB for 1,000")
