"""GLSL assembly: files and joining functions, in order, after a prologue with the compile-time constants."""

import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, lru_cache

from seafoam.effects.shader import Const, Inline, Piece, SlotFile, Source
from seafoam.framegraph.plan import Shader, SourceFile
from seafoam.planner.slots import Slot
from seafoam.resources import data_dir

PROLOGUE = (
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp usampler2D;\n"
)
PLACE_SHIFTED = "lib/rays.glsl@place_shifted"
"""The same where rows of pixels are shifted against one another."""
FULLSCREEN = ("vertex/vertex.glsl@fullscreen",)
"""The vertex shader of a triangle that covers its target."""
READS = {
    "as_int(": "lib/texels.glsl@as_int",
    "as_bits(": "lib/texels.glsl@as_bits",
    "texel_at(": "lib/texels.glsl@texel",
    "sampler2DArray": "lib/texels.glsl@layer_texel",
}
"""Files that are included first where a shader's source contains such a word."""
PART = re.compile(r"^// @part (\w+)\n", re.MULTILINE)
"""Begins a part of a file, which goes on to the next or to the end."""
_OF_PART = re.compile(r"(?P<file>.+\.glsl)@(?P<part>\w+)")
_WORD = re.compile(r"\b[A-Z][A-Z0-9_]+\b")
Consts = Mapping[str, Const]


@cache
def read_file(path: str) -> str:
    """Return the source of a file of ``shaders/``, or of one of its parts: ``FILE.glsl@PART``.

    Raises ``FileNotFoundError``, and ``KeyError`` for a part that the file does not have.
    """
    named = _OF_PART.fullmatch(path)
    if not named:
        return (data_dir("shaders") / path).read_text(encoding="utf-8")
    return parts_of(named["file"])[named["part"]]


@cache
def parts_of(path: str) -> dict[str, str]:
    """Return the parts of a file of ``shaders/``, by name. What stands before the first is for readers only."""
    _, *found = PART.split((data_dir("shaders") / path).read_text(encoding="utf-8"))
    return {part: f"{text.rstrip()}\n" for part, text in zip(found[::2], found[1::2], strict=True)}


@lru_cache(maxsize=1024)
def source_text(source: Source) -> str:
    """Return the source of a file, its names replaced. Raises ``FileNotFoundError``."""
    text = read_file(source.path)
    for old, new in source.rename:
        text = re.sub(rf"\b{old}\b", new, text)
    return text


def const_line(name: str, value: Const) -> str:
    """Return a GLSL constant; floats have the 9 digits that float32 needs."""
    if isinstance(value, tuple):
        kind = f"int[{len(value)}]"
        return f"const {kind} {name} = {kind}({', '.join(map(str, value))});\n"
    if isinstance(value, bool):
        return f"const bool {name} = {'true' if value else 'false'};\n"
    if isinstance(value, int):
        return f"const int {name} = {value};\n"
    digits = f"{value:.9g}"
    return f"const float {name} = {digits if any(mark in digits for mark in '.e') else digits + '.0'};\n"


def slot_pieces(slot: Slot, chosen: Sequence[SlotFile]) -> list[Piece]:
    """Return the files and joining functions of a slot."""
    files = [file for file in chosen if file.slot == slot.name]
    pieces: list[Piece] = []
    for file in files:
        pieces += [*file.needs, file.path]
    if slot.under and not any(file.slot == slot.under for file in chosen):
        return pieces
    if not files and slot.default is not None:
        pieces.append(slot.default)
    return pieces + [Inline(join.glsl([file.prefix for file in files])) for join in slot.joins]


def assemble(pieces: Iterable[Piece], consts: Consts) -> Shader:
    """Return a shader from files of ``shaders/``, each included once, and inline source.

    Only constants that occur in the source are defined.
    """
    given = tuple(Source(piece) if isinstance(piece, str) else piece for piece in pieces)
    first = (Source(file) for word, file in READS.items() if any(word in _text(piece) for piece in given))
    parts = tuple(dict.fromkeys((*first, *given)))
    words = frozenset[str]().union(*map(_words, parts))
    head = PROLOGUE + "".join(const_line(name, consts[name]) for name in sorted(words & consts.keys()))
    return _shader(head, parts)


def _text(piece: Source | Inline) -> str:
    return source_text(piece) if isinstance(piece, Source) else piece.text


@lru_cache(maxsize=2048)
def _words(piece: Source | Inline) -> frozenset[str]:
    return frozenset(_WORD.findall(_text(piece)))


@lru_cache(maxsize=512)
def _shader(head: str, parts: tuple[Source | Inline, ...]) -> Shader:
    """The shader of a prologue with its constants: plans of one scene at other qualities share most of theirs."""
    text, files = head, []
    for part in parts:
        text += "\n"
        if isinstance(part, Source):
            files.append(SourceFile(path=part.path, line=text.count("\n") + 1))
        text += _text(part)
    return Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=tuple(files))
