"""What a start imports: names and numbers of modules, which decide its time on any machine."""

import pytest

from support.command import imported

HELP = "from seafoam.cli import main; main(['--help'])"
RENDER = """
from seafoam.cli import app, frames
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset
make_plan(load_preset("default").scene, TIERS["standard"])
"""
"""What `seafoam render` does before it draws."""
HEAVY = {
    "IPython", "OpenEXR", "PIL", "anywidget", "asyncio", "av", "distributed", "fastapi", "isal", "matplotlib",
    "moderngl", "multiprocessing", "numpy", "opentelemetry", "pebble", "prometheus_client", "pydantic",
    "pydantic_settings", "rich", "scipy", "starlette", "typer", "uvicorn",
}  # fmt: skip
"""Packages that take long to import, or that only some uses need."""


@pytest.mark.parametrize(
    ("code", "packages", "most"),
    [
        ("import seafoam", set(), 40),
        (HELP, {"typer", "rich"}, 300),
        (RENDER, {"typer", "pydantic", "numpy", "moderngl", "isal"}, 580),
    ],
    ids=["import", "help", "render"],
)
def test_a_start_imports_little(code: str, packages: set[str], most: int) -> None:
    found = imported(code)
    assert {name.partition(".")[0] for name in found} & HEAVY <= packages
    assert len(found) <= most, f"{len(found)} modules"


def test_parts_that_a_frame_does_not_need_are_not_imported() -> None:
    others = ("seafoam.accuracy", "seafoam.reference", "seafoam.sequences", "seafoam.library", "seafoam.notebook")
    assert [name for name in imported(RENDER) if name.startswith(others)] == []
