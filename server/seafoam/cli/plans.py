"""A frame plan as text: its passes and programs, or the source of one program with the names of its files."""

from collections.abc import Iterator
from typing import Literal

from rich.table import Column, Table

from seafoam.cli.support import member_of
from seafoam.framegraph.plan import FramePlan


def passes(plan: FramePlan) -> Table:
    """A row for each pass, in the order in which they are drawn."""
    table = Table(
        "pass", Column("program", no_wrap=True), "target", "drawn", "files", "lines", box=None, pad_edge=False
    )
    for one in plan.passes:
        shader = plan.programs[one.program].fragment
        files, lines = sum(1 for file in shader.files if file.path), shader.text.count("\n")
        table.add_row(one.name, one.program, one.target, one.when, str(files), str(lines))
    return table


def source(plan: FramePlan, program: str, stage: Literal["fragment", "vertex"]) -> Iterator[str]:
    """Lines of a program's shader, a comment with the name before each of its files.

    Raises ``CommandError`` for a program that the plan does not have.
    """
    found = plan.programs[member_of(program, tuple(plan.programs), "--program")]
    shader = found.fragment if stage == "fragment" else found.vertex
    names = {file.line: file.path for file in shader.files}
    for number, line in enumerate(shader.text.splitlines(), start=1):
        if number in names:
            yield f"// ---- {names[number]}"
        yield line
