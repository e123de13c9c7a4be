"""A GPU's compiler takes every program, and none of them gets worse than the checked-in table admits."""

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import pytest
from bench import compiler
from bench.compiler import Compiled, Use, compiled, gone, not_admitted, read_table, uses, worse
from bench.radv import Figures

from seafoam.quality import TIERS, Tier
from seafoam.scene import preset_names
from support.report import Report
from support.sweep import crossed, spread

HELD: tuple[Tier, ...] = ("fast", "standard")
"""The tiers that a GPU draws in motion; all four take twice as long, and the bench compiles them."""

SHARES = 10
"""Of the presets; one of them is compiled, at one tier, but for the sweep."""

CHAIN = 10
"""Loops in a row at most: llvmpipe counts the turns of all loops of a program in one integer, and LLVM's loop strength
reduction takes twice as long for each loop that follows another without one inside. 9 take 3 s, 15 a minute."""

LARGEST, MOST_REGISTERS = 24 * 1024, 96
"""Bytes of code and VGPRs of a program of `standard`, at most."""

GOOD = Figures(instructions=1000, vgprs=80, waves=12, spills=0, bytes=5000)


@pytest.mark.parametrize(("tier", "share"), crossed(reversed(HELD), range(SHARES), len(HELD) * SHARES))
def test_no_program_gets_worse_for_a_gpu(report: Report, tier: Tier, share: int) -> None:
    presets = preset_names()[share::SHARES]
    found = compiled(uses(presets, [tier]))
    made_by, _ = read_table()
    report.add(
        "A GPU's compiler",
        tier=tier,
        compiler=found.driver,
        programs=str(found.programs),
        held="spills, waves, instructions" if made_by == found.driver else f"spills alone: the table is of {made_by}",
    )
    lines = not_admitted(found, presets, [tier])
    assert not lines, "\n".join([*lines, f"Where that is meant, write the table anew: {compiler.WRITE}"])


def test_programs_of_standard_are_small() -> None:
    _, table = read_table()
    standard = {use: figures for use, figures in table.items() if use.split(" ")[1] == "standard"}
    assert standard
    assert {use for use, one in standard.items() if one.bytes > LARGEST or one.vgprs > MOST_REGISTERS} == set()


@pytest.mark.parametrize("half", spread((0, 1), 2, first=1))
def test_no_program_has_so_many_loops_in_a_row_that_llvm_takes_a_minute(half: int) -> None:
    # One program of `fast` has all that two of `standard` have, one to find samples and one to light them.
    drawn = uses(preset_names()[half::2], HELD[:1])
    chains = {str(use): longest_chain(program.fragment.text) for use, program in drawn.items()}
    assert max(chains.values()) > 4
    assert {use: chain for use, chain in chains.items() if chain > CHAIN} == {}


_COMMENT = re.compile(r"//[^\n]*")
_FUNCTION = re.compile(r"^\w+\s+(\w+)\([^;{]*\)\s*\{", re.MULTILINE)
_STEP = re.compile(r"\b(for|while|do)\b|\b(\w+)\s*\(")


@cache
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


def test_the_table_knows_every_tier_and_names_uses_by_preset_tier_and_program() -> None:
    _, admitted = read_table()
    assert {use.split(" ")[1] for use in admitted} == set(TIERS)
    assert {use.split(" ")[0] for use in admitted} == set(preset_names())
    assert str(Use("default", "high", "surface, underwater")) == "default high surface, underwater"


def test_what_the_table_does_not_admit_is_named_and_what_it_admits_passes() -> None:
    use = "default standard surface"
    for change, said in (
        ({"spills": 1}, "1 registers spilled, 0 admitted"),
        ({"waves": 11}, "11 waves, 12 admitted"),
        ({"instructions": 1031}, "1031 instructions, +3.10 % for 1000 admitted"),
    ):
        (line,) = worse({use: replace(GOOD, **change)}, {use: GOOD})
        assert line.startswith(f"{use}: ")
        assert said in line
    better = replace(GOOD, instructions=900, vgprs=40, waves=24, bytes=4000)
    for now in (GOOD, better, replace(GOOD, instructions=1030)):
        assert worse({use: now}, {use: GOOD}) == []


def test_programs_that_came_or_went_are_named_and_another_driver_is_held_to_no_spills_alone() -> None:
    (came,) = worse({"default fast new": GOOD}, {})
    assert came == "default fast new: not in the table"
    table = ("default fast surface", "default fast old", "default high old")
    lost = gone(["default fast surface"], table, preset_names(), HELD)
    assert lost == ["default fast old: in the table, and nowhere else"]
    figures = {"default fast a": replace(GOOD, waves=1), "default fast b": replace(GOOD, spills=3)}
    other = Compiled(driver="another", figures=figures, programs=2)
    assert not_admitted(other, preset_names(), HELD) == ["default fast b: 3 registers spilled"]
