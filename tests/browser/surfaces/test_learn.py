"""The chapter "How foam pops" and the foam laboratory, as a visitor reads and moves them."""

import re
from urllib.parse import urldefrag, urljoin, urlsplit

import numpy as np
from playwright.sync_api import Locator, Page

from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import FINGER, PHONE, TARGETS, Pixels, differs, pixels_of, visit

FIGURES = ("saturation", "threshold", "popping", "masks", "equations", "picture")
MOVING = ("popping", "picture")
DESKTOP = (1024, 800)
LEARN, LABORATORY = "learn", "learn/laboratory/"
PAGES = {LEARN: "", LABORATORY: "#strips[data-live=true]", "masks/": ".side[aria-busy=false]"}
"""What each has once it is whole."""
IN_SIGHT = """(plate) => {
  const canvas = [...plate.querySelectorAll('canvas')].at(-1);
  if (canvas === undefined || canvas.width === 0) return '';
  const copy = new OffscreenCanvas(64, 64);
  copy.getContext('2d').drawImage(canvas, 0, 0, 64, 64);
  return [...copy.getContext('2d').getImageData(0, 0, 64, 64).data].join();
}"""
"""What the plate's last canvas shows, small."""


def seen(page: Page, name: str) -> Locator:
    """A figure, in view and live."""
    figure = page.locator(f"figure[data-figure={name}]")
    figure.locator(".plate").scroll_into_view_if_needed()
    page.wait_for_function(
        "(name) => document.querySelector(`figure[data-figure=${name}]`).dataset.live === 'true'", arg=name
    )
    return figure


def test_the_chapter_reads_without_a_script_and_every_link_leads_to_what_it_names(llvmpipe: Lane, server: str) -> None:
    texts: dict[str, str] = {}
    links = set()
    with visit(llvmpipe, server, LEARN, size=DESKTOP, settle=False, java_script_enabled=False) as made:
        page = made.page
        assert page.url == f"{server}/{LEARN}/"
        assert len(page.inner_text("main").split()) > 700
        assert page.locator("math").count() >= 8
        # A picture stands in for each figure.
        pictures = page.locator("figure[data-figure] img")
        assert pictures.count() == len(FIGURES)
        assert all(
            pictures.evaluate_all("(all) => all.map(({ naturalWidth, alt }) => naturalWidth && alt.length > 40)")
        )
        # Every formula has its code beside it.
        for formula in page.locator(".formula-block").all():
            assert formula.locator("a[href*='source/']").count() >= 1
        for start in (f"{server}/{LEARN}/", f"{server}/{LABORATORY}"):
            page.goto(start)
            named = page.locator("a[href], noscript a").all()
            links |= {urljoin(start, link.get_attribute("href") or "") for link in named}
        assert sum("/source/" in link for link in links) >= 20
        for link in sorted(links):
            address, fragment = urldefrag(link)
            assert urlsplit(address).netloc == urlsplit(server).netloc, "nothing lies elsewhere"
            if address not in texts:
                response = page.request.get(address)
                assert response.status == 200, link
                texts[address] = response.text()
            if "/source/" in address:
                assert fragment, link
                assert f'id="{fragment}"' in texts[address], link


def shown(figure: Locator) -> Pixels:
    """What a figure shows on the screen, (height, width, 3)."""
    return pixels_of(figure.locator(".plate").screenshot())


def test_figures_live_while_they_are_seen_and_bubbles_pop_in_the_laboratory(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, LEARN, size=DESKTOP, settle=False) as made:
        page = made.page
        assert page.locator("figure[data-figure=picture][data-live]").count() == 0, "it starts when it is near"
        for name in FIGURES:
            figure = seen(page, name)
            assert figure.locator("img").count() == 0
            if name not in MOVING:
                continue
            before, time = shown(figure), figure.get_attribute("data-time")
            assert len(np.unique(before.reshape(-1, 3), axis=0)) > 16, "something is drawn"
            page.wait_for_function(
                "([name, time]) => +document.querySelector(`[data-figure=${name}]`).dataset.time > +(time ?? 0) + 0.2",
                arg=[name, time],
            )
            assert differs(shown(figure), before) > 0.005
        # The first figures are out of view by now: their time stands.
        first = page.locator("figure[data-figure=saturation]")
        stood = first.get_attribute("data-time")
        last = page.locator("figure[data-figure=picture]")
        moved = last.get_attribute("data-time")
        page.wait_for_function(
            "(moved) => document.querySelector('figure[data-figure=picture]').dataset.time !== moved", arg=moved
        )
        assert first.get_attribute("data-time") == stood
        page.goto(f"{server}/{LABORATORY}")
        page.locator("#strips[data-live=true]").wait_for()
        assert page.locator("#strips .strip").count() == 6
        page.wait_for_function(
            "() => [...document.querySelectorAll('.strip .rate')].every((rate) => /^[1-9]/.test(rate.textContent))"
        )
        page.get_by_role("button", name="Pause").click()
        assert "paused=1" in page.url
        page.set_viewport_size({"width": 1440, "height": 900})
        assert page.evaluate("() => document.documentElement.scrollHeight") <= 900, "one screen"


def changes(page: Page) -> None:
    """The chapter's controls change its figures, which stand until they are asked."""
    figure = seen(page, "saturation")
    plate = figure.locator(".plate")
    still = plate.evaluate(IN_SIGHT)
    page.evaluate("() => new Promise((done) => setTimeout(done, 300))")
    assert plate.evaluate(IN_SIGHT) == still
    figure.get_by_role("slider", name="K, sharpness").fill("7")
    page.wait_for_function(f"([plate, still]) => ({IN_SIGHT})(plate) !== still", arg=[plate.element_handle(), still])
    figure = seen(page, "masks")
    caption = figure.locator(".patches p").first
    even = caption.inner_text()
    figure.get_by_role("combobox", name="First mask").select_option("white")
    page.wait_for_function("([caption, even]) => caption.innerText !== even", arg=[caption.element_handle(), even])
    assert figure.locator(".plate canvas").first.is_visible()
    spreads = [float(re.search(r"±([\d.]+)", text)[1]) for text in (even, caption.inner_text())]
    assert spreads[0] < 0.3 * spreads[1], "blue noise covers boxes evenly, white noise does not"
    figure = seen(page, "picture")
    figure.get_by_role("radio", name="Filtered").check(force=True)
    page.locator("[data-look=filtered]").wait_for()


def test_chapter_and_laboratories_work_fit_a_phone_and_axe_finds_nothing(llvmpipe: Lane, server: str) -> None:
    """By day and by night."""
    context = {"reduced_motion": "reduce", "has_touch": True, "is_mobile": True}
    with visit(llvmpipe, server, LEARN, size=PHONE, settle=False, **context) as made:
        page = made.page
        for path, live in PAGES.items():
            if path == LEARN:
                changes(page)
            else:
                page.goto(f"{server}/{path}")
                page.locator(live).first.wait_for(timeout=60_000)
            for scheme in ("dark", "light"):
                page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
                assert violations(page) == [], (path, scheme)
            assert page.evaluate("() => document.documentElement.scrollWidth") <= PHONE[0], path
            assert [one for one in page.evaluate(TARGETS) if one[2] < FINGER] == [], path
