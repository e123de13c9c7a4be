"""The chapter "How foam pops" and the foam laboratory, as a visitor reads and moves them."""

import re
from urllib.parse import parse_qsl, urldefrag, urljoin, urlsplit

import numpy as np
import pytest
from playwright.sync_api import Locator, Page

from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import BLANK, FINGER, PHONE, TARGETS, Pixels, differs, pixels_of, visit

FIGURES = ("saturation", "threshold", "popping", "masks", "equations", "picture")
MOVING = ("saturation", "threshold", "popping", "equations", "picture")
DESKTOP = (1440, 900)
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
        text = page.inner_text("main")
        assert len(text.split()) > 700
        for said in (
            "Foam does not fade",
            "spread a table of numbers",
            "Equation 2",
            "white noise",
            "What to take home",
        ):
            assert said in text
        assert page.locator("math").count() >= 8
        assert page.locator("figure[data-figure]").count() == len(FIGURES)
        # Each with a picture that stands in for it.
        for picture in page.locator("figure img").all():
            response = page.request.get(urljoin(page.url, picture.get_attribute("src") or ""))
            assert response.headers["content-type"] == "image/webp"
            assert len(picture.get_attribute("alt") or "") > 40
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
        height = page.evaluate("() => document.documentElement.scrollHeight")
        assert height <= DESKTOP[1], "one screen"


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


def test_without_webgl_the_picture_stands(llvmpipe: Lane, server: str) -> None:
    blind = (
        "HTMLCanvasElement.prototype.getContext = ((own) => function (kind, ...rest) {"
        " return kind === 'webgl2' ? null : own.call(this, kind, ...rest); })(HTMLCanvasElement.prototype.getContext);"
    )
    with visit(llvmpipe, server, BLANK, size=DESKTOP, settle=False) as made:
        page = made.page
        page.add_init_script(blind)
        page.goto(f"{server}/{LEARN}/")
        figure = page.locator("figure[data-figure=picture]")
        figure.scroll_into_view_if_needed()
        page.locator("figure[data-figure=picture][data-live=false]").wait_for()
        assert figure.locator("img").is_visible()
        assert "WebGL 2 is not available" in figure.inner_text()
        seen(page, "equations")


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_chapter_and_laboratories_work_fit_and_axe_finds_nothing(
    llvmpipe: Lane, server: str, size: tuple[int, int]
) -> None:
    """By day on a desktop, by night on a phone."""
    phone = size == PHONE
    context = {"reduced_motion": "reduce", "color_scheme": "dark" if phone else "light"}
    with visit(llvmpipe, server, LEARN, size=size, settle=False, has_touch=phone, is_mobile=phone, **context) as made:
        page = made.page
        for path, live in PAGES.items():
            if path != LEARN:
                page.goto(f"{server}/{path}")
                page.locator(live).first.wait_for(timeout=60_000)
            elif phone:
                for name in FIGURES:
                    seen(page, name)
            else:
                changes(page)
            assert violations(page) == [], path
            assert page.evaluate("() => document.documentElement.scrollWidth") <= size[0], path
            assert not phone or [one for one in page.evaluate(TARGETS) if one[2] < FINGER] == [], path


def test_the_laboratory_is_in_its_address(llvmpipe: Lane, server: str) -> None:
    address = f"{LABORATORY}#c=9&k=5&mask=bubble&fade=0.4&paused=1&time=3.25&base=99"
    with visit(llvmpipe, server, address, size=DESKTOP, settle=False) as made:
        page = made.page
        page.locator("#strips[data-live=true]").wait_for()
        assert page.get_by_role("slider", name="C, divisor").get_attribute("aria-valuetext") == "9.0"
        assert page.get_by_role("combobox", name="Mask", exact=True).input_value() == "bubble"
        # Out of range: as at the start.
        assert page.get_by_role("slider", name="E, rise and fall").get_attribute("aria-valuetext") == "2.72"
        strips = page.locator("#strips")
        before = strips.evaluate(IN_SIGHT)
        page.get_by_role("button", name="listing").click()
        page.wait_for_function(
            f"([strips, before]) => ({IN_SIGHT})(strips) !== before", arg=[strips.element_handle(), before]
        )
        state = page.url
        assert dict(parse_qsl(urlsplit(state).fragment)) == {
            **{"c": "9", "k": "5", "mask": "bubble", "fade": "0.4", "paused": "1", "time": "3.250"},
            **{"delta": "1.07", "base": "2.718"},
        }
        shown = strips.evaluate(IN_SIGHT)
        page.goto(BLANK)
        page.goto(state)
        page.locator("#strips[data-live=true]").wait_for()
        assert page.locator("#strips").evaluate(IN_SIGHT) == shown, "the link restores the picture"
