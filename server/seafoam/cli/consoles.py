"""Text on consoles of any encoding: what one cannot show is spelt in ASCII instead of ending the command."""

import codecs
import io
import sys
import unicodedata

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
