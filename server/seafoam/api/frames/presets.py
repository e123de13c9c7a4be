"""Presets that requests name."""

from typing import Annotated

from fastapi import Path

from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError
from seafoam.scene.presets import Preset, load_preset, preset_names

PresetName = Annotated[
    str, Path(description="Name of a preset; /api/presets lists them", examples=["default"], max_length=80)
]


def find_preset(name: str) -> Preset:
    """Return a preset by name. Raises :class:`NotFoundError` with the available names."""
    try:
        return load_preset(name)
    except KeyError:
        raise NotFoundError(f"preset {name!r} was not found", "preset", preset_names()) from None


def known_preset(name: str | None) -> None:
    """Check the name in a body's member ``preset``. Raises :class:`BadRequestError` with the available names."""
    if name is not None and name not in preset_names():
        allowed = {"enum": list(preset_names())}
        raise BadRequestError(
            FieldProblem(pointer="/preset", detail=f"/preset: preset {name!r} was not found", allowed=allowed)
        )
