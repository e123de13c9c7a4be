"""Masks, truth and sweeps made elsewhere: by processes here, and by the workers of a Dask cluster."""

import io
import json
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from distributed import Client, LocalCluster
from typer.testing import CliRunner

from seafoam import processes
from seafoam.cli import app
from seafoam.masks import bake
from seafoam.reference.bake import baked, jobs_of
from seafoam.scene.presets import load_preset
from support.command import free_port


@pytest.fixture(scope="module")
def scheduler() -> Iterator[str]:
    """Address of a cluster with two workers."""
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        yield cluster.scheduler_address


def test_jobs_run_elsewhere(scheduler: str) -> None:
    for address in (None, scheduler):
        with processes.executor(address, 1) as pool:
            assert pool.submit(os.getpid).result() != os.getpid()
            with pytest.raises(ZeroDivisionError):
                pool.submit(divmod, 1, 0).result()


def test_where_no_scheduler_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "CONNECT_SECONDS", 0.3)
    address = f"tcp://127.0.0.1:{free_port()}"
    with pytest.raises(processes.NoClusterError, match=address), processes.executor(address, 1):
        pass
    told = CliRunner().invoke(app, ["accuracy", "paper-threshold", "--scheduler", address])
    assert told.exit_code != 0
    assert address in str(told.exception)


def test_a_greeting_with_more_in_it_is_asked_for_again(scheduler: str, monkeypatch: pytest.MonkeyPatch) -> None:
    class Crowded(Client):
        left = 2

        def __init__(self, *given: object, **named: object) -> None:
            if Crowded.left:
                Crowded.left -= 1
                raise AssertionError
            super().__init__(*given, **named)

    monkeypatch.setattr("distributed.Client", Crowded)
    with processes.connected(scheduler) as client:
        assert client.submit(divmod, 7, 2).result() == (3, 1)
    Crowded.left = processes.CONNECT_ATTEMPTS
    with pytest.raises(processes.NoClusterError, match="4 times"):
        processes.connected(scheduler)


def test_masks_of_a_cluster_are_those_of_this_process(
    scheduler: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bake, "SHIPPED_SIZE", 64)
    monkeypatch.setattr(bake, "SHIPPED", [mask for mask in bake.SHIPPED if mask.sigma <= 2.0])
    seen: list[float] = []
    bake.bake_all(tmp_path / "here")
    with processes.executor(scheduler, 0) as pool:
        bake.bake_all(tmp_path / "there", seen.append, pool=pool)
        # Of those that are not made again the ranks are kept.
        bake.bake_all(tmp_path / "there", only=(bake.SHIPPED[0].name,), pool=pool)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    here, there = ({file.name: file.read_bytes() for file in (tmp_path / one).iterdir()} for one in ("here", "there"))
    assert len(here) == 2 * len(bake.SHIPPED) + 1
    assert here == there


def test_truth_of_a_cluster_is_that_of_this_process(scheduler: str) -> None:
    job = replace(jobs_of("default", load_preset("default").scene)[0], size=(8, 5), samples=1)
    with processes.executor(scheduler, 0) as pool:
        there, seconds = pool.submit(baked, job).result()
    here, _ = baked(job)
    assert seconds > 0.0
    one, other = (np.load(io.BytesIO(content)) for content in (here, there))
    assert set(one.files) == set(other.files)
    for name in set(one.files) - {"meta"}:
        np.testing.assert_array_equal(one[name], other[name])
    about = [json.loads(each["meta"].tobytes()) for each in (one, other)]
    # How long it took is part of the file.
    assert {**about[0], "seconds": 0.0} == {**about[1], "seconds": 0.0}
