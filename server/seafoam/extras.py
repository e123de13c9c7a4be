"""Packages that only some uses need, installed by an extra: ``pip install 'seafoam[reports]'``."""

from importlib.util import find_spec

REPORTS = ("matplotlib", "flip_evaluator")
"""What plots and measurements of accuracy need beyond rendering."""


class MissingExtraError(RuntimeError):
    """A package of an extra is not installed. ``remedy``: the command that installs it."""

    def __init__(self, packages: tuple[str, ...], extra: str) -> None:
        self.remedy = f"pip install 'seafoam[{extra}]'"
        super().__init__(f"plots and measurements of accuracy need {' and '.join(packages)}; {self.remedy}")


def require_reports() -> None:
    """Raise :class:`MissingExtraError` unless the packages of the extra ``reports`` are installed."""
    missing = tuple(name.replace("_", "-") for name in REPORTS if find_spec(name) is None)
    if missing:
        raise MissingExtraError(missing, "reports")
