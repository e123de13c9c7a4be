"""Presets: named scenes with title and summary."""

import json
from functools import cache
from pathlib import Path
from typing import Any, Literal, get_args

from pydantic import Field

from seafoam.scene.base import Part
from seafoam.scene.models import Scene

_DIRECTORY = Path(__file__).parent / "presets"
Group = Literal["Seas", "Light and objects", "Shores", "Lakes and rivers", "Figures of the paper"]
"""Headings of the menu under which presets are listed, in menu order."""


class Preset(Part):
    """A named scene with a recommended time and size."""

    name: str
    group: Group = Field(description="Heading of the menu under which the preset is listed")
    order: int = Field(description="Position within its group")
    title: str
    summary: str
    size: tuple[int, int] = Field(description="Recommended width and height, pixels")
    time: float = Field(default=0.0, description="Recommended time, s")
    scene: Scene


@cache
def _documents() -> dict[str, dict[str, Any]]:
    """What the files say, by name in menu order. A preset is validated when it is asked for: most need only one."""
    found = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(_DIRECTORY.glob("*.json"))}
    groups = get_args(Group)
    return dict(sorted(found.items(), key=lambda item: (groups.index(item[1]["group"]), item[1]["order"])))


def preset_names() -> tuple[str, ...]:
    return tuple(_documents())


@cache
def load_preset(name: str) -> Preset:
    """Return a preset by name. Raises ``KeyError`` if there is none."""
    return Preset.model_validate({"name": name, **_documents()[name]})
