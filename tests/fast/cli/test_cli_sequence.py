"""The command ``seafoam sequence``: what it writes and says. What it refuses is in test_refusals.py."""

import pytest

from support.api_fakes import FakeRenderer

SHORT = ("sequence", "paper-halftone", "--stop", "0.25", "--start", "0", "--size", "24x16", "--quality", "fast", "-o")


@pytest.mark.parametrize("name", ["run", "a.webp", "a.mp4", "a.ZIP"])
def test_it_writes_what_the_name_says_into_a_folder_that_it_makes(seafoam, tmp_path, name):
    code, out, err = seafoam(*SHORT, tmp_path / "new" / name)
    assert (code, err) == (0, "")
    assert f"{name}: 6 frames of 24 × 16 at 24 a second; gradient" in out
    assert [each.name for each in (tmp_path / "new").iterdir()] == [name]


def test_it_goes_on(seafoam, tmp_path):
    run = (*SHORT, tmp_path / "run")
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
        code, _, err = seafoam(*SHORT, tmp_path / "run")
    assert code == 130
    assert "goes on" in err
    assert "3 of them were there" in seafoam(*SHORT, tmp_path / "run")[1]
