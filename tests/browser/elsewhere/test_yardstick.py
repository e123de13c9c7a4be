"""The page that the bench measures against draws water, on the GL that it is said to draw on."""

import pytest
from bench.served import water_page

from support.browser.lanes import Lane


def test_the_yardstick_draws_water(llvmpipe: Lane) -> None:
    with water_page.served() as address:
        three = water_page.shown(llvmpipe.browser, address)
        try:
            frames = three.frames(2)
            assert len(frames.wall) == 2
            assert min(frames.wall) > 0.0
            assert frames.cpu > 0.0
            _, size = three.screenshot()
            assert size > 100_000, "water and sky do not fit into so few bytes"
            three.require("llvmpipe")
            with pytest.raises(RuntimeError, match="and not on SwiftShader"):
                three.require("SwiftShader")
        finally:
            three.close()
