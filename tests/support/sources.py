"""Which first-party files a Python file depends on, from its import statements: nothing is run."""

import ast
import hashlib
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

Name = tuple[str, str]
"""A module and a name in it; all of the module where the name is empty."""


Name = tuple[str, str]
"""A module and a name in it; all of the module where the name is empty."""


_stamps: dict[Path, tuple[int, int] | None] = {}
"""Time and size of every file at the moment its digest was taken."""


def _stamp(path: Path) -> tuple[int, int] | None:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


def _stamp(path: Path) -> tuple[int, int] | None:
    """When a file was written, and its size."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


def _names(node: ast.AST) -> set[str]:
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


class Sources:
    """Imports below some folders, followed from file to file.

    ``roots``: folders that ``sys.path`` holds. ``answered``: names whose makers are not followed, because what they
    give is an input of its own; ``(module, "")`` for all of a module and what lies below it.
    """

    def __init__(self, roots: Sequence[Path], answered: Collection[Name]) -> None:
        self._roots = tuple(roots)
        self._answered = frozenset(answered)
        self._direct: dict[Path, frozenset[Path]] = {}
        self._trees: dict[Path, ast.Module] = {}
        self._digests: dict[Path, str] = {}
        self._uses: dict[tuple[Path, frozenset[str], str], frozenset[str]] = {}
        self._below: dict[Path, frozenset[Path]] = {}
        self._stamps: dict[Path, tuple[int, int] | None] = {}

    def digest(self, path: Path) -> str:
        """SHA-256 of a file's bytes as they were when first asked for; of a file that is not there, nothing."""
        if path not in self._digests:
            self._stamps[path] = _stamp(path)
            self._digests[path] = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
        return self._digests[path]

    def digest_of(self, paths: Collection[Path], root: Path) -> str:
        """SHA-256 of files by their places below ``root`` and their bytes."""
        lines = [f"{path.relative_to(root).as_posix()} {self.digest(path)}" for path in sorted(paths)]
        return hashlib.sha256("\n".join(lines).encode()).hexdigest()

    def edited(self) -> bool:
        """Whether a file has changed since its digest was taken: what runs may not be what was read."""
        return any(_stamp(path) != stamp for path, stamp in self._stamps.items())

    def _tree(self, path: Path) -> ast.Module:
        if path not in self._trees:
            self._trees[path] = ast.parse(path.read_text(encoding="utf-8"))
        return self._trees[path]

    def below(self, path: Path) -> frozenset[Path]:
        """The file, what it imports, and so on."""
        if path not in self._below:
            todo, seen = [path], set()
            while todo:
                one = todo.pop()
                if one not in seen:
                    seen.add(one)
                    todo += self._imports(one)
            self._below[path] = frozenset(seen)
        return self._below[path]

    def follows(self, path: Path) -> bool:
        """Whether a file is a module of a package, to which imports lead, or what Python makes of one."""
        return path.suffix == ".pyc" or (path.suffix == ".py" and (path.parent / "__init__.py").is_file())

    def uses(self, path: Path, names: Collection[str], test: str = "") -> frozenset[str]:
        """Which of these names, or of what a file makes of them at its top, its functions use.

        Of functions that are tests, only the one called ``test``; and what makes its parameters is at the top.
        """
        key = (path, frozenset(names), test)
        if key not in self._uses:
            tree, tables = self._tree(path), set(names)
            for node in tree.body:
                if isinstance(node, ast.Assign | ast.AnnAssign) and node.value and _names(node.value) & tables:
                    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                    tables |= {name for target in targets for name in _names(target)}
            functions = [one for one in ast.walk(tree) if isinstance(one, ast.FunctionDef)]
            asked = [one for one in functions if one.name == test or not one.name.startswith("test_")]
            self._uses[key] = frozenset(tables & {name for one in asked for part in one.body for name in _names(part)})
        return self._uses[key]

    def _file(self, module: str, importer: Path) -> Path | None:
        for root in (importer.parent, *self._roots):
            base = root.joinpath(*module.split("."))
            for path in (base.with_suffix(".py"), base / "__init__.py"):
                if path.is_file():
                    return path
        return None

    def _imports(self, path: Path) -> frozenset[Path]:
        if path not in self._direct:
            found = {file for module, name in self._named(path) for file in self._of(module, name, path)}
            self._direct[path] = frozenset(found - {path})
        return self._direct[path]

    def _named(self, path: Path) -> Iterator[Name]:
        """Every module and name that a file imports, wherever the statement stands."""
        for node in ast.walk(self._tree(path)):
            if isinstance(node, ast.Import):
                yield from ((alias.name, "") for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                module = node.module or ""
                if node.level:
                    module = ".".join(filter(None, (self._package(path, node.level), module)))
                yield from ((module, alias.name) for alias in node.names)

    def _package(self, path: Path, level: int) -> str:
        """The dotted name of the package ``level`` dots above a file's inside."""
        folder = path.parent
        for _ in range(level - 1):
            folder = folder.parent
        for root in self._roots:
            if folder.is_relative_to(root):
                return ".".join(folder.relative_to(root).parts)
        return folder.name

    def _left_out(self, module: str, name: str) -> bool:
        parts = f"{module}.{name}".split(".")
        whole = (".".join(parts[:count]) for count in range(1, len(parts) + 1))
        return (module, name) in self._answered or any((one, "") in self._answered for one in whole)

    def _of(self, module: str, name: str, importer: Path) -> Iterator[Path]:
        """Files that ``from module import name`` runs, but for packages whose names are all answered."""
        if self._left_out(module, name):
            return
        if name and (inner := self._file(f"{module}.{name}", importer)):
            yield inner
            return
        path = self._file(module, importer)
        if path is None:
            return
        if name and path.name == "__init__.py" and (again := self._passed_on(path, name)):
            # A package that passes a name on: the module it comes from, and not all else that the package names.
            yield from self._of(*again, path)
        else:
            yield path

    def _passed_on(self, package: Path, name: str) -> Name | None:
        for node in self._tree(package).body:
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    if (alias.asname or alias.name) == name:
                        module = node.module or ""
                        if node.level:
                            module = ".".join(filter(None, (self._package(package, node.level), module)))
                        return module, alias.name
        return None
