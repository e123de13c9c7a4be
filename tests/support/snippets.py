"""The commands and the Python of README.md and docs: what is in the pages, and what no test runs, with the reason."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = sorted(str(each.relative_to(ROOT)) for each in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
_PROGRAMS = r"make|curl|python|dask|seafoam|pip|npm|docker|\.venv/bin/"
_COMMAND = re.compile(rf"^    (?:[A-Z_]+=\S+ )?((?:{_PROGRAMS})\S* .*?)(?:  +# .*|  \(.*)?$", re.MULTILINE)

NOT_RUN = {
    "make demo": "installs packages and serves until it is stopped; its server is the one that other snippets ask",
    "make test": "runs all tests",
    "make bench": "half an hour; -m bench is run by tests/fast/project/test_bench.py in parts",
    "make gpu": "five minutes, for a machine with a GPU; tests/fast/project/test_bench.py has its parts",
    ".venv/bin/python -m bench": "minutes to half an hour; that its options exist is tested here",
    ".venv/bin/python tests/support/run/spent.py": "reads what the whole of the tests left",
    ".venv/bin/pytest": "the tests themselves; that the files exist is tested here",
    ".venv/bin/python docs/make_stability.py": "needs what browsers measured; test_generated.py has its own",
    ".venv/bin/python docs/make_paper.py": "tests/fast/project/test_generated.py makes the same tables",
    ".venv/bin/python docs/make_tiers.py": "half an hour; tests/fast/accuracy/test_reports.py reads what it wrote",
    "python docs/make_whitecaps.py": "minutes",
    ".venv/bin/python docs/looks/make_second_look.py": "minutes, and an older checkout or frames of a sequence",
    ".venv/bin/seafoam serve": "the server that the other snippets ask",
    ".venv/bin/seafoam accuracy": "minutes; tests/gpu/accuracy measures small ones",
    ".venv/bin/python -c": "docs/python.md begins with the same, and is run",
    ".venv/bin/seafoam sequence": "those of docs/sequences.md are run",
    "seafoam accuracy PRESET": "the same, for every preset",
    "npm pack three": "tests/browser/elsewhere/test_element.py runs the example with the same package",
    "dask ": "a cluster of machines; tests/fast/sequences/test_fleet.py has one in processes",
}
"""Beginnings of commands -> why no test runs them as they stand."""
SMALLER = {
    "--size 1280x720": "--size 64x36 --quality fast",
    "width=1280&height=720": "width=64&height=36&quality=fast",
    "--size 640x360": "--size 64x36",
    "--stop 4": "--stop 0.1",
    "--size 256": "--size 64",
    "size=256": "size=64",
    "render default -o": "render default --size 64x36 --quality fast -o",
}
"""Sizes of README -> those of the tests."""


def text(page: str) -> str:
    """A page's text."""
    return (ROOT / page).read_text(encoding="utf-8")


def blocks(page: str, language: str) -> list[str]:
    """The fenced snippets of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text(page), re.MULTILINE | re.DOTALL)


def commands(page: str) -> list[str]:
    """The indented command lines, without their comments."""
    return [found.strip() for found in _COMMAND.findall(text(page))]


def smaller(command: str) -> str:
    """A command of README with sizes that are drawn at once."""
    for large, small in SMALLER.items():
        command = command.replace(large, small)
    return command
