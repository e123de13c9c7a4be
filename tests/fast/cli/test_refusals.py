"""Bad input ends in one line that names the field and what it may be, and nothing is written."""

import shlex
import socket

import pytest

from seafoam.render.gl.executor import NoRendererError

RENDER = "render default -o a.png"
SEQUENCE = "sequence default --start 0 --stop 0.25 --size 24x16 --quality fast"
MAKE = "masks make -o a.png"
REFUSED = [
    ("render nope -o a.png", "PRESET", "'nope'", "default"),
    ("render default -o a.gif", "--output", ".png, .webp, .exr, .npy"), ("render default", "--output", "--again"),
    ("render default --again a.png", "PRESET", "not allowed with --again"),
    ("render --again a.png --time 2 --budget-ms 8", "--time, --budget-ms", "not allowed"),
    ("render default -o a.exr --precision double", "--precision", "half, float"),
    (f"{RENDER} --size 12", "--size", "WIDTHxHEIGHT"), (f"{RENDER} --size 9000x9", "--size", "1 to 8192"),
    (f"{RENDER} --size 8192x8 --quality reference", "--size", "1 to 3276"),
    (f"{RENDER} --time 2e9", "--time", "-1e+09 to 1e+09"), (f"{RENDER} --time noon", "--time", "number"),
    (f"{RENDER} --quality best", "--quality", "fast, standard, high, reference"),
    (f"{RENDER} --quality auto", "--budget-ms"), (f"{RENDER} --budget-ms 4", "--budget-ms"),
    (f"{RENDER} --quality auto --budget-ms 0", "--budget-ms"), (f"{RENDER} --look nice", "--look", "filtered"),
    (f"{RENDER} --mask zzz", "--mask", "zzz"), (f"{RENDER} --mask vac:99:64:1", "--mask", "0.5..8"),
    (f"{RENDER} --fov 9", "--fov", "0.01 to 2.6"), (f"{RENDER} --zoom 2", "--zoom"),
    ("sequence nope --stop 1 -o run", "PRESET", "'nope'", "default"), ("sequence default -o run", "--stop"),
    ("sequence default --stop 1", "--output"), (f"{SEQUENCE} -o a.gif", "--output", ".mp4, .webp, .zip"),
    (f"{SEQUENCE} -o a.mp4 --codec vp9", "--codec", "h264, av1"),
    (f"{SEQUENCE} -o a.mp4 --size 25x16", "--size", "even"),
    (f"{SEQUENCE} -o run --size 9000x9", "--size", "1 to 8192"),
    (f"{SEQUENCE} -o run --fps 0", "--fps", "0.001 to 1000"),
    (f"{SEQUENCE} -o run --stop -1", "--stop", "above the start"),
    (f"{SEQUENCE} -o run --start -2e9", "--start", "-1e+09 to 1e+09"),
    (f"{SEQUENCE} -o run --quality best", "--quality", "fast, standard"),
    (f"{SEQUENCE} -o run --look nice", "--look", "filtered"), (f"{SEQUENCE} -o run --mask zzz", "mask", "zzz"),
    ("accuracy nope", "PRESET", "'nope'", "default"), ("accuracy", "PRESET or --all"),
    ("accuracy default --size 8x8", "--size", "16x16"), ("accuracy default --rounds 1", "--rounds"),
    ("accuracy default --timer gpu", "--timer", "wall; processor"), ("accuracy default -o a.gif", "--output", ".png"),
    ("accuracy default --html a.txt", "--html", ".html"), (f"{MAKE} --family zac", "--family", "vac, blur"),
    (f"{MAKE} --size 64x", "--size", "WIDTHxHEIGHT, 32..1024"), (f"{MAKE} --size 1025", "--size", "32..1024"),
    (f"{MAKE} --sigma 99 --size 64", "--sigma", "0.5..8"), (f"{MAKE} --method fast", "--method", "exact"),
    (f"{MAKE} --bits 12", "--bits", "8, 16"), ("masks make -o a.jpg", "--output", ".png, .npy, .u16, .dds"),
    ("masks spectrum vac-9 --json", "NAME", "vac-24"), ("masks spectrum vac-6", "--output or --json"),
    ("masks spectrum vac-6 -o a.jpg", "--output", ".png"),
    ("plan default --program nothing", "--program: must be one of "),
    ("plan default --quality best", "--quality: must be one of fast; standard; high; reference, not 'best'"),
    ("plan atlantis", "PRESET: 'atlantis' was not found"), ("serve --port 99999", "--port", "0 to 65535"),
]  # fmt: skip


@pytest.mark.parametrize("row", REFUSED, ids=lambda row: row[0])
def test_bad_input_is_named_with_what_is_allowed(seafoam, monkeypatch, tmp_path, row):
    monkeypatch.chdir(tmp_path)
    command, *said = row
    code, out, err = seafoam(*shlex.split(command))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert [part for part in said if part not in err] == [], err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [("WORKERS", "0", "1 to 64"), ("STREAMS", "-1", "0 to 1000"), ("DEADLINE", "soon", "maximum 3600")],
)
def test_a_bad_setting_is_named_by_its_variable(seafoam, monkeypatch, name, value, allowed):
    monkeypatch.setenv(f"SEAFOAM_{name}", value)
    code, out, err = seafoam("serve")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert f"SEAFOAM_{name}" in err
    assert allowed in err


def test_what_the_machine_lacks_ends_in_one_line_too(seafoam, monkeypatch, tmp_path):
    def none(**_):
        raise NoRendererError("no OpenGL context; install a driver")

    def said(command, *arguments):
        code, _, err = seafoam(*command.split(), *arguments)
        assert (code, err.count("\n")) == (1, 1)
        return err

    (tmp_path / "file").touch()
    assert "cannot write" in said("masks make --size 32 --sigma 1 -o", tmp_path / "none" / "a.png")
    assert "cannot write" in said(f"{SEQUENCE} -o", tmp_path / "file" / "run")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        assert "--port" in said("serve --port", taken.getsockname()[1])
    with monkeypatch.context() as patched:
        patched.setattr("seafoam.extras.find_spec", lambda name: None)
        told = said(f"{SEQUENCE} -o", tmp_path / "a.mp4")
        assert told == "seafoam: MP4 files need av; pip install 'seafoam[video]'\n"
        assert list(tmp_path.glob("a.mp4*")) == []
        told = said(f"{SEQUENCE} --workers 2 -o", tmp_path / "run")
        assert told.endswith("several processes or machines needs distributed; pip install 'seafoam[cluster]'\n")
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", none)
    for command in (f"{RENDER} --size 8x8 -o", f"{SEQUENCE} -o"):
        assert said(command, tmp_path / "a.webp") == "seafoam: no OpenGL context; install a driver\n"
