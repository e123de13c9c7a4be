"""Loops of a GLSL program, in the order in which they run once every function is inlined."""

import re
from collections.abc import Iterator

_COMMENT = re.compile(r"//[^\n]*")
_FUNCTION = re.compile(r"^\w+\s+(\w+)\([^;{]*\)\s*\{", re.MULTILINE)
_STEP = re.compile(r"\b(for|while|do)\b|\b(\w+)\s*\(")


def longest_chain(text: str) -> int:
    """Most loops of a program that follow one another with no loop inside any of them."""
    plain = _COMMENT.sub("", text)
    bodies: dict[str, list[str]] = {}
    for match in _FUNCTION.finditer(plain):
        bodies.setdefault(match.group(1), []).append(_enclosed(plain, match.end() - 1))
    longest = chain = 0
    for nested in _loops("main", bodies, ()):
        chain = 0 if nested else chain + 1
        longest = max(longest, chain)
    return longest


def _loops(name: str, bodies: dict[str, list[str]], inside: tuple[str, ...]) -> Iterator[bool]:
    """For each loop that a call of ``name`` runs, whether another is inside it. Overloads count as one function."""
    for body in bodies[name]:
        yield from _of(body, bodies, (*inside, name))


def _of(body: str, bodies: dict[str, list[str]], inside: tuple[str, ...]) -> Iterator[bool]:
    at = 0
    while match := _STEP.search(body, at):
        at = match.end()
        if match.group(1):
            head = "" if match.group(1) == "do" else _enclosed(body, body.index("(", at))
            at += len(head) + (body.index("(", at) - at + 2 if head else 0)
            if match.group(1) == "while" and body[at:].lstrip().startswith(";"):
                continue  # the end of a do
            start = body.index("{", at)
            block = _enclosed(body, start)
            at = start + len(block) + 2
            yield any(True for _ in _of(f"{head};{block}", bodies, inside))
        elif match.group(2) in bodies and match.group(2) not in inside:
            yield from _loops(match.group(2), bodies, inside)


def _enclosed(text: str, start: int) -> str:
    """What stands between the bracket at ``start`` and the one that closes it."""
    pair = "(){}"["({".index(text[start]) * 2 :][:2]
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] == pair[0]) - (text[at] == pair[1])
        if depth == 0:
            return text[start + 1 : at]
    raise ValueError("a bracket is never closed")
