"""The command in processes of its own: it draws with GL, and it serves."""

import json
import signal
import subprocess
import urllib.request

import numpy as np
import pytest
from PIL import Image

from support.command import COMMAND, run


def test_render_with_gl_without_a_server(tmp_path):
    path = tmp_path / "a.png"
    done = run("render", "default", "-o", path, "--size", "48x27", "--time", "2", "--quality", "draft")
    if "apt-get install" in done.stderr:
        pytest.skip(done.stderr)
    assert done.returncode == 0, done.stderr
    assert "48 × 27" in done.stdout
    picture = Image.open(path)
    assert picture.size == (48, 27)
    assert np.asarray(picture).std() > 10


@pytest.mark.parametrize("format", ["png", "webp", "exr"])
def test_a_picture_is_drawn_again_to_the_byte(tmp_path, format):
    path = tmp_path / f"a.{format}"
    done = run("render", "default", "-o", path, "--size", "64x36", "--time", "3", "--quality", "draft")
    assert done.returncode == 0, done.stderr
    again = run("render", "--again", path, "-o", tmp_path / "b")
    assert again.returncode == 0, again.stdout + again.stderr
    assert (tmp_path / "b").read_bytes() == path.read_bytes()


def test_serve_answers_without_delay_and_stops_when_told():
    process = subprocess.Popen(
        [*COMMAND, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        address = process.stdout.readline().split()[3]
        with urllib.request.urlopen(f"{address}/healthz", timeout=60) as response:
            assert json.load(response) == {"status": "alive"}
        with urllib.request.urlopen(f"{address}/api/presets", timeout=60) as response:
            assert response.status == 200
    finally:
        process.send_signal(signal.SIGTERM)
        process.stdout.close()
    assert process.wait(20) in (0, -signal.SIGTERM)
