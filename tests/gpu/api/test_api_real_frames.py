"""Frames over HTTP and by the command, drawn with GL."""

import io
import json
import os
import urllib.request
from collections.abc import Iterator

import numpy as np
import OpenEXR
import pytest
from distributed import LocalCluster
from starlette.testclient import TestClient

import seafoam
from seafoam.cli import main
from support.command import FAKED, imported, served
from support.serving import frame, picture, serving


@pytest.fixture(scope="module")
def real() -> Iterator[TestClient]:
    """With the GL executor."""
    with serving(None) as running:
        yield running


def drawn(client, suffix="png", **params):
    """A frame with few programs."""
    return frame(client, suffix, quality="fast", **params)


def test_the_same_request_gives_the_same_bytes_also_after_a_restart(real):
    answers = [drawn(real, time=4.0), drawn(real, time=4.0)]
    with serving(None) as restarted:
        answers.append(drawn(restarted, time=4.0))
    assert len({(answer.content, answer.headers["ETag"]) for answer in answers}) == 1


def test_a_dithered_picture_is_the_exact_one_within_a_level_and_in_the_mean(real):
    size = {"width": 192, "height": 108}
    dithered = np.asarray(picture(drawn(real, **size)), np.int64)
    exact = np.asarray(picture(drawn(real, **size, dither=False)), np.int64)
    off = dithered - exact
    assert np.abs(off).max() == 1
    assert np.abs(off.mean(axis=(0, 1))).max() < 0.1
    assert np.abs(off[:32].reshape(2, 16, 12, 16, 3).mean(axis=(1, 3))).max() <= 0.5  # in the sky, too


def test_open_exr_holds_what_npy_holds(real):
    linear = np.load(io.BytesIO(drawn(real, "npy", time=4.0).content))
    for precision, type in (("float", np.float32), ("half", np.float16)):
        content = drawn(real, "exr", time=4.0, precision=precision).content
        channels = OpenEXR.File(io.BytesIO(content)).channels()
        np.testing.assert_array_equal(channels["RGB"].pixels, linear[..., :3].astype(type))
        np.testing.assert_array_equal(channels["coverage"].pixels, linear[..., 3].astype(type))


def test_the_renderer_is_told(real):
    ready = real.get("/readyz").json()
    assert drawn(real).headers["Seafoam-Renderer"] == ready["renderer"]["renderer"]
    assert "Mesa" in ready["renderer"]["version"] or ready["renderer"]["version"][0].isdigit()


def test_a_frame_imports_what_it_needs(tmp_path):
    """Drawn and written; tests/fast/cli/test_consoles.py has what comes before, and the other commands."""
    arguments = ["render", "default", "--size", "48x27", "--quality", "fast", "-o", str(tmp_path / "a.png")]
    found = imported(f"from seafoam.cli import main; main({arguments})")
    unneeded = {"PIL", "OpenEXR", "asyncio", "fastapi", "matplotlib", "multiprocessing", "rich", "scipy", "starlette"}
    assert {name.partition(".")[0] for name in found} & unneeded == set()
    assert len(found) <= 600, f"{len(found)} modules"


@pytest.mark.skipif(not os.path.exists("/proc/net/if_inet6"), reason="this machine has no IPv6")
def test_serve_answers_by_ipv6_and_stops_when_told():
    """By IPv4: tests/gpu/docs/test_snippets.py."""
    with served("--host", "::1", code=FAKED) as address:
        with urllib.request.urlopen(f"{address}/healthz", timeout=60) as response:
            assert json.load(response) == {"status": "alive"}
        with seafoam.connect(address) as source:
            assert source.mask("vac-24").shape == (512, 512)


def test_a_cluster_measures_accuracy(tmp_path, capsys):
    """The sweep of a worker, in this process's files; a thread with sockets, as a process may outlast Dask's end."""
    asked = ["--size", "16x16", "--rounds", "2", "--samples", "2", "--again", "--json", str(tmp_path / "a.json")]
    with (
        LocalCluster(1, threads_per_worker=1, processes=False, protocol="tcp://", dashboard_address=None) as cluster,
        pytest.raises(SystemExit) as left,
    ):
        main(["accuracy", "paper-threshold", *asked, "--scheduler", cluster.scheduler_address])
    said = capsys.readouterr()
    assert left.value.code == 0, said.err
    assert "paper-threshold: errors at 16 × 16" in said.out
    measured = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert {point["tier"] for point in measured["points"]} >= {"high", "reference"}
    assert all(point["error"]["rmse"] >= 0.0 for point in measured["points"])
