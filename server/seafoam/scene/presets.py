"""The presets: named scenes with the words that introduce them."""

import json
from functools import lru_cache
from pathlib import Path

from pydantic import Field

from seafoam.scene.models import Part, Scene

_DIRECTORY = Path(__file__).parent / "presets"


class Preset(Part):
    """A scene worth looking at, and when and how large."""

    name: str
    order: int = Field(description="Place in the menu")
    title: str
    summary: str
    size: tuple[int, int] = Field(description="Width and height it was made for, pixels")
    time: float = Field(default=0.0, description="A time at which it looks its best, s")
    scene: Scene


@lru_cache(maxsize=1)
def _presets() -> dict[str, Preset]:
    found = [
        Preset.model_validate({"name": path.stem, **json.loads(path.read_text(encoding="utf-8"))})
        for path in sorted(_DIRECTORY.glob("*.json"))
    ]
    return {preset.name: preset for preset in sorted(found, key=lambda preset: preset.order)}


def preset_names() -> tuple[str, ...]:
    """Names of all presets, in the order of the menu."""
    return tuple(_presets())


def load_preset(name: str) -> Preset:
    """A preset by name. Raises ``KeyError`` if there is none."""
    return _presets()[name]
