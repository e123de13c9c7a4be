"""What GL draws on a cluster: sequences, on two workers of which one is killed midway, and sweeps."""

import json
import os
import signal
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from distributed import LocalCluster
from PIL import Image

from seafoam.library.request import PictureRequest
from seafoam.sequences.fleet import DaskWorkers
from seafoam.sequences.making import Output, Progress, make_sequence
from seafoam.sequences.spec import SequenceSpec
from support.command import run

FRAMES = 120


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Frames of the command."""
    folder = tmp_path_factory.mktemp("local") / "frames"
    stop = str(FRAMES / 24)
    arguments = ("--start", "0", "--stop", stop, "--size", "64x36", "--quality", "fast", "-o", folder)
    done = run("sequence", "paper-halftone", *arguments)
    assert done.returncode == 0, done.stderr
    assert f"{FRAMES} frames" in done.stdout
    return folder


def frames(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.glob("frame-*.png")}


def test_the_water_moves(local: Path) -> None:
    pictures = [np.asarray(Image.open(path)).astype(float) for path in sorted(local.glob("frame-*.png"))]
    assert len(pictures) == FRAMES
    assert all(picture.std() > 5 for picture in pictures)
    assert all((earlier != later).any() for earlier, later in pairwise(pictures))


def test_two_workers_one_killed_midway_draw_the_same_bytes(local: Path, tmp_path: Path) -> None:
    job = PictureRequest("paper-halftone", time=0.0, size=(64, 36), quality="fast").job()
    killed: list[int] = []
    with DaskWorkers(workers=2) as workers:

        def tell(progress: Progress) -> None:
            if progress.done == FRAMES // 2:
                killed.append(min(workers.client.run(os.getpid).values()))
                os.kill(killed[0], signal.SIGKILL)

        made = make_sequence(
            SequenceSpec(job, FRAMES / 24, 24.0), Output(tmp_path / "fleet", "frames"), workers, tell=tell
        )
    assert killed
    assert made.drawn == FRAMES
    assert frames(tmp_path / "fleet") == frames(local)


def test_a_cluster_measures_accuracy(tmp_path: Path) -> None:
    """The sweep of a worker, in this process's files."""
    asked = ["--size", "16x16", "--rounds", "2", "--samples", "2", "--again", "--json", str(tmp_path / "a.json")]
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        done = run("accuracy", "paper-threshold", *asked, "--scheduler", cluster.scheduler_address)
    assert done.returncode == 0, done.stderr
    assert "paper-threshold: errors at 16 × 16" in done.stdout
    measured = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert {point["tier"] for point in measured["points"]} >= {"high", "reference"}
    assert all(point["error"]["rmse"] >= 0.0 for point in measured["points"])
