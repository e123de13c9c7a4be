"""Errors, options and files that commands share."""

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn, TypeVar

import typer
from typer.core import TyperCommand
from typer.exceptions import TyperException

from seafoam.files import write_whole
from seafoam.numerals import numeral

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

BAD_INPUT = 2
UNABLE = 1
E = TypeVar("E", bound=str)

Output = Annotated[Path, typer.Option("--output", "-o", help="Output file; the extension selects the format.")]


class CommandError(TyperException):
    """Ends the command with one line on stderr."""

    def __init__(self, message: str, exit_code: int = BAD_INPUT) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class Command(TyperCommand):
    """A command whose options take numbers as the API's parameters do."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the arguments. Raises :class:`CommandError` for a number that is written in another way."""
        given = self.make_parser(ctx).parse_args(args=list(args))[0]
        rest = super().parse_args(ctx, args)
        for name, value in ctx.params.items():
            # What is not finite is refused with the allowed range.
            if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
                try:
                    numeral(given.get(name))
                except ValueError as error:
                    option = f"--{name.replace('_', '-')}"
                    raise CommandError(f"{option}: {error}, not {given[name]!r}") from error
        return rest


class Serve(Command):
    """``seafoam serve``, whose help lists every setting with its variable and its default."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the usual help, then the settings."""
        super().format_help(ctx, formatter)
        from rich.console import Console
        from rich.table import Column, Table

        from seafoam.api.settings import SERVED, Settings

        table = Table(Column("variable", no_wrap=True), "default", "setting", box=None, pad_edge=False)
        for name, field in Settings.model_fields.items():
            value = SERVED.get(name, field.get_default(call_default_factory=True))
            table.add_row(f"SEAFOAM_{name.upper()}", _shown(value), field.description)
        Console(markup=False, emoji=False, highlight=False).print(table)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return ",".join(value)
    return "" if value is None else f"{value:g}" if isinstance(value, float) else str(value)


def refuse(error: "ValidationError", model: "type[BaseModel]", option: Any) -> NoReturn:
    from seafoam.api.http.schema_limits import allowed_at, describe_allowed

    schema: Mapping[str, Any] = model.model_json_schema()
    lines = []
    for item in error.errors():
        message = item["msg"].removeprefix("Value error, ")
        if not item["loc"]:
            lines.append(message)
            continue
        field = str(item["loc"][0])
        if schema["properties"][field].get("writeOnly"):
            # A secret: what it is must not reach a log.
            lines.append(f"{option(field)}: {message}")
            continue
        allowed = allowed_at(schema, schema, (field,))
        may_be = f" (allowed: {describe_allowed(allowed)})" if allowed else ""
        lines.append(f"{option(field)}: {item['input']!r} is not allowed{may_be}")
    raise CommandError("; ".join(lines)) from error


def extension_of(path: Path, known: Sequence[E]) -> E:
    for name in known:
        if path.suffix.lower() == f".{name}":
            return name
    endings = ", ".join(f".{name}" for name in known)
    raise CommandError(f"--output: {path.name!r} must end in one of {endings}")


def member_of(text: str, known: Sequence[E], option: str) -> E:
    """The name that an option was given. Raises :class:`CommandError` for one that is not known."""
    for name in known:
        if text == name:
            return name
    raise CommandError(f"{option}: must be one of {'; '.join(known)}, not {text!r}")


def size_of(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"([0-9]{1,6})[x×]([0-9]{1,6})", text)
    if match is None:
        raise CommandError(f"--size: must be WIDTHxHEIGHT in pixels, such as 1280x720, not {text!r}")
    return int(match[1]), int(match[2])


def write(path: Path, content: bytes) -> None:
    try:
        write_whole(path, content)
    except OSError as error:
        raise CommandError(f"--output: cannot write {path}: {error.strerror}", UNABLE) from error
