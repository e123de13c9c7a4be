"""The house stays small: files, folders, functions, names and imports against the budget in pyproject.toml.

Each rule there has ``most``, which holds for all, and ``ceilings`` for what had more when the rule was made. A ceiling
that is not needed any more must go: so the lists can only shrink.
"""

import ast
import re
import subprocess
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Set
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[3]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
BUDGET: dict[str, dict[str, Any]] = PROJECT["tool"]["seafoam"]["budget"]
CODE = (".py", ".ts", ".tsx")
KILOBYTE = 1000
SHORTEST_SHADER = 8
"""Lines: what is shorter belongs to a file of its effect."""
Graph = Mapping[str, Set[str]]
"""By module: the modules that it imports."""


def broken(rule: str, budget: Mapping[str, Any], found: Mapping[str, int], advice: str) -> list[str]:
    """What breaks a rule: a sentence for all that is over its ceiling, and for each ceiling that nothing needs."""
    most, ceilings = budget["most"], budget["ceilings"]
    table = f"[tool.seafoam.budget.{rule}.ceilings]"
    over = [
        f"{name}: {rule} {count}, budget {ceilings.get(name, most)}: {advice}"
        for name, count in sorted(found.items())
        if count > ceilings.get(name, most)
    ]
    idle = [
        f"{name}: {rule} {found.get(name, 0)}, as any may have: take it out of {table} in pyproject.toml"
        for name in ceilings
        if found.get(name, 0) <= most
    ]
    return over + idle


def keep(rule: str, found: Mapping[str, int], advice: str) -> None:
    """Fail with all that breaks a rule."""
    if said := broken(rule, BUDGET[rule], found, advice):
        pytest.fail("\n".join(said), pytrace=False)


@pytest.fixture(scope="module")
def files() -> list[str]:
    """Paths of the checkout's files from its root, those not yet added among them; none that git ignores."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    return sorted({name for name in names if name and (ROOT / name).is_file()})


@pytest.fixture(scope="module")
def trees(files: list[str]) -> dict[str, ast.Module]:
    """Every Python file by its dotted name: of the package as it is imported, of others from the checkout's root."""
    return {dotted(name): ast.parse((ROOT / name).read_text("utf-8"), name) for name in files if name.endswith(".py")}


def dotted(path: str) -> str:
    """The name of a module by its file's path."""
    return path.removeprefix("server/").removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def row_of(path: str, rows: Mapping[str, int]) -> str | None:
    """The row that counts a file: of those whose folder it is below and whose pattern it has, the deepest."""
    parts = [(row, *row.rsplit("/", 1)) for row in rows]
    name = path.rsplit("/", 1)[-1]
    fitting = [row for row, folder, pattern in parts if path.startswith(f"{folder}/") and fnmatch(name, pattern)]
    return max(fitting, key=len, default=None)


def parameters(tree: ast.AST, above: str) -> Iterator[tuple[str, int]]:
    """Every function's qualified name and the number of its parameters, without ``self``."""
    for node in ast.iter_child_nodes(tree):
        name = (
            f"{above}.{node.name}" if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) else above
        )
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            given = node.args
            asked = [
                one.arg
                for one in (*given.posonlyargs, *given.args, given.vararg, *given.kwonlyargs, given.kwarg)
                if one
            ]
            yield name, len(asked) - (isinstance(tree, ast.ClassDef) and asked[:1] in (["self"], ["cls"]))
        yield from parameters(node, name)


