"""What is generated, cited or compared, and checked in, is what would be generated now; what a first visit loads."""

import importlib.util
import json
import re
import subprocess
from importlib import import_module, metadata
from pathlib import Path

import pytest
from docs import make_nature, make_stability
from docs.nature import laws
from docs.sizing import measured_times, moments, renders, workers_for
from PIL import Image

from seafoam.api.app import create_app
from seafoam.effects import EFFECTS
from seafoam.scene import load_preset, preset_names
from support.cases import cases_of

ROOT = Path(__file__).parents[3]
WEB = ROOT / "webclient"


def test_the_openapi_document_is_the_apis() -> None:
    written = json.loads((WEB / "openapi.json").read_text(encoding="utf-8"))
    assert written == json.loads(json.dumps(create_app().openapi())), "run make docs"


def test_the_clients_types_are_of_that_document(tmp_path: Path) -> None:
    made = tmp_path / "api.ts"
    script = json.loads((WEB / "package.json").read_text(encoding="utf-8"))["scripts"]["types"]
    words = [str(made) if word == "src/generated/api.ts" else word for word in script.split()]
    command = [WEB.parent / "scripts" / "node.sh", *words]
    subprocess.run(command, cwd=WEB, check=True, capture_output=True)
    assert made.read_text() == (WEB / "src" / "generated" / "api.ts").read_text(), "run make docs"


def test_the_table_of_hard_cases_is_the_effects() -> None:
    figures = json.loads(make_stability.FIGURES.read_text(encoding="utf-8"))
    cases = [case for effect in EFFECTS for case in cases_of(effect).hard]
    stale = [case.name for case in cases if figures.get(case.name, {}).get("of") != make_stability.drawn(case)]
    assert not stale, "measure them: docs/make_stability.py says how"
    assert set(figures) == {case.name for case in cases}
    page = make_stability.PAGE.read_text(encoding="utf-8")
    assert page == make_stability.filled(page, figures), "run python docs/make_stability.py"


def test_the_version_is_cited() -> None:
    version = metadata.version("seafoam")
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.findall(r"^version: (.+)$", cited, re.MULTILINE) == [version]
    assert f"version = {{{version}}}" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "Paper" in {url.split(",")[0] for url in metadata.metadata("seafoam").get_all("Project-URL", [])}


def test_the_papers_numbers_are_todays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    made = import_module("make_paper")
    page = made.PAGE.read_text(encoding="utf-8")
    for name, table in (("saturations", made.saturations), ("spectra", made.spectra)):
        assert f"<!-- paper: {name} -->\n{table()}<!-- end -->" in page


ALL_STILLS = 1_500_000
"""Most bytes of the presets' stills with their thumbnails and of the chapter's together."""
_SPEC = importlib.util.spec_from_file_location("make_stills", WEB / "make_stills.py")
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
    page = (WEB / "index.html").read_text(encoding="utf-8")
    found = re.search(r'data-preset="([\w-]+)"', page)
    assert found[1] == preset_names()[0]


DIST = WEB / "dist"
SCRIPT = 90_000
"""Most bytes of script for stage and settings, Brotli."""
STILL = 150_000
"""Most bytes of all that the first still and the page round it take."""
STYLES = 900
"""Style sheets written by hand have fewer lines; the others are made of the classes in the markup."""
LONGEST_LINE = 130
"""Of a style sheet: what many lines say is not said by a few long ones."""


def weight(name: str) -> int:
    compressed = DIST / f"{name}.br"
    return (compressed if compressed.exists() else DIST / name).stat().st_size


def linked(kinds: str) -> list[str]:
    """Files that the page's HTML names, in order: what it loads at once, and all that this imports."""
    html = (DIST / "index.html").read_text(encoding="utf-8")
    return re.findall(rf'(?:src|href)="\./([^"]+\.(?:{kinds}))"', html)


def named(prefix: str) -> set[str]:
    return {f"assets/{file.name}" for file in (DIST / "assets").glob(f"{prefix}-*.js")}


def test_stage_and_settings_are_light() -> None:
    pane = named("pane")
    assert len(pane) == 1
    assert not pane & set(linked("js")), "the settings' pane is loaded when they are opened"
    assert sum(map(weight, set(linked("js")) | pane)) <= SCRIPT


def test_the_first_still_and_the_page_round_it_are_light_and_it_is_asked_for_before_all_else() -> None:
    assert sum(map(weight, set(linked("js|css")) | {"index.html", "stills/default.avif"})) <= STILL
    # Scripts behind the style sheets wait for these.
    assert linked("js|css|avif")[0] == "still.js"


def test_surfaces_and_laboratories_are_loaded_when_opened() -> None:
    later = {"panel": "accuracy", "surface": "plan and take home", "linechart": "charts"}
    for prefix, what in later.items():
        assert named(prefix), f"no file of {what}: the names have changed"
        assert not named(prefix) & set(linked("js")), f"{what} would be loaded with the page"


def test_few_styles_are_written_by_hand() -> None:
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.css"]
    names = subprocess.run(command, cwd=WEB, check=True, capture_output=True, text=True).stdout.split()
    lines = [line for name in names if (WEB / name).exists() for line in (WEB / name).read_text("utf-8").splitlines()]
    assert 0 < len(lines) < STYLES
    assert max(map(len, lines)) <= LONGEST_LINE


NATURE = json.loads(make_nature.FIGURES.read_text(encoding="utf-8"))


def test_the_figures_are_of_the_presets_and_in_the_page() -> None:
    stale = [name for name, of in NATURE.items() if of["of"] != make_nature.measured_of(load_preset(name))]
    assert not stale, "run python docs/make_nature.py"
    assert tuple(NATURE) == make_nature.PRESETS
    page = make_nature.PAGE.read_text(encoding="utf-8")
    assert page == make_nature.filled(page, NATURE), "run python docs/make_nature.py"


def test_nine_of_ten_quantities_lie_within_what_was_published() -> None:
    """Every sea that is measured has more than half of its own there, too."""
    rows = laws.rows(NATURE)
    inside = [row.preset for row in rows if row.side == "within"]
    assert len(inside) >= 0.9 * len(rows)
    for name in make_nature.PRESETS:
        assert inside.count(name) > 0.5 * sum(row.preset == name for row in rows)


def test_the_documents_table_is_what_the_module_says() -> None:
    text = (Path(__file__).parents[3] / "docs" / "operations.md").read_text(encoding="utf-8")
    rows = re.findall(r"(?m)^\| ([\d,]+) \| (\d+) % \| ([\d.]+) \| (\d+) \| (\d+) % \|", text)
    assert len(rows) == 9
    service, variation = moments(measured_times())
    for visitors, hits, rate, workers, busy in rows:
        queue = workers_for(renders(float(visitors.replace(",", "")), 5.0, 0.01 * int(hits)), service, variation)
        assert (f"{queue.rate:.3g}", queue.workers, round(100 * queue.load)) == (rate, int(workers), int(busy))
