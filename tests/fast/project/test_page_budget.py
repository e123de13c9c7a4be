"""What a visitor of the page must load before the first picture, and what the page's styles amount to."""

import re
import subprocess
from pathlib import Path

WEB = Path(__file__).parents[3] / "webclient"
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