def imports(trees: Mapping[str, ast.Module]) -> Graph:
    """What modules import of one another, wherever the statement stands: in functions and for the type checker too.

    Of a module that imports by name (``import_module``), also the modules that its strings name.
    """
    graph: dict[str, set[str]] = {}
    for module, tree in trees.items():
        named: set[str] = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                named |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                assert not node.level, f"{module}: imports within the package are absolute"
                inner = {f"{node.module}.{alias.name}" for alias in node.names}
                named |= inner & trees.keys()
                if inner - trees.keys():
                    named.add(str(node.module))
        if any(isinstance(node, ast.alias) and node.name in {"importlib", "import_module"} for node in ast.walk(tree)):
            strings = (node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
            named |= {value for value in strings if isinstance(value, str)}
        graph[module] = (named & trees.keys()) - {module}
    return graph


def below(graph: Graph, *modules: str) -> set[str]:
    """What modules import, what this imports, and so on; of themselves only those in a circle."""
    found: set[str] = set()
    todo = [one for module in modules for one in graph[module]]
    while todo:
        module = todo.pop()
        if module not in found:
            found.add(module)
            todo += graph[module]
    return found


def circles(graph: Graph) -> dict[str, int]:
    """By module that imports itself by way of others: how many modules are in the circle."""
    reached = {module: below(graph, module) for module in graph}
    return {module: sum(module in reached[one] for one in ones) for module, ones in reached.items() if module in ones}


def unused(graph: Graph, roots: Set[str]) -> set[str]:
    """Modules that no program comes to. A package is not counted where one of its modules is used."""
    used = roots | below(graph, *roots)
    return {module for module in graph if not any(f"{one}.".startswith(f"{module}.") for one in used)}


@pytest.fixture(scope="module")
def graph(trees: dict[str, ast.Module]) -> Graph:
    """Imports within the package."""
    return imports({name: tree for name, tree in trees.items() if name.partition(".")[0] == "seafoam"})


def test_packages_keep_to_their_lines(files: list[str]) -> None:
    rows = BUDGET["lines"]["ceilings"]
    counted: Counter[str] = Counter()
    for name in files:
        if row := row_of(name, rows):
            counted[row] += (ROOT / name).read_bytes().count(b"\n")
    advice = "shorten it, or raise the budget and say in the commit what the lines are for; a new package needs a row"
    keep("lines", counted, advice)


def test_shaders_keep_to_their_number_of_files(files: list[str]) -> None:
    rows = BUDGET["files"]["ceilings"]
    counted = Counter(row for name in files if (row := row_of(name, rows)))
    keep("files", counted, "join files that are always used together")
    shaders = [name for name in files if name.startswith("shaders/") and name.endswith(".glsl")]
    assert not [name for name in shaders if (ROOT / name).read_bytes().count(b"\n") < SHORTEST_SHADER]


def test_budgets_keep_to_their_goals() -> None:
    """Rows are raised one at a time, and one was once the count of another."""
    over = []
    for rule, goals in BUDGET["goals"].items():
        for start, goal in goals.items():
            total = sum(most for row, most in BUDGET[rule]["ceilings"].items() if row.startswith(start))
            over += [f"{start}: {rule} of all rows {total}, goal {goal}"] if total > goal else []
    assert not over


def test_folders_have_few_files(files: list[str]) -> None:
    counted = Counter(name.rpartition("/")[0] for name in files if name.endswith(CODE))
    keep("modules", counted, "sort them into folders by subject")


def test_functions_have_few_parameters(trees: dict[str, ast.Module]) -> None:
    found: dict[str, int] = {}
    for module, tree in trees.items():
        for name, count in parameters(tree, module):
            found[name] = max(count, found.get(name, 0))
    keep("parameters", found, "join those that belong together in a dataclass")


def test_names_of_classes_are_unique(trees: dict[str, ast.Module]) -> None:
    package = [tree for name, tree in trees.items() if name.partition(".")[0] == "seafoam"]
    counted = Counter(node.name for tree in package for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
    keep("classes", counted, "give each a name that says what it is")


def test_no_module_imports_itself_by_way_of_others(graph: Graph) -> None:
    found = circles(graph)
    advice = "move what both need to a module below them; imports for types and in functions count too"
    keep("circle", found, advice)


def test_programs_use_every_module(graph: Graph) -> None:
    """Programs: the package's names, its command, and what the Makefile runs by name."""
    scripts = PROJECT["project"]["scripts"].values()
    run = re.findall(r"-m (seafoam[\w.]*)", (ROOT / "Makefile").read_text("utf-8"))
    roots = {"seafoam", *(script.partition(":")[0] for script in scripts), *run}
    found = dict.fromkeys(unused(graph, roots), 1)
    advice = "only tests and tools import it: move it to them, or delete it"
    keep("unused", found, advice)


def test_binary_files_are_small(files: list[str]) -> None:
    found: dict[str, int] = {}
    for name in files:
        size = (ROOT / name).stat().st_size
        if size > BUDGET["kB"]["most"] * KILOBYTE and not name.startswith("masks/"):
            with (ROOT / name).open("rb") as file:
                # As git tells binary files from text.
                if b"\0" in file.read(8000):
                    found[name] = -(-size // KILOBYTE)
    keep("kB", found, "compress it, or make it by a command; history keeps every version")
