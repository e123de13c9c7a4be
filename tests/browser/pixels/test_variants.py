"""Every program that a plan can ask for is GLSL ES 3.00, by glslang.

But for the sweep, those of a quarter of all plans, and of them a set that has every two files which stand together.
Chromium's WebGL 2 (ANGLE, on the server's Mesa) compiles this set too.
"""

import hashlib
import subprocess
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from seafoam.framegraph.plan import Program, Shader
from seafoam.planner.glsl import parts_of
from seafoam.resources import data_dir
from support.scenes.variants import covering, every_program
from support.sweep import REST

BATCH = 25
"""Programs that the page compiles in one go; it starts them all before it asks about any."""
SHADERS = data_dir("shaders")


def label(program: Program) -> str:
    """What tells a program from the others: the files that it is made of."""
    return " + ".join(file.path for file in (*program.vertex.files, *program.fragment.files) if file.path)


def named(one_in: int) -> dict[str, Program]:
    """Programs under a name that says what each is and which plan asks for it."""
    return {f"{i} ({name})": program for i, (_, name, program) in enumerate(every_program(one_in).values())}


@pytest.fixture(scope="module")
def every() -> dict[str, Program]:
    """Every program of the closed space."""
    return named(1)


@pytest.fixture(scope="module")
def chosen() -> dict[str, Program]:
    """With every trait of any program of a quarter of the plans: of every scene at a tier, and of every quality of some
    presets."""
    programs = list(named(4).items())
    return dict(programs[i] for i in covering([program for _, program in programs]))


def compiled(page: Page, programs: dict[str, Program]) -> list[str]:
    """What Chromium says of these programs; they are all that a plan to compile needs."""
    dumped: dict[str, Any] = {name: program.model_dump(mode="json") for name, program in programs.items()}
    return page.evaluate("(programs) => window.seafoam.compile({ programs })", dumped)


def broken(program: Program, line: str) -> Program:
    """The program with one more line at the end of its fragment shader."""
    shader = program.fragment
    text = f"{shader.text}\n{line}\n"
    changed = Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=shader.files)
    return Program(vertex=program.vertex, fragment=changed)


@pytest.mark.parametrize("which", ["chosen", pytest.param("every", marks=REST)])
def test_programs_are_glsl(which: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    asked: dict[str, Program] = request.getfixturevalue(which)
    assert len(asked) > 50
    of: dict[str, str] = {}
    for name, program in asked.items():
        for stage, shader in (("vert", program.vertex), ("frag", program.fragment)):
            file = f"{shader.sha256}.{stage}"
            of[file] = f"{name}, made of {label(program)}"
            (tmp_path / file).write_text(shader.text, encoding="utf-8")
    files = sorted(of)
    for i in range(0, len(files), 200):
        said = subprocess.run(["glslangValidator", *files[i : i + 200]], cwd=tmp_path, capture_output=True, text=True)
        named = [of[line.strip()] for line in said.stdout.splitlines() if line.strip() in of]
        assert said.returncode == 0, (said.stdout[-4000:], named)


def test_the_covering_set_compiles_in_chromium(page: Page, chosen: dict[str, Program]) -> None:
    names = iter(chosen)
    errors: list[str] = []
    while batch := list(islice(names, BATCH)):
        said = compiled(page, {name: chosen[name] for name in batch})
        failed = {name: label(chosen[name]) for name in batch if any(f"Program {name}:" in error for error in said)}
        errors += [*said, *(f"{name} is made of {files}" for name, files in failed.items())]
    assert errors == []


def test_a_broken_program_is_reported_by_its_file(page: Page, chosen: dict[str, Program]) -> None:
    name, program = next((name, program) for name, program in chosen.items() if "surface" in label(program))
    # Mesa lets GLSL ES 1.00's function pass, which is why Chromium is asked.
    bad = broken(program, "uniform sampler2D u_old; vec4 old() { return texture2D(u_old, vec2(0.5)); }")
    (error,) = compiled(page, {name: bad})
    for said in (f"Program {name}:", "texture2D", bad.fragment.files[-1].path):
        assert said in error


def test_every_shader_file_is_used(chosen: dict[str, Program]) -> None:
    files = (path.relative_to(SHADERS).as_posix() for path in SHADERS.rglob("*.glsl"))
    there = {path for file in files for path in ([f"{file}@{part}" for part in parts_of(file)] or [file])}
    used = {file.path for program in chosen.values() for file in (*program.vertex.files, *program.fragment.files)}
    assert there
    assert there - used == set()
