"""Errors, options, files and text that commands share.

Consoles have any encoding: what one cannot show is spelt in ASCII instead of ending the command.
"""

import codecs
import io
import math
import re
import sys
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn, TypeVar

import typer
from typer.core import TyperCommand
from typer.exceptions import TyperException

from seafoam.files import write_whole
from seafoam.numerals import numeral

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

ERRORS = "seafoam.spelt"
_SPELT = {
    "×": "x", "·": "*", "−": "-", "–": "-", "—": "-", "→": "->", "≤": "<=", "≥": ">=", "±": "+-", "°": " deg",
    "√": "sqrt", "∞": "inf", "“": '"', "”": '"', "‘": "'", "’": "'", "′": "'", "″": '"', "⁄": "/", "⁻": "-", "µ": "u",
}  # fmt: skip
_CONTROLS = {code: f"\\x{code:02x}" for code in (*range(32), *range(127, 160))}


def spelt(error: UnicodeError) -> tuple[str, int]:
    """Return ASCII for the characters that cannot be encoded, as ``codecs.register_error`` asks for it."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_spelt, error.object[error.start : error.end])), error.end


def _spelt(character: str) -> str:
    if character in _SPELT:
        return _SPELT[character]
    name = unicodedata.name(character, "")
    if name.startswith("GREEK "):
        letter = name.split()[3].lower()
        return letter.capitalize() if character.isupper() else letter
    plain = unicodedata.normalize("NFKD", character).replace("⁄", "/").encode("ascii", "ignore").decode()
    return plain or character.encode("unicode-escape").decode()


def prepare() -> None:
    """Let standard output and errors write any text."""
    codecs.register_error(ERRORS, spelt)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=ERRORS)


def say(text: str, *, err: bool = False) -> None:
    """Print one line: a name of a file may hold newlines and commands of a terminal, which are shown as ``\\x0a``."""
    print(text.translate(_CONTROLS), file=sys.stderr if err else sys.stdout, flush=True)


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
                    raise CommandError(f"{option_of(name)}: {error}, not {given[name]!r}") from error
        return rest


class Serve(Command):
    """``seafoam serve``, whose help lists every setting with its variable and its default."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the usual help, then the settings."""
        super().format_help(ctx, formatter)
        from seafoam.api.settings import SERVED, Settings

        rows = []
        for name, field in Settings.model_fields.items():
            value = SERVED.get(name, field.get_default(call_default_factory=True))
            rows.append((f"SEAFOAM_{name.upper()}", _shown(value), field.description or ""))
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
