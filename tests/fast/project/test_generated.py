"""What is generated, cited or compared, and checked in, is what would be generated now."""

import json
import re
import subprocess
from importlib import import_module, metadata
from pathlib import Path

import pytest
from docs import make_stability

from seafoam.api.app import create_app
from seafoam.effects import EFFECTS
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
