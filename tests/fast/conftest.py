import pytest


@pytest.fixture(scope="session")
def anyio_backend() -> str:
    """Tests that are coroutines run on a loop of asyncio."""
    return "asyncio"
