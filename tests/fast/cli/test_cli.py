"""The command: what it writes and lists. What it refuses is in test_refusals.py."""

import io
import json
import os
import re
import signal
import time
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from seafoam import doctor
from seafoam.accuracy import sweep
from seafoam.doctor import Finding
from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.masks.formats import to_u16
from seafoam.planner import make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.render.gl.executor import NoRendererError
from seafoam.render.service import jobs
from seafoam.scene import load_preset, preset_names
from support.accuracy_rigs import grey_truth, noisy
from support.api_fakes import FakeRenderer


def picture(path):
    return Image.open(io.BytesIO(path.read_bytes()))


class Recorder(FakeRenderer):
    """Keeps what it was asked to draw."""

    asked: dict = {}  # noqa: RUF012

    def render(self, plan, **asked):
        self.asked.update(asked, plan=plan, optimized=self.optimized)
        return super().render(plan, **asked)


def test_render_writes_the_format_of_the_extension(seafoam, tmp_path):
    """Of those with a recipe: test_again.py."""
    for name in ("a.WEBP", "a.npy"):
        assert seafoam("render", "default", "-o", tmp_path / name, "--size", "48x27")[0] == 0
    assert picture(tmp_path / "a.WEBP").format == "WEBP"
    assert np.load(tmp_path / "a.npy").shape == (27, 48, 4)


def test_render_passes_on_what_is_given(seafoam, monkeypatch, tmp_path):
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", Recorder)
    output = ("-o", tmp_path / "a.png")
    changes = ("--look", "halftone", "--mask", "vac:3:64:1", "--yaw", "1", "--y", "9", "--time", "-1e9")
    assert seafoam("render", "default", *output, "--size", "8x9", *changes)[0] == 0
    preset = load_preset("default")
    asked = Recorder.asked
    assert (asked["width"], asked["height"], asked["time"], asked["optimized"]) == (8, 9, -1e9, False)
    assert asked["camera"].yaw == 1.0
    assert asked["camera"].position == (preset.scene.camera.position[0], 9.0, preset.scene.camera.position[2])
    assert asked["camera"].fov == preset.scene.camera.fov
    assert any("vac:3:64:1" in texture.url for texture in asked["plan"].textures.values())
    assert seafoam("render", "default", *output)[0] == 0
    assert (asked["width"], asked["height"], asked["time"], asked["optimized"]) == (*preset.size, preset.time, True)
    assert asked["camera"] == preset.scene.camera


def test_the_help_the_openapi_document_presets_and_masks_are_printed(seafoam):
    code, out, err = seafoam()
    assert (code, "render" in out, err) == (2, True, "")
    for command, told in (
        (("openapi",), ["/api/frames/{preset}.{format}"]),
        (("presets",), preset_names()),
        (("masks", "list"), [load_mask("vac-24").entry.sha256[:12]]),
    ):
        code, out, _ = seafoam(*command)
        assert (code, [name for name in told if name not in out]) == (0, [])


def test_masks_are_made_in_every_format_and_spectra_written_as_json_or_a_plot(seafoam, tmp_path):
    ranks = make_mask("clump", sigma=2.0, size=64, seed=7)
    make = ("masks", "make", "--family", "clump", "--sigma", "2", "--seed", "7")
    for name in ("a.png", "a.npy", "a.u16", "a.dds"):
        code, out, _ = seafoam(*make, "--size", "64", "-o", tmp_path / name)
        assert (code, "64 × 64" in out) == (0, True)
    assert (tmp_path / "a.u16").read_bytes() == to_u16(ranks)
    assert picture(tmp_path / "a.png").mode == "I;16"
    assert "96 × 40" in seafoam(*make, "--size", "96x40", "--bits", "8", "-o", tmp_path / "c.png")[1]
    assert (picture(tmp_path / "c.png").size, picture(tmp_path / "c.png").mode) == ((96, 40), "L")
    code, out, _ = seafoam("masks", "spectrum", "vac-6", "--json")
    assert json.loads(out) == load_mask("vac-6").tables.spectrum.model_dump(mode="json")
    assert seafoam("masks", "spectrum", "blur:2:64:0", "-o", tmp_path / "a.png")[0] == 0
    assert picture(tmp_path / "a.png").format == "PNG"


def test_a_plan_lists_its_passes_and_prints_a_program_with_the_names_of_its_files(seafoam):
    code, out, _ = seafoam("plan", "default")
    assert code == 0
    assert "surface, underwater" in out
    _, out, _ = seafoam("plan", "default", "--quality", "fast", "--program", "surface")
    shader = make_plan(load_preset("default").scene, TIERS["fast"]).programs["surface"].fragment
    lines = out.splitlines()
    assert [line for line in lines if not line.startswith("// ---- ")] == shader.text.splitlines()
    named = [line.removeprefix("// ---- ") for line in lines if line.startswith("// ---- ")]
    assert named == [file.path for file in shader.files]
    # The first line of a file follows its name.
    look = "foam/look.glsl@filtered"
    assert lines[lines.index(f"// ---- {look}") + 1] == read_file(look).splitlines()[0]
    _, out, _ = seafoam("plan", "default", "--program", "surface", "--stage", "vertex")
    assert "// ---- vertex/vertex.glsl@falling" in out


