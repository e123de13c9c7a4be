"""``seafoam render --again``: the same bytes, or what differs."""

import io
import json

import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from seafoam.render.encode import FRAME_FORMATS, read_recipe
from support.api_fakes import FakeRenderer


class Painter(FakeRenderer):
    """Of another name, and with so many black pixels as a test says."""

    spoiled = 0

    def __init__(self, **settings):
        self.info = {"vendor": "A", "renderer": "B", "version": "C"}

    def render(self, plan, **asked):
        drawn = super().render(plan, **asked)
        drawn.pixels[0, : self.spoiled] = 0
        return drawn


@pytest.fixture(autouse=True)
def _painter(seafoam, monkeypatch):
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", Painter)


def drawn(seafoam, path, *options):
    code, _, err = seafoam("render", "storm", "-o", path, "--size", "48x27", "--time", "2.5", "--yaw", "0.3", *options)
    assert code == 0, err
    return path


def altered(path, **changes):
    """Write a PNG's pixels with its recipe changed; None: without that member."""
    content = path.read_bytes()
    recipe = json.loads(read_recipe(content)) | changes
    text = PngInfo()
    text.add_itxt("seafoam", json.dumps({name: value for name, value in recipe.items() if value is not None}))
    Image.open(io.BytesIO(content)).save(path, pnginfo=text)
    return path


@pytest.mark.parametrize("format", [format for format in FRAME_FORMATS if format != "npy"])
@pytest.mark.parametrize("options", [(), ("--no-dither", "--precision", "float", "--quality", "high")])
def test_the_same_bytes_are_drawn_again(seafoam, tmp_path, format, options):
    path = drawn(seafoam, tmp_path / f"a.{format}", *options)
    code, out, err = seafoam("render", "--again", path)
    assert (code, err) == (0, "")
    assert "the same" in out
    assert seafoam("render", "--again", path, "-o", tmp_path / "b")[0] == 0
    assert (tmp_path / "b").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("format", ["png", "webp", "exr"])
def test_other_pixels_are_counted(seafoam, tmp_path, monkeypatch, format):
    path = drawn(seafoam, tmp_path / f"a.{format}")
    monkeypatch.setattr(Painter, "spoiled", 7)
    code, out, _ = seafoam("render", "--again", path)
    assert (code, "renderer" in out, "in linear light" in out) == (1, False, format == "exr")
    assert f"pixels: 7 of {48 * 27:,} differ, by at most" in out


def test_what_was_otherwise_is_named_pixels_of_another_size_too(seafoam, tmp_path):
    path = altered(drawn(seafoam, tmp_path / "a.png"), seafoam="0.0.1", renderer="a GPU, 9", plan="0" * 64)
    code, out, _ = seafoam("render", "--again", path)
    assert code == 1
    told = ("version: 0.0.1 then", "renderer: a GPU, 9 then, B, C now", f"plan: {'0' * 64} then", "pixels: the same")
    assert [part for part in told if part not in out] == []
    code, out, _ = seafoam("render", "--again", altered(drawn(seafoam, tmp_path / "a.png"), width=20))
    assert (code, "48 × 27 then, 20 × 27 now" in out) == (1, True)
    # What the page and earlier versions do not write.
    path = drawn(seafoam, tmp_path / "a.png", "--no-dither")
    code, out, _ = seafoam("render", "--again", altered(path, plan=None, format=None, dither=None, preset=None))
    assert (code, "its recipe does not name it" in out, "pixels: the same" in out) == (1, True, True)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"recipe": 2}, "/recipe"), ({"time": 2e9}, "/time"), ({"width": "48"}, "/width"),
        ({"scene": {"water": {"chop": 1}}}, "/scene/water/chop"), ({"width": 9000}, "width must be 1 to 8192"),
        ({"split": {"at": 0.5}}, "two looks side by side"), ({"scene": {"foam": {"mask": "nope"}}}, "mask"),
    ],
)  # fmt: skip
def test_a_recipe_that_cannot_be_drawn_says_why(seafoam, tmp_path, changes, said):
    code, _, err = seafoam("render", "--again", altered(drawn(seafoam, tmp_path / "a.png"), **changes))
    assert (code, err.count("\n")) == (2, 1)
    assert said in err


def test_files_without_a_recipe(seafoam, tmp_path):
    Image.new("RGB", (4, 4)).save(tmp_path / "plain.png")
    (tmp_path / "text").write_text("no picture")
    none = "no PNG, WebP or OpenEXR picture with a recipe"
    for name, status, said in (("plain.png", 2, none), ("text", 2, none), ("none.png", 1, "cannot read")):
        code, _, err = seafoam("render", "--again", tmp_path / name)
        assert (code, said in err) == (status, True)
