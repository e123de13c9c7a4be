"""Errors, options, files and text that commands share."""

import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import typer
from typer.core import TyperCommand
from typer.exceptions import TyperException

from seafoam.files import write_whole

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError
    from rich.progress import Progress

_CONTROLS = {code: f"\\x{code:02x}" for code in (*range(32), *range(127, 160))}


def say(text: str, *, err: bool = False) -> None:
    """Print one line: a name of a file may hold newlines and commands of a terminal, which are shown as ``\\x0a``."""
    print(text.translate(_CONTROLS), file=sys.stderr if err else sys.stdout, flush=True)


BAD_INPUT = 2
UNABLE = 1
E = TypeVar("E", bound=str)

OUTPUT = typer.Option("--output", "-o", help="Output file; the extension selects the format.")


class CommandError(TyperException):
    """Ends the command with one line on stderr."""

    def __init__(self, message: str, exit_code: int = BAD_INPUT) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class Serve(TyperCommand):
    """``seafoam serve``, whose help lists every setting with its variable and its default."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the usual help, then the settings."""
        super().format_help(ctx, formatter)
        from seafoam.api.settings import Settings

        rows = []
        for name, field in Settings.model_fields.items():
            value = _shown(field.get_default(call_default_factory=True))
            rows.append((f"SEAFOAM_{name.upper()}", value, field.description or ""))
        columns = ("variable", "default", "setting")
        print_table(rows, *columns, unwrapped="variable", markup=False, emoji=False, highlight=False)


def print_table(rows: Iterable[Sequence[str]], *columns: str, unwrapped: str = "", **console: bool) -> None:
    """Print rows under the names of their columns. unwrapped: the column whose cells stay on one line."""
    from rich.console import Console
    from rich.table import Column, Table

    table = Table(*(Column(name, no_wrap=name == unwrapped) for name in columns), box=None, pad_edge=False)
    for row in rows:
        table.add_row(*row)
    Console(**console).print(table)  # type: ignore[arg-type]


def progress_bar() -> "Progress":
    """Return a bar on standard errors, which is gone when the work is done; none where that is no terminal."""
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    return Progress(console=console, transient=True, disable=not console.is_terminal)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return ",".join(value)
    return "" if value is None else f"{value:g}" if isinstance(value, float) else str(value)


def refuse(error: "ValidationError", model: "type[BaseModel]", option: Any) -> NoReturn:
    from seafoam.api.http.problems import allowed_at, describe_allowed

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


def option_of(field: str) -> str:
    return "--size" if field in ("width", "height") else f"--{field.replace('_', '-')}"


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
