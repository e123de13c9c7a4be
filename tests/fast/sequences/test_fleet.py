"""Work on a Dask cluster of this machine: frames of the same bytes, a lost worker, mixed fleets; masks."""

import os
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from distributed import LocalCluster
from masks import bake
from typer.testing import CliRunner

from seafoam import processes
from seafoam.cli import app
from seafoam.extras import MissingExtraError
from seafoam.library.request import PictureRequest
from seafoam.sequences import fleet as fleet_module
from seafoam.sequences.fleet import DaskWorkers
from seafoam.sequences.making import Output, SequenceFolder, make_sequence
from seafoam.sequences.spec import InProcess, MixedFleetError, SequenceError, SequenceSpec
from support.api_fakes import RAISE, FakeRenderer
from support.command import free_port

HERE = {"processes": False, "protocol": "tcp", "host": "127.0.0.1", "dashboard_address": "127.0.0.1:0"}
"""A cluster whose scheduler and workers are threads of this process, at an address as those of others have."""


def test_a_scheduler_that_goes_away_ends_the_sequence_which_goes_on_with_the_next(tmp_path: Path) -> None:
    output = Output(tmp_path / "away", "frames")
    with LocalCluster(1, threads_per_worker=1, **HERE) as cluster:

        def stop(stage: str, done: int, *_: object) -> None:
            if done == 20:
                cluster.close()

        workers = DaskWorkers(cluster.scheduler_address, factory=FakeRenderer)
        with workers, pytest.raises(SequenceError, match="goes on"):
            make_sequence(spec(60), output, workers, tell=stop)
    assert make_sequence(spec(60), output, InProcess(FakeRenderer())) >= 20


def spec(frames: int, start: float = 0.0) -> SequenceSpec:
    job = PictureRequest("paper-halftone", time=start, size=(64, 36), quality="fast").job()
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


@pytest.fixture(scope="module")
def scheduler(fleet: DaskWorkers) -> str:
    """Address of a cluster with two workers."""
    return fleet.client.scheduler.address


def pids(fleet: DaskWorkers) -> list[int]:
    return list(fleet.client.run(os.getpid).values())


def test_a_lost_worker_loses_no_frame(fleet: DaskWorkers, tmp_path: Path) -> None:
    first, second = pids(fleet)
    assert os.getpid() not in (first, second)

    def tell(stage: str, done: int, *_: object) -> None:
        if done == 60:
            os.kill(first, signal.SIGKILL)

    here, there = (Output(tmp_path / name, "frames") for name in ("here", "there"))
    make_sequence(spec(120), here, InProcess(FakeRenderer()))
    assert make_sequence(spec(120), there, fleet, tell=tell) == 0
    pictures = [{each.name: each.read_bytes() for each in one.path.glob("frame-*.png")} for one in (here, there)]
    assert pictures[0] == pictures[1]
    assert first not in pids(fleet)


def test_what_a_worker_raises_ends_the_sequence(fleet: DaskWorkers, tmp_path: Path) -> None:
    output = Output(tmp_path / "run", "frames")
    failing = spec(30, RAISE - 20 / 24)
    with pytest.raises(ValueError, match="secret of the driver"):
        make_sequence(failing, output, fleet)
    assert len(SequenceFolder(output.path, failing.identity(fleet.info)).finished(30)) >= 1
    assert len(list(fleet.draw([(0, spec(1).frame(0))]))) == 1


@pytest.fixture
def mixed(fleet: DaskWorkers) -> Iterator[str]:
    """Address of the cluster, whose workers have no renderers yet, and none after the test."""

    def forgotten() -> None:
        fleet.client.wait_for_workers(2)  # one may have been lost just now
        addresses = fleet.client.scheduler_info(n_workers=-1)["workers"]
        forget = fleet_module._renderer.cache_clear
        fleet.client.gather([fleet.client.submit(forget, workers=[each], pure=False) for each in addresses])

    forgotten()
    yield fleet.client.scheduler.address
    forgotten()


def test_a_mixed_fleet_is_refused_unless_it_is_allowed_and_so_is_a_worker_with_several_threads(mixed: str) -> None:
    with DaskWorkers(mixed, factory=OwnName, mixed=True) as joined:
        assert joined.info["renderer"] == "gradient"
        assert len(list(joined.draw((index, spec(6).frame(index)) for index in range(6)))) == 6
    with pytest.raises(MixedFleetError, match=r"gradient, .* and gradient"):
        DaskWorkers(mixed, factory=OwnName)
    with (
        LocalCluster(1, threads_per_worker=2, **HERE) as cluster,
        pytest.raises(SequenceError, match="--nthreads 1"),
    ):
        DaskWorkers(cluster.scheduler_address, factory=FakeRenderer)


def test_a_worker_that_outlasts_the_end_costs_no_frame(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a busy machine, where a killed process is not gone within Dask's five seconds."""

    def late(*_: object, **__: object) -> LocalCluster:
        cluster = LocalCluster(1, threads_per_worker=1, **HERE)
        end = cluster.close

        def close() -> None:
            end()
            raise TimeoutError

        cluster.close = close
        return cluster

    monkeypatch.setattr("distributed.LocalCluster", late)
    with DaskWorkers(workers=1, factory=FakeRenderer) as workers:
        assert len(list(workers.draw([(0, spec(1).frame(0))]))) == 1


def test_no_scheduler_and_no_dask(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "CONNECT_SECONDS", 0.3)
    address = f"tcp://127.0.0.1:{free_port()}"
    with pytest.raises(SequenceError, match=f"no scheduler answers at {address}"):
        DaskWorkers(address)
    with pytest.raises(processes.NoClusterError, match=address), processes.executor(address, 1):
        pass
    told = CliRunner().invoke(app, ["accuracy", "paper-threshold", "--scheduler", address])
    assert told.exit_code != 0
    assert address in str(told.exception)
    monkeypatch.setattr("seafoam.extras.find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"seafoam\[cluster\]"):
        DaskWorkers()


# Masks


def test_jobs_run_elsewhere(scheduler: str) -> None:
    for address in (None, scheduler):
        with processes.executor(address, 1) as pool:
            assert pool.submit(os.getpid).result() != os.getpid()
            with pytest.raises(ZeroDivisionError):
                pool.submit(divmod, 1, 0).result()


def test_masks_of_a_cluster_are_those_of_this_process(
    scheduler: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small = {name: replace(bake.SHIPPED[name], width=64, height=64) for name in ("vac-1.5", "clump")}
    monkeypatch.setattr(bake, "SHIPPED", small)
    with ThreadPoolExecutor(1) as pool:
        bake.bake_all(tmp_path / "here", pool)
    with processes.executor(scheduler, 0) as pool:
        bake.bake_all(tmp_path / "there", pool)
        # Of those that are not made again the ranks are kept.
        bake.bake_all(tmp_path / "there", pool, ["vac-1.5"])
    here, there = ({file.name: file.read_bytes() for file in (tmp_path / one).iterdir()} for one in ("here", "there"))
    assert len(here) == 2 * len(small) + 1
    assert here == there
