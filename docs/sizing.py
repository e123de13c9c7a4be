"""How many renderers a server needs: an M/G/N queue with bounded waiting room, for frames that no cache has.

    .venv/bin/python docs/sizing.py --visitors 1000 --frames 5 --hits 0.6

Requests arrive at random (Poisson) at ``rate`` (1/s), N workers draw one each in ``service`` (mean, s;
``variation``: its squared coefficient of variation), and at most Q wait. With a = rate · service erlangs offered and
ρ = a/N:

- Erlang B and C: A. K. Erlang 1917; the recursion B_n = a B_{n-1} / (n + a B_{n-1}), and C = B / (1 - ρ (1 - B)).
- Mean wait, Allen and Cunneen's correction for general service times: C / (N/service - rate) · (1 + variation) / 2
  (A. O. Allen, *Probability, Statistics, and Queueing Theory*, 2nd ed. 1990, chapter 5). Exact for N = 1
  (Pollaczek and Khinchine) and for exponential service.
- Waits beyond t: C · exp(-t · C / mean wait), exact for exponential service.
- Refused (503): the last state of M/M/N/N+Q, B ρ^Q / (1 + B (ρ + … + ρ^Q)). Fewer are refused where frame times vary
  less than exponential ones do (variation below 1).

``tests/fast/project/test_generated.py`` compares all of it with a simulation.
"""

import argparse
import math
import re
from dataclasses import dataclass
from pathlib import Path

PEAK = 3.0
"""Rate of the busiest hour over the mean rate of a day: an assumption."""
DAY = 86_400.0
TIMES = Path(__file__).with_name("performance.md")


def erlang_b(workers: int, offered: float) -> float:
    """Return the share of time in which all workers are busy where nothing waits. offered: erlangs."""
    blocked = 1.0
    for busy in range(1, workers + 1):
        blocked = offered * blocked / (busy + offered * blocked)
    return blocked


@dataclass(frozen=True, slots=True)
class Queue:
    """Workers and what they are asked for. rate: 1/s. service: mean, s. room: frames that may wait."""

    workers: int
    rate: float
    service: float
    variation: float
    room: int

    @property
    def offered(self) -> float:
        """Work that arrives, erlangs: workers that would be busy if none were refused."""
        return self.rate * self.service

    @property
    def load(self) -> float:
        """Share of the workers' time that is asked for."""
        return self.offered / self.workers

    @property
    def delayed(self) -> float:
        """Share of requests that wait (Erlang C); 1 from full load on."""
        if self.load >= 1.0:
            return 1.0
        blocked = erlang_b(self.workers, self.offered)
        return blocked / (1.0 - self.load * (1.0 - blocked))

    @property
    def mean_wait(self) -> float:
        """Mean wait of a request, s, with room for any number; infinite from full load on."""
        if self.load >= 1.0:
            return math.inf
        return self.delayed / (self.workers / self.service - self.rate) * (1.0 + self.variation) / 2.0

    def waits_beyond(self, seconds: float) -> float:
        """Return the share of requests that wait longer, with room for any number."""
        return self.delayed * math.exp(-seconds * self.delayed / self.mean_wait) if self.mean_wait else 0.0

    @property
    def refused(self) -> float:
        """Share of requests that find no room."""
        blocked = erlang_b(self.workers, self.offered)
        waiting = sum(self.load**place for place in range(1, self.room + 1))
        return blocked * self.load**self.room / (1.0 + blocked * waiting)


def workers_for(rate: float, service: float, variation: float, *, refused: float = 1e-3, wait: float = 1.0) -> Queue:
    """Return the smallest queue that refuses at most that share, and lets 1 in 100 wait longer than ``wait`` (s).

    Room is the server's default, twice the number of workers.
    """
    workers = max(1, math.floor(rate * service))
    while True:
        queue = Queue(workers, rate, service, variation, 2 * workers)
        if queue.load < 1.0 and queue.refused <= refused and queue.waits_beyond(wait) <= 0.01:
            return queue
        workers += 1


def measured_times(page: Path = TIMES) -> list[float]:
    """Return the frame times of the presets, 1280 × 720, quality standard, s: the table of docs/performance.md."""
    table = page.read_text(encoding="utf-8").partition("x three.js  quartiles")[2].partition("\n\n")[0]
    times = [0.001 * float(found) for found in re.findall(r"(?m)^[a-z][a-z-]+ +([\d.]+) ", table)]
    if len(times) < 20:
        raise ValueError(f"{page}: no table of frame times")
    return times


def moments(times: list[float]) -> tuple[float, float]:
    """Return mean (s) and squared coefficient of variation."""
    mean = sum(times) / len(times)
    return mean, sum((each - mean) ** 2 for each in times) / len(times) / mean**2


def renders(visitors: float, frames: float, hits: float) -> float:
    """Return the renders of the busiest hour, 1/s. visitors: a day. frames: of a visitor. hits: share from caches."""
    return visitors * frames * PEAK / DAY * (1.0 - hits)


def main() -> None:
    """Print the workers for a number of visitors a day."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--visitors", type=float, nargs="+", default=[10, 1000, 1_000_000], help="a day")
    parser.add_argument("--frames", type=float, default=5.0, help="that a visitor asks the server for")
    parser.add_argument("--hits", type=float, nargs="+", default=[0.0, 0.6, 0.9], help="share of them from caches")
    parser.add_argument("--service", type=float, help="mean time of a frame, s; absent: as measured")
    asked = parser.parse_args()
    measured, variation = moments(measured_times())
    service = asked.service or measured
    print(f"frame {1000 * service:.0f} ms, squared coefficient of variation {variation:.2f}\n")
    print("visitors/day  hits  renders/s  workers  busy  wait, ms  wait > 1 s  refused")
    for visitors in asked.visitors:
        for hits in asked.hits:
            queue = workers_for(renders(visitors, asked.frames, hits), service, variation)
            print(
                f"{visitors:12,.0f}  {hits:4.0%}  {queue.rate:9.4f}  {queue.workers:7d}  {queue.load:4.0%}"
                f"  {1000 * queue.mean_wait:8.2f}  {queue.waits_beyond(1.0):10.3%}  {queue.refused:7.3%}"
            )


if __name__ == "__main__":
    main()
