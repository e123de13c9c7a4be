"""What axe finds wrong with a page for people who use a keyboard or a screen reader."""

from pathlib import Path
from typing import Any

from playwright.sync_api import Page

from support.browser.visits import OVER

AXE = (Path(__file__).parents[3] / "webclient/node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")
# Colours are judged once nothing fades any more.
FINDS = """(async (over) => {
  while (!document.getAnimations().every(over)) await new Promise((done) => setTimeout(done, 50));
  const { violations } = await axe.run({ resultTypes: ['violations'] });
  return violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 120))]);
})"""


def violations(page: Page) -> list[Any]:
    """Rule and places of all that axe finds in what is in sight."""
    page.evaluate(AXE)
    return page.evaluate(f"{FINDS}({OVER})")
