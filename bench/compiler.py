"""Output of a GPU's compiler for every program, compared with a checked-in table, so that regressions are detected.

Every text is parsed by glslang unchanged, as GLSL ES 3.00, and then as GLSL 4.50 for Vulkan, which gives the SPIR-V
that spirv-val checks and RADV compiles (``bench/radv.py``). RADV's figures weight loops by estimates: they compare
programs with each other and are not times.
"""

import hashlib
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from itertools import product
from pathlib import Path
from typing import get_args

from bench import radv
from bench.radv import CompilerError, Figures
from bench.report import Column, Table, count, percent
from bench.watch import Watch
from seafoam.framegraph.plan import Program, Shader
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.scene import Look, load_preset, preset_names

TABLE = Path(__file__).with_name("compiler.json")
CACHE = Path(__file__).resolve().parents[1] / ".cache" / "compiler.json"
KEPT = 4000
"""Number of programs in the cache; the least recently used are dropped."""
WRITE = ".venv/bin/python -m bench --only compiler --write-table"
INSTALL = "scripts/system.sh test"
_TRIANGLES = {"vertex/vertex.glsl@fullscreen", "vertex/vertex.glsl@horizon"}
PACKAGES = {"glslangValidator": "glslang-tools", "spirv-val": "spirv-tools"}
INSTRUCTIONS = 1.03
"""Maximum ratio of a program's instructions to those in the table."""
RDNA_CACHE = 32 * 1024
"""Bytes of an RDNA 2 instruction cache."""
REGISTERS = 80
"""Maximum VGPRs with which 12 waves fit on a SIMD."""

_ES = "#version 300 es\n"
_VULKAN = "#version 450\n"
_COMPARED: tuple[tuple[Look, Look], ...] = (
    ("halftone", "textured"),
    ("halftone_textured", "textured"),
    ("filtered", "halftone"),
)


@dataclass(frozen=True, order=True)
class Use:
    """Where a program is used."""

    preset: str
    tier: str
    program: str

    def __str__(self) -> str:
        return f"{self.preset} {self.tier} {self.program}"


@dataclass(frozen=True)
class Compiled:
    """Result of compiling: the driver, and the figures of each use and stage."""

    driver: str
    figures: dict[str, Figures]
    programs: int
    """Number of different texts."""


def missing() -> str:
    """What must be installed, and the command for it; empty if nothing is missing."""
    packages = [package for tool, package in PACKAGES.items() if shutil.which(tool) is None]
    if radv.icd() is None:
        packages.append("mesa-vulkan-drivers")
    return f"missing: {', '.join(packages)}; run {INSTALL}" if packages else ""


def uses(presets: Iterable[str], tiers: Iterable[Tier]) -> dict[Use, Program]:
    """Every program of the presets at the tiers."""
    return {
        Use(preset, tier, name): program
        for preset in presets
        for tier in tiers
        for name, program in make_plan(load_preset(preset).scene, TIERS[tier]).programs.items()
    }


def compiled(programs: Mapping[Use, Program]) -> Compiled:
    """Parse, check and compile every different text once.

    Figures of texts that the same tools have compiled before are read from ``.cache``, if the working copy has one.
    Raises :class:`bench.radv.CompilerError` with the missing tool, or with the program and the tool's message.
    """
    if missing():
        raise CompilerError(missing())
    with radv.opened() as compiler:
        tools = "\n".join([compiler.driver, _version("glslangValidator"), _version("spirv-val"), _own_text()])
        known = _read_cache()
        keys = {use: _key(program, tools) for use, program in programs.items()}
        fresh = {keys[use]: (use, program) for use, program in programs.items() if keys[use] not in known}
        if fresh:
            _check_essl([program for _, program in fresh.values()])
            with ThreadPoolExecutor(os.cpu_count()) as threads:
                modules = threads.map(lambda one: _spirv(*one), fresh.values())
                for (key, (use, _)), pair in zip(fresh.items(), modules, strict=True):
                    try:
                        stages = compiler.compile(*pair)
                    except Exception as error:
                        raise CompilerError(f"{use}: {error!r}") from error
                    known[key] = {stage: asdict(figures) for stage, figures in stages.items()}
        _write_cache(known, list(keys.values()))
        table: dict[str, Figures] = {}
        for use, program in programs.items():
            stages = {stage: Figures(**figures) for stage, figures in known[keys[use]].items()}
            table[str(use)] = stages["fragment"]
            # The vertex shader of one triangle, over the target or one side of the horizon, is the same everywhere.
            if _TRIANGLES.isdisjoint(file.path for file in program.vertex.files):
                table[f"{use}, vertex"] = stages["vertex"]
        return Compiled(compiler.driver, table, len(set(keys.values())))


def _own_text() -> str:
    return "".join(Path(path).read_text(encoding="utf-8") for path in (__file__, radv.__file__))


def _version(tool: str) -> str:
    return _run([tool, "--version"], tool).splitlines()[0]


