"""The presets: named scenes with the words that introduce them."""

import json
from functools import lru_cache
from pathlib import Path
from typing import Literal, get_args

from pydantic import Field

from seafoam.scene.models import Part, Scene

_DIRECTORY = Path(__file__).parent / "presets"

Group = Literal["Seas", "Light and life", "Shores", "Lakes and rivers", "Foam of the paper"]
"""What a preset stands under in the menu, in the menu's order."""


class Preset(Part):
    """A scene worth looking at, and when and how large."""

    name: str
    group: Group = Field(description="Heading of the menu under which the preset is listed")
    order: int = Field(description="Position within its group")
    title: str
    summary: str
    size: tuple[int, int] = Field(description="Recommended width and height, pixels")
    time: float = Field(default=0.0, description="Recommended time, s")
    scene: Scene


@lru_cache(maxsize=1)
def _presets() -> dict[str, Preset]:
    found = [
        Preset.model_validate({"name": path.stem, **json.loads(path.read_text(encoding="utf-8"))})
        for path in sorted(_DIRECTORY.glob("*.json"))
    ]
    return {preset.name: preset for preset in sorted(found, key=_place)}


def _place(preset: Preset) -> tuple[int, int]:
    return get_args(Group).index(preset.group), preset.order


def preset_names() -> tuple[str, ...]:
    """Names of all presets, in the order of the menu."""
    return tuple(_presets())


def load_preset(name: str) -> Preset:
    """A preset by name. Raises ``KeyError`` if there is none."""
    return _presets()[name]
