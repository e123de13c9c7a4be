"""Pages that draw many frames, in the browser as users have it."""

import pytest

from support.browser.lanes import Lane


@pytest.fixture(scope="module")
def llvmpipe(optimised: Lane) -> Lane:
    """The renderer, for this folder."""
    return optimised
