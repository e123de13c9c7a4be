"""Packages that only some uses need, installed by extras such as ``pip install 'seafoam[reports]'``."""

from importlib.util import find_spec
from typing import Literal

Extra = Literal["reports", "notebook", "video", "cluster", "telemetry"]

REPORTS = ("matplotlib", "flip_evaluator")
"""What plots and measurements of accuracy need beyond rendering."""

_NEEDS: dict[Extra, tuple[str, tuple[str, ...]]] = {
    "reports": ("plots and measurements of accuracy need", REPORTS),
    "notebook": ("the widget for notebooks needs", ("anywidget",)),
    "video": ("MP4 files need", ("av",)),
    "telemetry": ("traces need", ("opentelemetry.sdk", "opentelemetry.exporter.otlp.proto.http")),
    "cluster": ("work on several processes or machines needs", ("distributed",)),
}
"""Extra -> the beginning of the error, and the modules of its packages."""


class UnableError(RuntimeError):
    """This machine lacks what is asked of it; the text says what to do. A command ends with it, exit code 1."""


class MissingExtraError(UnableError):
    """A package of an extra is not installed. ``remedy``: the command that installs it."""

    def __init__(self, packages: tuple[str, ...], extra: Extra) -> None:
        self.remedy = f"pip install 'seafoam[{extra}]'"
        super().__init__(f"{_NEEDS[extra][0]} {' and '.join(packages)}; {self.remedy}")


def require(extra: Extra) -> None:
    """Raise :class:`MissingExtraError` unless the packages of an extra are installed."""
    missing = tuple(name.replace("_", "-") for name in _NEEDS[extra][1] if not _installed(name))
    if missing:
        raise MissingExtraError(missing, extra)


def _installed(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:  # a package above it
        return False