def dying_probe():
    os.kill(os.getpid(), signal.SIGKILL)


class Here:
    """Runs what a process would."""

    def __init__(self, **_):
        self.stop = self.join = lambda: None

    def schedule(self, probe, timeout):
        return SimpleNamespace(result=probe)


def test_doctor_looks_at_everything_and_says_what_is_missing(monkeypatch):
    def bad_probe():
        raise NoRendererError("no OpenGL context: none; install a driver")

    (crashed,) = doctor._renderer(dying_probe)
    assert (crashed.state, "crashed" in crashed.detail, "apt-get install" in crashed.remedy) == ("missing", True, True)
    monkeypatch.setattr(doctor, "ProcessPool", Here)
    (bad,) = doctor._renderer(bad_probe)
    assert (bad.state, bad.detail, bad.remedy) == ("missing", "no OpenGL context: none", "install a driver")
    found = doctor.examine(partial(dict, vendor="A", renderer="B", version="C"))
    findings = {finding.what: finding for finding in found}
    assert {"Python", "OpenGL", "GLSL ES 3.00", "Masks", "Web client", "Reports"} <= set(findings)
    assert "hardware" in findings["OpenGL"].detail
    assert all(finding.remedy for finding in found if finding.state != "good")
    assert not doctor.able_to_render([*found, bad])


def test_doctor_exits_by_whether_frames_can_be_rendered(seafoam, monkeypatch):
    for state, code, remedy in (("good", 0, ""), ("optional", 0, "make it"), ("missing", 1, "make it")):
        found = Finding("Thing", state, "as it is", remedy)
        monkeypatch.setattr(doctor, "examine", lambda found=found: [found])
        left, out, _ = seafoam("doctor")
        assert (left, "as it is" in out, remedy in out) == (code, True, True)


@pytest.fixture
def rigged(seafoam, monkeypatch, tmp_path):
    """The command on a renderer whose times and errors are known."""
    monkeypatch.setenv("SEAFOAM_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    monkeypatch.setattr("seafoam.render.service.jobs.measure", lambda executor, job: noisy().measure(job))
    return seafoam


SMALL = ("--size", "32x18", "--rounds", "2", "--samples", "2")


def test_accuracy_writes_every_form(rigged, tmp_path):
    files = {"-o": "a.png", "--json": "a.json", "--csv": "a.csv", "--html": "a.html"}
    options = [part for option, name in files.items() for part in (option, tmp_path / name)]
    code, out, err = rigged("accuracy", "default", *SMALL, "--timer", "processor", *options)
    assert code == 0, err
    assert ("samples=4" in out, "× the time buys" in out) == (True, True)
    found = json.loads((tmp_path / "a.json").read_text())
    assert (found["preset"], found["timing"]["timer"]) == ("default", "processor")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.csv").read_text().startswith("id,")
    assert "seafoam accuracy default --size 32x18" in (tmp_path / "a.html").read_text()


@pytest.mark.parametrize(("clock", "seconds"), [("wall", 0.5), ("processor", 2.0)])
def test_a_measurement_is_timed_by_the_clock_that_is_asked_for(monkeypatch, clock, seconds):
    scene = load_preset("paper-threshold").scene
    drawn = SimpleNamespace(pixels=np.zeros((9, 16, 4), np.uint8), timings={"render": 0.5, "read": 0.25})
    renderer = SimpleNamespace(render=lambda plan, **asked: drawn)
    monkeypatch.setattr(time, "process_time", iter((1.0, 3.0)).__next__)
    asked = jobs.MeasureJob(scene, TIERS["fast"], 0.0, scene.camera, (jobs.Draw(16, 9, "rgba8"),), clock)
    assert [one.seconds for one in jobs.measure(renderer, asked)] == [seconds]


def test_accuracy_of_all_presets_fills_folders(rigged, monkeypatch, tmp_path):
    monkeypatch.setattr("seafoam.scene.presets.preset_names", lambda: ("default", "paper-threshold"))
    code, _, err = rigged("accuracy", "--all", *SMALL, "--csv", tmp_path / "reports")
    assert code == 0, err
    assert {path.stem for path in (tmp_path / "reports").iterdir()} == {"default", "paper-threshold"}


def test_render_picks_a_quality_for_a_budget(rigged, tmp_path):
    asked = ("--size", "32x18", "--quality", "auto", "--budget-ms", "4")
    code, out, err = rigged("render", "paper-threshold", "-o", tmp_path / "a.png", *asked)
    assert code == 0, err
    assert re.search("predicted.* of 4 ms at 32 x 18", out.splitlines()[-1])


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
    assert re.search("differs in fps.*--again", err)
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
    assert (code, "goes on" in err) == (130, True)
    assert "3 of them were there" in seafoam(*SHORT, tmp_path / "run")[1]
