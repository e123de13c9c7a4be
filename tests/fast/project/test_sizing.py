"""docs/sizing.py against a simulation of the queue, event by event, and against values from the literature."""

import heapq
import math
import re
from pathlib import Path

import numpy as np
import pytest
from docs.sizing import Queue, erlang_b, measured_times, moments, renders, workers_for

TOLERANCE = 0.12
"""Of mean waits and of shares: the correction is an approximation, and 200,000 requests are a sample."""
REQUESTS = 200_000


def simulate(queue: Queue, services: np.ndarray, seed: int, *, bounded: bool) -> tuple[np.ndarray, float]:
    """Waits of the admitted requests, s, and the share of refused ones; first come, first served."""
    random = np.random.default_rng(seed)
    arrivals = np.cumsum(random.exponential(1.0 / queue.rate, len(services)))
    free = [0.0] * queue.workers
    starts: list[float] = []
    waits, refused = [], 0
    for arrival, service in zip(arrivals.tolist(), services.tolist(), strict=True):
        if bounded:
            while starts and starts[0] <= arrival:
                heapq.heappop(starts)
            if len(starts) >= queue.room and free[0] > arrival:
                refused += 1
                continue
        start = max(arrival, free[0])
        heapq.heapreplace(free, start + service)
        if start > arrival:
            heapq.heappush(starts, start)
        waits.append(start - arrival)
    return np.array(waits), refused / len(services)


def drawn(kind: str, mean: float, seed: int) -> tuple[np.ndarray, float]:
    """Frame times of a kind, s, and their squared coefficient of variation."""
    random = np.random.default_rng(seed)
    match kind:
        case "exponential":
            return random.exponential(mean, REQUESTS), 1.0
        case "one preset":
            return np.full(REQUESTS, mean), 0.0
        case _:
            times = np.array(measured_times())
            return random.choice(times * (mean / times.mean()), REQUESTS), moments(list(times))[1]


def test_erlang_b_is_that_of_the_tables() -> None:
    for workers, offered, blocked in ((1, 1.0, 0.5), (5, 3.0, 0.110), (10, 5.0, 0.0184), (20, 12.0, 0.0098)):
        assert erlang_b(workers, offered) == pytest.approx(blocked, rel=0.01)


def test_one_worker_is_pollaczek_and_khinchine_and_at_full_load_nothing_is_promised() -> None:
    queue = Queue(1, rate=2.0, service=0.3, variation=0.5, room=2)
    assert queue.delayed == pytest.approx(0.6)
    assert queue.mean_wait == pytest.approx(2.0 * 0.3**2 * 1.5 / (2.0 * (1.0 - 0.6)))
    queue = Queue(2, 10.0, 0.25, 1.0, 4)
    assert (queue.delayed, queue.mean_wait) == (1.0, math.inf)
    assert queue.refused > 0.2


@pytest.mark.parametrize("kind", ["exponential", "one preset", "all presets"])
@pytest.mark.parametrize(("workers", "load"), [(1, 0.7), (4, 0.8), (16, 0.9)])
def test_waits_are_those_of_the_simulation(kind: str, workers: int, load: float) -> None:
    services, variation = drawn(kind, 0.25, seed=1)
    queue = Queue(workers, load * workers / 0.25, 0.25, variation, 2 * workers)
    waits, _ = simulate(queue, services, seed=2, bounded=False)
    assert waits.mean() == pytest.approx(queue.mean_wait, rel=TOLERANCE)
    assert np.mean(waits > 0.0) == pytest.approx(queue.delayed, rel=TOLERANCE)
    if kind == "exponential":
        assert np.mean(waits > 0.25) == pytest.approx(queue.waits_beyond(0.25), rel=TOLERANCE)


@pytest.mark.parametrize(("workers", "load"), [(1, 0.8), (4, 1.0), (4, 2.0)])
def test_refusals_are_those_of_the_simulation(workers: int, load: float) -> None:
    services, _ = drawn("exponential", 0.25, seed=3)
    queue = Queue(workers, load * workers / 0.25, 0.25, 1.0, 2 * workers)
    assert simulate(queue, services, seed=4, bounded=True)[1] == pytest.approx(queue.refused, rel=TOLERANCE)
    # Frame times of presets vary less, so fewer are refused.
    services, variation = drawn("all presets", 0.25, seed=3)
    assert variation < 1.0
    assert simulate(queue, services, seed=4, bounded=True)[1] <= queue.refused * (1.0 + TOLERANCE)


def test_workers_are_the_fewest_that_do() -> None:
    queue = workers_for(70.0, 0.25, 0.5)
    fewer = Queue(queue.workers - 1, 70.0, 0.25, 0.5, 2 * queue.workers - 2)
    assert queue.refused <= 1e-3
    assert queue.waits_beyond(1.0) <= 0.01
    assert fewer.refused > 1e-3 or fewer.waits_beyond(1.0) > 0.01


def test_the_documents_table_is_what_the_module_says() -> None:
    text = (Path(__file__).parents[3] / "docs" / "operations.md").read_text(encoding="utf-8")
    rows = re.findall(r"(?m)^\| ([\d,]+) \| (\d+) % \| ([\d.]+) \| (\d+) \| (\d+) % \|", text)
    assert len(rows) == 9
    service, variation = moments(measured_times())
    for visitors, hits, rate, workers, busy in rows:
        queue = workers_for(renders(float(visitors.replace(",", "")), 5.0, 0.01 * int(hits)), service, variation)
        assert (f"{queue.rate:.3g}", queue.workers, round(100 * queue.load)) == (rate, int(workers), int(busy))
