"""What is cited and compared: versions agree, and docs/paper.md has today's numbers."""

import re
from importlib import import_module, metadata
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


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
