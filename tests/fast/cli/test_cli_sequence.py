"""The command ``seafoam sequence``: what it writes, says and refuses."""

import pytest

from seafoam import cli
from seafoam.render.gl.executor import NoRendererError
from support.api_fakes import FakeRenderer

SHORT = ("--stop", "0.25", "--start", "0", "--size", "24x16", "--quality", "draft")


@pytest.fixture
def seafoam(capsys, monkeypatch):
    """The command in this process, with a renderer that draws gradients: exit code, stdout, stderr."""
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", FakeRenderer)

    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main(["sequence", *map(str, arguments)])
        out, err = capsys.readouterr()
        return left.value.code, out, err

    return call


@pytest.mark.parametrize("name", ["run", "a.webp", "a.mp4", "a.ZIP"])
def test_it_writes_what_the_name_says(seafoam, tmp_path, name):
    code, out, err = seafoam("paper-halftone", *SHORT, "-o", tmp_path / name)
    assert (code, err) == (0, "")
    assert f"{name}: 6 frames of 24 × 16 at 24 a second; gradient" in out
    assert [each.name for each in tmp_path.iterdir()] == [name]


def test_it_goes_on(seafoam, tmp_path):
    run = ("paper-halftone", *SHORT, "-o", tmp_path / "run")
    assert seafoam(*run)[0] == 0
    (tmp_path / "run" / "frame-000002.png").unlink()
    assert "5 of them were there" in seafoam(*run)[1]
    code, _, err = seafoam(*run, "--fps", "30")
    assert code == 2
    assert "differs in fps" in err
    assert "--again" in err
    assert seafoam(*run, "--fps", "30", "--again")[0] == 0


def test_interrupted(seafoam, tmp_path, monkeypatch):
    render = FakeRenderer.render

    def interrupted(self, plan, *, time, **options):
        if time > 0.1:
            raise KeyboardInterrupt
        return render(self, plan, time=time, **options)

    with monkeypatch.context() as patched:
        patched.setattr(FakeRenderer, "render", interrupted)
        code, _, err = seafoam("paper-halftone", *SHORT, "-o", tmp_path / "run")
    assert code == 130
    assert "goes on" in err
    assert "3 of them were there" in seafoam("paper-halftone", *SHORT, "-o", tmp_path / "run")[1]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nope", *SHORT, "-o", "run"], ["PRESET", "'nope'", "default"]),
        (["default", "-o", "run"], ["--stop"]),
        (["default", *SHORT], ["--output"]),
        (["default", *SHORT, "-o", "a.gif"], ["--output", ".mp4, .webp, .zip"]),
        (["default", *SHORT, "-o", "a.mp4", "--codec", "vp9"], ["--codec", "h264, av1"]),
        (["default", *SHORT, "-o", "a.mp4", "--size", "25x16"], ["--size", "even"]),
        (["default", *SHORT, "-o", "run", "--size", "9"], ["--size", "WIDTHxHEIGHT"]),
        (["default", *SHORT, "-o", "run", "--size", "9000x9"], ["--size", "1 to 8192"]),
        (["default", *SHORT, "-o", "run", "--fps", "0"], ["--fps", "0.001 to 1000"]),
        (["default", *SHORT, "-o", "run", "--stop", "-1"], ["--stop", "above the start"]),
        (["default", *SHORT, "-o", "run", "--stop", "2e9"], ["--stop", "at most"]),
        (["default", *SHORT, "-o", "run", "--start", "-2e9"], ["--start", "-1e+09 to 1e+09"]),
        (["default", *SHORT, "-o", "run", "--quality", "best"], ["--quality", "draft, standard"]),
        (["default", *SHORT, "-o", "run", "--look", "nice"], ["--look", "filtered"]),
        (["default", *SHORT, "-o", "run", "--mask", "zzz"], ["mask", "zzz"]),
    ],
)
def test_bad_input(seafoam, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    code, _, err = seafoam(*arguments)
    assert code == 2
    assert err.count("\n") == 1
    for part in said:
        assert part in err
    assert list(tmp_path.iterdir()) == []


def test_what_the_machine_lacks(seafoam, tmp_path, monkeypatch):
    code, _, err = seafoam("default", *SHORT, "-o", tmp_path / "no" / "a.webp")
    assert code == 0, err
    (tmp_path / "file").touch()
    code, _, err = seafoam("default", *SHORT, "-o", tmp_path / "file" / "run")
    assert (code, err.count("\n")) == (1, 1)
    assert "cannot write" in err
    with monkeypatch.context() as patched:
        patched.setattr("seafoam.extras.find_spec", lambda name: None)
        code, _, err = seafoam("default", *SHORT, "-o", tmp_path / "a.mp4")
        assert (code, err) == (1, "seafoam: MP4 files need av; pip install 'seafoam[video]'\n")
        code, _, err = seafoam("default", *SHORT, "-o", tmp_path / "run", "--workers", "2")
        assert (code, err) == (
            1,
            "seafoam: work on several processes or machines needs distributed; pip install 'seafoam[cluster]'\n",
        )

    def none():
        raise NoRendererError("no OpenGL context; install a driver")

    monkeypatch.setattr("seafoam.render.gl.executor.Executor", none)
    code, _, err = seafoam("default", *SHORT, "-o", tmp_path / "a.webp")
    assert (code, err) == (1, "seafoam: no OpenGL context; install a driver\n")
