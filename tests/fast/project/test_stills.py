"""Pictures that are checked in: a preset's still shows what it starts with, and a page shows each picture of docs."""

import importlib.util
import json
import re
import subprocess
from pathlib import Path

import pytest
from PIL import Image

from seafoam.scene.presets import load_preset, preset_names

ROOT = Path(__file__).parents[3]
WEBCLIENT = ROOT / "webclient"
ALL_STILLS = 1_500_000
"""Most bytes of the presets' stills with their thumbnails and of the chapter's together."""
_SPEC = importlib.util.spec_from_file_location("make_stills", WEBCLIENT / "make_stills.py")
stills = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(stills)


@pytest.mark.parametrize("name", preset_names())
def test_a_preset_has_its_still(name: str) -> None:
    made_for = json.loads(stills.INDEX.read_text(encoding="utf-8"))
    now = {"start": stills.start_of(load_preset(name)), **stills.heading_of(name)}
    assert made_for.get(name) == now, "the preset starts otherwise: make stills"
    for path, form, size, most in (
        (stills.still_of(name), "AVIF", stills.SIZE, 100_000),
        (stills.thumbnail_of(name), "WEBP", stills.SMALL, 12_000),
    ):
        with Image.open(path) as picture:
            assert (picture.format, picture.size) == (form, size)
        assert path.stat().st_size <= most, "a first visit waits for it"


def test_a_clone_has_the_stills_they_are_small_and_nothing_else_lies_there() -> None:
    known = {path for name in preset_names() for path in (stills.still_of(name), stills.thumbnail_of(name))}
    assert set(stills.FOLDER.iterdir()) == known
    assert list(json.loads(stills.INDEX.read_text(encoding="utf-8"))) == list(preset_names())
    command = ["git", "ls-files", "webclient/public/stills", "webclient/public/learn-stills"]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    assert {stills.still_of(name) for name in preset_names()} <= {ROOT / name for name in names}
    assert sum((ROOT / name).stat().st_size for name in names) <= ALL_STILLS


def test_a_page_shows_each_picture_of_docs_and_begins_with_the_first_preset() -> None:
    shown = {
        (page.parent / picture).resolve()
        for page in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md"))
        for picture in re.findall(r"\(([\w./-]*pictures/[\w./-]+)\)", page.read_text(encoding="utf-8"))
    }
    assert {path for path in (ROOT / "docs/pictures").rglob("*") if path.is_file()} == shown
    page = (WEBCLIENT / "index.html").read_text(encoding="utf-8")
    found = re.search(r'data-preset="([\w-]+)"', page)
    assert found[1] == preset_names()[0]
