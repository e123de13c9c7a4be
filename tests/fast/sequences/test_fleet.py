"""Frames on a Dask cluster of this machine: the same bytes, a lost worker, mixed fleets, threads, no cluster."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from seafoam.extras import MissingExtraError
from seafoam.library.request import job_of
from seafoam.sequences.errors import MixedFleetError, SequenceError
from seafoam.sequences.fleet import DaskWorkers
from seafoam.sequences.folder import SequenceFolder
from seafoam.sequences.making import Output, Progress, make_sequence
from seafoam.sequences.spec import SequenceSpec
from seafoam.sequences.workers import InProcess
from support.api_fakes import RAISE, FakeRenderer


def spec(frames: int, start: float = 0.0) -> SequenceSpec:
    job = job_of("paper-halftone", time=start, size=(64, 36), quality="draft")
    return SequenceSpec(job, start + frames / 24, 24.0)


class OwnName(FakeRenderer):
    """Of another renderer in each process."""

    def __init__(self) -> None:
        super().__init__()
        self.info = {**self.info, "version": str(os.getpid())}


@pytest.fixture(scope="module")
def fleet() -> Iterator[DaskWorkers]:
    with DaskWorkers(workers=2, factory=FakeRenderer) as workers:
        yield workers


def frames(path: Path) -> dict[str, bytes]:
    return {each.name: each.read_bytes() for each in path.glob("frame-*.png")}


def pids(fleet: DaskWorkers) -> list[int]:
    found: list[int] = list(fleet.client.run(os.getpid).values())
    return found


def test_a_lost_worker_loses_no_frame(fleet: DaskWorkers, tmp_path: Path) -> None:
    local, output = Output(tmp_path / "local", "frames"), Output(tmp_path / "fleet", "frames")
    make_sequence(spec(24), local, InProcess(FakeRenderer()))
    first, second = pids(fleet)
    assert os.getpid() not in (first, second)

    def tell(progress: Progress) -> None:
        if progress.done == 8:
            os.kill(first, signal.SIGKILL)

    made = make_sequence(spec(24), output, fleet, tell=tell)
    assert made.drawn == 24
    assert first not in pids(fleet)
    assert frames(output.path) == frames(local.path)
    # The other's renderer has the same name, so a local run finds all of them.
    assert make_sequence(spec(24), output, InProcess(FakeRenderer())).found == 24


def test_what_a_worker_raises_ends_the_sequence(fleet: DaskWorkers, tmp_path: Path) -> None:
    output = Output(tmp_path / "run", "frames")
    failing = spec(30, RAISE - 20 / 24)
    with pytest.raises(ValueError, match="secret of the driver"):
        make_sequence(failing, output, fleet)
    assert len(SequenceFolder(output.path, failing.identity(fleet.info)).finished(30)) >= 1
    assert len(list(fleet.draw([(0, spec(1).frame(0))]))) == 1


def test_a_mixed_fleet_is_refused_unless_it_is_allowed(tmp_path: Path) -> None:
    with DaskWorkers(workers=2, factory=OwnName, mixed=True) as workers:
        address = workers.client.scheduler.address
        assert len(list(workers.draw((index, spec(6).frame(index)) for index in range(6)))) == 6
        with pytest.raises(MixedFleetError, match=r"gradient, .* and gradient"):
            DaskWorkers(address, factory=OwnName)
        with DaskWorkers(address, factory=OwnName, mixed=True) as joined:
            assert joined.info["renderer"] == "gradient"


def test_a_worker_with_several_threads_is_refused() -> None:
    from distributed import LocalCluster

    with (
        LocalCluster(n_workers=1, threads_per_worker=2, host="127.0.0.1", dashboard_address="127.0.0.1:0") as cluster,
        pytest.raises(SequenceError, match="--nthreads 1"),
    ):
        DaskWorkers(cluster.scheduler_address, factory=FakeRenderer)


def test_no_scheduler_and_no_dask(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seafoam.sequences.fleet.CONNECT_SECONDS", 0.5)
    with pytest.raises(SequenceError, match="no scheduler answers at tcp://127"):
        DaskWorkers("tcp://127.0.0.1:9")
    monkeypatch.setattr("seafoam.extras.find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"seafoam\[cluster\]"):
        DaskWorkers()
