"""docs/sizing.py against values from the literature; docs/operations.md has what it says."""

import math
import re
from pathlib import Path

import pytest
from docs.sizing import Queue, erlang_b, measured_times, moments, renders, workers_for


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
