"""What this project's checks depend on, as :mod:`memo` asks for it."""

import hashlib
import importlib.metadata
import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import seafoam.planner
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import geometry, planner
from seafoam.planner import glsl as assemble
from seafoam.quality import Quality
from seafoam.scene import presets
from seafoam.scene.models import Scene
from support.browsers import COMMON, LANES, chromium
from support.memo import Door, Memo
from support.sources import Sources

ROOT = Path(__file__).parents[2]
ROOTS = (ROOT / "tests", ROOT / "server", ROOT)
DRIVERS = ("LIBGL_", "MESA_", "GALLIUM_", "GALLIVM_", "LP_", "EGL_", "__EGL_", "SEAFOAM_")
"""Beginnings of variables that choose a driver or how it draws."""
TABLES = frozenset({"EFFECTS"})
ANSWERED = {
    ("support.inputs", ""),
    ("seafoam.planner", "make_plan"),
    ("seafoam.planner.planner", "make_plan"),
    ("seafoam.planner", "make_geometry_plan"),
    ("seafoam.planner.geometry", "make_geometry_plan"),
    ("seafoam.effects", "EFFECTS"),
    ("seafoam.scene.presets", ""),
}
PLAIN_PAGE = ("plans", "presets", "textures")
"""Routers that give a page the plan, the scene and the textures of a picture."""
NOT_PLAIN = {("seafoam.accuracy", ""), ("seafoam.api.http.thread_pool", ""), ("seafoam.render.service.pool", "")}
"""What those routers' modules name, and a page that draws one picture never runs."""
BROWSERS = {"playwright", "llvmpipe", "optimised", "swiftshader", "page", "other"}
SHARED = {"executor", "probe", "report", "server", *BROWSERS}


SOURCES = Sources(ROOTS, ANSWERED)


def files_below(*folders: str) -> list[Path]:
    """Every file of these folders that is a source, without texts that the client shows but does not run."""
    found = (path for folder in folders for path in (ROOT / folder).rglob("*") if path.is_file())
    texts = ROOT / "webclient" / "dist" / "source"
    return [path for path in found if "__pycache__" not in path.parts and texts not in path.parents]


@cache
def product() -> str:
    """Hash of all that plans and pictures are made from, the built client too."""
    return SOURCES.digest_of(files_below("server/seafoam", "shaders", "masks", "webclient/dist"), ROOT)


def processor() -> str:
    """What llvmpipe compiles for."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines() if Path("/proc/cpuinfo").is_file() else []
    return "\n".join(sorted({line for line in lines if line.startswith(("model name", "flags"))}))


def where(renderer: Callable[[], dict[str, str]]) -> Any:
    """The machine, and all that is installed."""
    mine = [ROOT / "tests" / "support" / f"{name}.py" for name in ("inputs", "memo", "sources")]
    return [
        renderer(),
        processor(),
        sys.version,
        sorted(f"{one.name} {one.version}" for one in importlib.metadata.distributions()),
        {name: value for name, value in sorted(os.environ.items()) if name.startswith(DRIVERS)},
        SOURCES.digest_of([*files_below("masks"), *mine], ROOT),
    ]


def browser() -> Any:
    """The browser, how it is started, the client that it runs, and who answers that."""
    routers = [ROOT / "server/seafoam/api/routers" / f"{name}.py" for name in PLAIN_PAGE]
    sources = Sources(ROOTS, ANSWERED | NOT_PLAIN)
    served = {file for router in routers for file in sources.below(router)}
    said = subprocess.run([chromium(), "--version"], capture_output=True, text=True, check=True).stdout
    return [said, COMMON, LANES, SOURCES.digest_of([*served, *files_below("webclient/dist")], ROOT)]


def _plan_key(scene: Scene, quality: Quality, *, economy: bool = True) -> list[Any]:
    return [scene.model_dump_json(), quality.model_dump_json(), economy]


def _geometry_key(scene: Scene, quality: Quality) -> list[Any]:
    return [scene.model_dump_json(), quality.model_dump_json()]


def _preset_hash(preset: presets.Preset) -> str:
    return hashlib.sha256(preset.model_dump_json().encode()).hexdigest()


def _text_hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def doors() -> dict[str, Door]:
    """Where checks get plans, presets and GLSL from."""
    make, load, names, read = planner.make_plan, presets.load_preset, presets.preset_names, assemble.read_file
    measure = geometry.make_geometry_plan

    def plan_again(scene: str, quality: str, economy: bool) -> FramePlan:
        return make(Scene.model_validate_json(scene), Quality.model_validate_json(quality), economy=economy)

    def geometry_again(scene: str, quality: str) -> FramePlan:
        return measure(Scene.model_validate_json(scene), Quality.model_validate_json(quality))

    planners = (geometry, seafoam.planner)
    return {
        "geometry": Door(planners, "make_geometry_plan", _geometry_key, geometry_again, lambda plan: plan.sha256),
        "plan": Door((planner, seafoam.planner), "make_plan", _plan_key, plan_again, lambda plan: plan.sha256),
        "preset": Door((presets,), "load_preset", lambda name: [name], load, _preset_hash),
        "presets": Door((presets,), "preset_names", lambda: [], names, json.dumps),
        "glsl": Door((assemble,), "read_file", lambda path: [path], read, _text_hash),
    }


def usual(fixtures: Sequence[str]) -> str | None:
    """By what a check is remembered that says nothing of it."""
    if "playwright" in fixtures:
        return "product"
    return "answers" if {"executor", "probe"} & set(fixtures) else None


def memo(renderer: Callable[[], dict[str, str]]) -> Memo:
    """The project's."""
    return Memo(
        root=ROOT,
        folder=ROOT / ".cache" / "checks",
        sources=SOURCES,
        where=lambda: where(renderer),
        doors=doors(),
        extra={"playwright": browser},
        shared=frozenset(SHARED),
        tables=TABLES,
        product=product,
        usual=usual,
    )
