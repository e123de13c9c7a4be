"""GLSL assembly: files and joining functions, in order, after one prologue with the compile-time numbers."""

import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, lru_cache

from seafoam.effects.contribution import Const, SlotFile
from seafoam.plan.model import Shader, SourceFile
from seafoam.plan.slots import Slot
from seafoam.resources import data_dir

PROLOGUE = (
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp usampler2D;\n"
)

_UNIFORM = re.compile(r"^uniform\s+(?P<type>\w+)\s+(?P<name>\w+)", re.MULTILINE)
_WORD = re.compile(r"\b[A-Z][A-Z0-9_]+\b")
_SAMPLERS = ("sampler2D", "usampler2D")

Consts = Mapping[str, Const]


@cache
def read_file(path: str) -> str:
    """Return the source of a file of ``shaders/``. Raises ``FileNotFoundError``."""
    return (data_dir("shaders") / path).read_text(encoding="utf-8")


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


def slot_pieces(slot: Slot, chosen: Sequence[SlotFile]) -> list[str]:
    """Return the files and joining functions of a slot: paths unchanged, source text after ``=``."""
    files = [file for file in chosen if file.slot == slot.name]
    pieces: list[str] = []
    for file in files:
        pieces += [*file.needs, file.path]
    if slot.under and not any(file.slot == slot.under for file in chosen):
        return pieces
    if not files and slot.default:
        pieces.append(slot.default)
    return pieces + ["=" + join.glsl([file.prefix for file in files]) for join in slot.joins]


def assemble(pieces: Iterable[str], consts: Consts) -> Shader:
    """A shader from files of ``shaders/`` (each once) and joining functions (pieces that start with ``=``).

    Only the constants that the text names are defined. A path may end in ``?old=new``: the file's function ``old`` is
    called ``new`` there, so that another file can stand in its place and call it; ``&`` joins several such.
    """
    parts: list[tuple[str, str]] = []
    seen: set[str] = set()
    for piece in pieces:
        if piece.startswith("="):
            parts.append(("", piece[1:]))
        elif piece not in seen:
            seen.add(piece)
            path, _, renamed = piece.partition("?")
            text = read_file(path)
            for pair in filter(None, renamed.split("&")):
                old, _, new = pair.partition("=")
                text = re.sub(rf"\b{old}\b", new, text)
            parts.append((path, text))
    words = frozenset[str]().union(*(_words(text) for _, text in parts))
    text = PROLOGUE + "".join(const_line(name, consts[name]) for name in sorted(words & consts.keys()))
    files: list[SourceFile] = []
    for path, part in parts:
        text += "\n"
        if path:
            files.append(SourceFile(path=path, line=text.count("\n") + 1))
        text += part
    return Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=tuple(files))


@lru_cache(maxsize=1024)
def _words(text: str) -> frozenset[str]:
    return frozenset(_WORD.findall(text))


@lru_cache(maxsize=1024)
def _declared(text: str) -> tuple[tuple[str, bool], ...]:
    return tuple((match["name"], match["type"] in _SAMPLERS) for match in _UNIFORM.finditer(text))


def declared_uniforms(shader: Shader) -> dict[str, bool]:
    """Return the uniforms that the source declares, and whether each is a sampler."""
    return dict(_declared(shader.text))