def _key(program: Program, tools: str) -> str:
    return hashlib.sha256("\n".join([program.vertex.sha256, program.fragment.sha256, tools]).encode()).hexdigest()


def _read_cache() -> dict[str, dict[str, dict[str, int]]]:
    try:
        cached: dict[str, dict[str, dict[str, int]]] = json.loads(CACHE.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return cached


def _write_cache(known: Mapping[str, dict[str, dict[str, int]]], used: Sequence[str]) -> None:
    last = dict.fromkeys(used)
    kept = [*(key for key in known if key not in last), *last][-KEPT:]
    CACHE.parent.mkdir(exist_ok=True)
    with tempfile.NamedTemporaryFile("w", dir=CACHE.parent, delete=False) as file:
        json.dump({key: known[key] for key in kept}, file)
    os.replace(file.name, CACHE)


def _check_essl(programs: Sequence[Program]) -> None:
    """Parse every text with glslang, unchanged, in one call."""
    with tempfile.TemporaryDirectory() as folder:
        names = set()
        for program in programs:
            for stage, shader in (("vert", program.vertex), ("frag", program.fragment)):
                name = f"{shader.sha256}.{stage}"
                (Path(folder) / name).write_text(shader.text, encoding="utf-8")
                names.add(name)
        _run(["glslangValidator", *sorted(names)], "glslang, GLSL ES 3.00", folder)


def _spirv(use: Use, program: Program) -> tuple[bytes, bytes]:
    """Both stages as validated SPIR-V for Vulkan."""
    with tempfile.TemporaryDirectory() as folder:
        names = []
        for stage, shader in (("vert", program.vertex), ("frag", program.fragment)):
            names.append(f"shader.{stage}")
            (Path(folder) / names[-1]).write_text(_for_vulkan(shader), encoding="utf-8")
        # Vulkan allows uniforms outside blocks only by relaxed rules; glslang assigns locations and bindings.
        _run(["glslangValidator", "-V", "-R", "--aml", "--amb", *names], f"{use}: glslang, Vulkan", folder)
        vertex, fragment = ((Path(folder) / f"{stage}.spv").read_bytes() for stage in ("vert", "frag"))
    for module in (vertex, fragment):
        _validate(module, str(use))
    return vertex, fragment


_valid: set[bytes] = set()


def _validate(module: bytes, what: str) -> None:
    """Validate the module with spirv-val, once per module: most vertex shaders are the same."""
    if module not in _valid:
        _run(["spirv-val", "--target-env", "vulkan1.0", "-"], f"{what}: spirv-val", stdin=module)
        _valid.add(module)


def _for_vulkan(shader: Shader) -> str:
    if not shader.text.startswith(_ES):
        raise CompilerError(f"a text that does not begin with {_ES.strip()}")
    return _VULKAN + shader.text.removeprefix(_ES)


def _run(command: Sequence[str], what: str, folder: str | None = None, stdin: bytes | None = None) -> str:
    done = subprocess.run(command, cwd=folder, input=stdin, capture_output=True, check=False)
    said = (done.stdout + done.stderr).decode()
    if done.returncode != 0:
        raise CompilerError(f"{what}:\n{said.strip()[-3000:]}")
    return said


def read_table() -> tuple[str, dict[str, Figures]]:
    """The checked-in table: its driver, and the figures of each use."""
    table = json.loads(TABLE.read_text(encoding="utf-8"))
    return table["driver"], {use: Figures(*values) for use, values in table["figures"].items()}


def write_table(found: Compiled) -> None:
    """Write the table, a line for each use."""
    names = list(Figures.__dataclass_fields__)
    lines = [
        f"    {json.dumps(use)}: {json.dumps(list(asdict(figures).values()))}"
        for use, figures in sorted(found.figures.items())
    ]
    head = f'{{\n  "driver": {json.dumps(found.driver)},\n  "columns": {json.dumps(names)},\n  "figures": {{\n'
    TABLE.write_text(head + ",\n".join(lines) + "\n  }\n}\n", encoding="utf-8")


def worse(found: Mapping[str, Figures], admitted: Mapping[str, Figures]) -> list[str]:
    """Regressions against the table, a line each.

    These are more spills, fewer waves, over 3 % more instructions, and programs that the table lacks.
    """
    lines = []
    for use, now in found.items():
        then = admitted.get(use)
        if then is None:
            lines.append(f"{use}: not in the table")
            continue
        if now.spills > then.spills:
            lines.append(f"{use}: {now.spills} registers spilled, {then.spills} admitted")
        if now.waves < then.waves:
            lines.append(f"{use}: {now.waves} waves, {then.waves} admitted ({now.vgprs} registers for {then.vgprs})")
        if now.instructions > INSTRUCTIONS * then.instructions:
            more = now.instructions / then.instructions - 1.0
            lines.append(f"{use}: {now.instructions} instructions, {percent(more)} for {then.instructions} admitted")
    return lines


def gone(found: Iterable[str], admitted: Iterable[str], presets: Iterable[str], tiers: Iterable[str]) -> list[str]:
    """Uses of these presets at these tiers that are in the table and no longer exist, a line each."""
    asked = set(product(presets, tiers))
    kept = {use for use in admitted if tuple(use.split(" ")[:2]) in asked}
    return [f"{use}: in the table, and nowhere else" for use in sorted(kept - set(found))]


def not_admitted(found: Compiled, presets: Iterable[str], tiers: Iterable[str]) -> list[str]:
    """Regressions of these presets' programs at these tiers against the checked-in table, a line each.

    With another version of the driver all figures differ; then only spills are compared.
    """
    driver, admitted = read_table()
    if driver != found.driver:
        return [f"{use}: {now.spills} registers spilled" for use, now in found.figures.items() if now.spills]
    return worse(found.figures, admitted) + gone(found.figures, admitted, presets, tiers)


def measure(presets: Sequence[str], watch: Watch, *, write: bool) -> tuple[dict[str, str], list[Table]]:
    """Compile every program at every tier; returns the compiler and the tables. ``write``: write the checked-in table
    too."""
    with watch.step("a GPU's compiler"):
        found = compiled(uses(presets, TIERS))
        looks = _looks()
    if write:
        write_table(found)
    about = {"GPU's compiler": f"{found.driver}, {found.programs} different programs"}
    return about, [_surfaces(presets, found), _summary(found), looks, _changes(presets, found)]


def _surfaces(presets: Sequence[str], found: Compiled) -> Table:
    rows = []
    for preset in presets:
        for name in ("surface", "surface, underwater"):
            figures = found.figures.get(str(Use(preset, "standard", name)))
            if figures is not None:
                rows.append((preset, name, *asdict(figures).values()))
    return Table(
        "A GPU's compiler: the surface",
        f"{found.driver}; the surface's fragment program at quality standard. Waves: that fit on a SIMD at once.",
        (Column("preset", "preset"), Column("program", "program"), *_COLUMNS),
        rows,
    )


_COLUMNS = (
    Column("instructions", "instructions", count),
    Column("vgprs", "VGPR", count),
    Column("waves", "waves", count),
    Column("spills", "spills", count),
    Column("bytes", "bytes", count),
)


def _summary(found: Compiled) -> Table:
    rows = []
    for tier in TIERS:
        own = {use: figures for use, figures in found.figures.items() if use.split(" ")[1] == tier}
        rows.append(
            (
                tier,
                len(own),
                sum(one.spills > 0 for one in own.values()),
                sum(one.bytes > RDNA_CACHE for one in own.values()),
                sum(one.vgprs > REGISTERS for one in own.values()),
                max(one.instructions for one in own.values()),
                max(one.vgprs for one in own.values()),
                min(one.waves for one in own.values()),
                max(one.bytes for one in own.values()),
            )
        )
    return Table(
        "A GPU's compiler: every program",
        f"Shaders of all presets, each use counted; {found.programs} different programs. Over the cache: larger than "
        f"the {RDNA_CACHE // 1024} KB of an RDNA 2 instruction cache.",
        (
            Column("tier", "tier"),
            Column("shaders", "shaders", count),
            Column("spilling", "spilling", count),
            Column("over_cache", "over the cache", count),
            Column("over_registers", f"over {REGISTERS} VGPR", count),
            Column("instructions", "most instructions", count),
            Column("vgprs", "most VGPR", count),
            Column("waves", "fewest waves", count),
            Column("bytes", "most bytes", count),
        ),
        rows,
    )


def _looks() -> Table:
    scene = load_preset("paper-benchmark").scene
    assert scene.foam is not None
    programs = {}
    for look in get_args(Look):
        chosen = scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})})
        program = make_plan(chosen, TIERS["standard"]).programs["surface"]
        programs[Use("paper-benchmark", look, "surface")] = program
    found = compiled(programs).figures
    by_look = {look: found[str(Use("paper-benchmark", look, "surface"))] for look in get_args(Look)}
    base = dict(_COMPARED)
    return Table(
        "A GPU's compiler: looks",
        "The surface of paper-benchmark at quality standard, with each look.",
        (Column("look", "look"), *_COLUMNS, Column("against", "against"), Column("more", "instructions", percent)),
        [
            (
                look,
                *asdict(figures).values(),
                base.get(look, ""),
                figures.instructions / by_look[base[look]].instructions - 1.0 if look in base else None,
            )
            for look, figures in by_look.items()
        ],
    )


def _changes(presets: Sequence[str], found: Compiled) -> Table:
    driver, admitted = read_table()
    lines = worse(found.figures, admitted)
    if set(presets) == set(preset_names()):
        lines += gone(found.figures, admitted, preset_names(), TIERS)
    note = "" if driver == found.driver else f" It is of {driver}: what differs may be the compiler."
    return Table(
        "A GPU's compiler: against the checked-in table",
        f"What bench/compiler.json does not admit; {WRITE} writes it anew.{note}",
        (Column("what", "what"),),
        [(line,) for line in lines] or [("nothing",)],
    )
