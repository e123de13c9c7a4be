"""Checks that passed are remembered by all that they depend on: in a working copy an untouched effect costs nothing.

A check that the GPU or a browser takes part in is left out of a run where everything is as it was when it last passed:

- its own text, that of what it imports and of what that imports, down to the executor: tolerances, cameras, sizes and
  times stand there, or in the values of its parameters;
- its answers: what it got through the *doors*, functions whose makers are not followed (plans, presets, GLSL), and the
  files that it opened. A door is asked again, and its answer compared by its hash: a plan by ``FramePlan.sha256``;
- where it ran: the renderer, versions of Python and of every package, drivers' variables, masks, and for a browser its
  version and the built client.

Where these answers cannot be all of it, it depends on the whole product instead: the server, the shaders, the masks and
the built client. So do pages in a browser that do more than draw a picture. ``remembered(by="answers")`` and
``remembered(by="product")`` say it of a check that is not so by itself.

Nothing is written but by a check whose set-up, call and tear-down have just passed, and what was remembered of a check
is forgotten before it runs. With ``CI`` set, nothing is remembered and nothing is left out.
"""

import dataclasses
import functools
import hashlib
import json
import os
import sys
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest
from pydantic import BaseModel

from support.sources import Sources

MARK = "remembered"
FILE = "file"
"""The door that every file is: its key is the path below the root."""
UNREAD = {".venv", ".cache", ".git", "node_modules", "__pycache__", ".hypothesis"}
"""Folders whose files are no inputs."""


@dataclass(frozen=True)
class Door:
    """A function that checks get data from.

    ``places``, ``attribute``: where its callers find it. ``key``: its arguments as JSON can hold them. ``again``: what
    it answers to a key, by the door as it was before it was watched. ``hash``: of an answer.
    """

    places: tuple[Any, ...]
    attribute: str
    key: Callable[..., list[Any]]
    again: Callable[..., Any]
    hash: Callable[[Any], str]


@dataclass
class Read:
    """What the check that runs got through doors: JSON of door and key -> hash of the answer."""

    answers: dict[str, str] = field(default_factory=dict)
    certain: bool = True
    """Whether every answer could be written down."""
    passed: set[str] = field(default_factory=set)
    """Phases that have passed."""


class _Opened:
    """Hears of every file that Python opens; an audit hook stays for good, so there is one."""

    def __init__(self) -> None:
        self.memo: Memo | None = None
        sys.addaudithook(self)

    def __call__(self, event: str, args: tuple[Any, ...]) -> None:
        if event == "open" and self.memo is not None and isinstance(args[0], str | os.PathLike):
            self.memo.opened(os.fspath(args[0]), args[1])


_OPENED = _Opened()


def plain(value: Any, digest: Callable[[Path], str]) -> Any:
    """A parameter's value as JSON can hold it, the same for equal values; a function by the file it stands in.

    Raises ``TypeError`` for what has no text.
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, BaseModel):
        return [type(value).__qualname__, value.model_dump(mode="json")]
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        inner = {one.name: plain(getattr(value, one.name), digest) for one in dataclasses.fields(value)}
        return [type(value).__qualname__, inner]
    if isinstance(value, tuple | list):
        return [plain(one, digest) for one in value]
    if isinstance(value, dict):
        return [[plain(key, digest), plain(one, digest)] for key, one in value.items()]
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__}"
    if isinstance(value, FunctionType):
        return [value.__module__, value.__qualname__, digest(Path(value.__code__.co_filename))]
    raise TypeError(f"a check with a parameter of type {type(value).__qualname__} cannot be remembered")


class Memo:
    """The plugin.

    ``folder``: where it remembers. ``where``: what every check depends on; asked once, and only if some check is
    remembered. ``sources``: how imports are followed. ``extra``: fixture -> what else a check with it depends on.
    ``shared``: fixtures wider than a function that tell a check nothing; what others read they may have read when
    another check ran. ``tables``: names whose makers are not followed and that are no doors: they may make parameters,
    whose values count, and nothing else. ``product``: a hash of all that doors' answers come from, and that checks
    depend on that are remembered by the product. ``usual``: by what a check is remembered that is not marked, from the
    names of its fixtures.
    """

    def __init__(
        self,
        root: Path,
        folder: Path,
        sources: Sources,
        where: Callable[[], Any],
        doors: Mapping[str, Door],
        extra: Mapping[str, Callable[[], Any]],
        shared: frozenset[str],
        tables: frozenset[str],
        product: Callable[[], str],
        usual: Callable[[Sequence[str]], str | None],
    ) -> None:
        self._root = root
        self._folder = folder
        self._sources = sources
        self._where = functools.cache(where)
        self._doors = doors
        self._extra = {name: functools.cache(of) for name, of in extra.items()}
        self._shared = shared
        self._tables = tables
        self._product = functools.cache(product)
        self._reading: Read | None = None
        self._known: dict[str, str] = {}
        """Answers of doors now, by JSON of door and key."""
        self._compared: dict[str, bool] = {}
        """Whether asking again gave what the check got."""
        self._static: dict[str, str] = {}
        self._now: dict[str, str] = {}
        """What each marked check depends on, but for its answers."""
        self._left_out = 0
        self._kinds: dict[str, str] = {}
        self._patch = pytest.MonkeyPatch()
        self._usual = usual
        self._active = not os.environ.get("CI")
        if self._active:
            for name, door in doors.items():
                self._watch(name, door)
            self._before, _OPENED.memo = _OPENED.memo, self

    # Reading

    def _watch(self, name: str, door: Door) -> None:
        """Put a function that notes its answers in the door's places."""
        original = getattr(door.places[0], door.attribute)

        @functools.wraps(original, updated=())
        def noted(*args: Any, **kwargs: Any) -> Any:
            read, self._reading = self._reading, None
            certain = False
            try:
                value = original(*args, **kwargs)
                certain = read is None or self._note(read, name, door, value, door.key(*args, **kwargs))
            finally:
                if read is not None:
                    # A door that raised has no answer to be compared.
                    read.certain &= certain
                self._reading = read
            return value

        @functools.wraps(original, updated=())
        def past(*args: Any, **kwargs: Any) -> Any:
            """Past its cache, which is where a planner is given other effects."""
            if self._reading is not None:
                self._reading.certain = False
            return original.__wrapped__(*args, **kwargs)

        for extra in ("cache_clear", "cache_info"):
            if hasattr(original, extra):
                setattr(noted, extra, getattr(original, extra))
        noted.__wrapped__ = past  # type: ignore[attr-defined]
        for place in door.places:
            self._patch.setattr(place, door.attribute, noted)

    def _note(self, read: Read, name: str, door: Door, value: Any, arguments: list[Any]) -> bool:
        """Note an answer; whether asking again would give the same."""
        key = json.dumps([name, arguments], sort_keys=True)
        read.answers[key] = self._answer(key)
        if key not in self._compared:
            self._compared[key] = read.answers[key] == door.hash(value)
        return self._compared[key]

    def opened(self, path: str, mode: str | None) -> None:
        """A file was opened: an answer, if it is the project's, no Python and only read."""
        if self._reading is None or set(mode or "r") & set("wax+"):
            return
        place = Path(os.path.abspath(path))
        if place.is_relative_to(self._root) and not self._sources.follows(place):
            below = place.relative_to(self._root)
            if not UNREAD & set(below.parts):
                read, self._reading = self._reading, None
                key = json.dumps([FILE, [below.as_posix()]])
                read.answers[key] = self._answer(key)
                self._reading = read

    def _answer(self, key: str) -> str:
        """Hash of what a door answers now; of a door that no longer can, a text that is no hash."""
        name, arguments = json.loads(key)
        if name == FILE:
            return self._sources.digest(self._root / arguments[0])
        if key not in self._known:
            try:
                self._known[key] = self._doors[name].hash(self._doors[name].again(*arguments))
            except (ValueError, LookupError, OSError, TypeError) as error:
                self._known[key] = f"none: {error}"
        return self._known[key]

    # What a check depends on before it runs

    def _of(self, item: pytest.Function, kind: str) -> str:
        """Hash of all that a check depends on but for its answers."""
        base = self._static_of(item.path, kind, frozenset(item.fixturenames) & self._extra.keys())
        params = getattr(item, "callspec", None)
        try:
            values = plain(params.params if params else {}, self._sources.digest)
        except TypeError as error:
            raise pytest.UsageError(f"{item.nodeid}: {error}") from error
        return hashlib.sha256(json.dumps([base, item.nodeid, values]).encode()).hexdigest()

    def _static_of(self, path: Path, kind: str, fixtures: frozenset[str]) -> str:
        key = f"{path} {kind} {sorted(fixtures)}"
        if key not in self._static:
            files = set(self._sources.below(path))
            for folder in path.relative_to(self._root).parents:
                if (conftest := self._root / folder / "conftest.py").is_file():
                    files |= self._sources.below(conftest)
            parts = [
                self._sources.digest_of(files, self._root),
                [self._extra[name]() for name in sorted(fixtures)],
                self._where(),
                self._product() if kind == "product" else "",
            ]
            self._static[key] = hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
        return self._static[key]

    def _unnoted(self, item: pytest.Function) -> str:
        """What a check could depend on that its answers are not; empty: nothing."""
        for name, found in item._fixtureinfo.name2fixturedefs.items():
            if found[-1].scope != "function" and name not in self._shared and found[-1].baseid:
                return f"its fixture {name} is shared, and what that reads is not noted"
        for file in self._sources.below(item.path):
            test = item.originalname if file == item.path else ""
            if used := self._sources.uses(file, self._tables, test):
                return f"a function in {file.name} uses {sorted(used)}, which is not noted"
        return ""

    # The run

    def _kind(self, item: pytest.Item) -> str | None:
        """By what a check is remembered: ``answers``, ``product``, or not at all."""
        mark = item.get_closest_marker(MARK)
        if not isinstance(item, pytest.Function):
            return None
        by = mark.kwargs["by"] if mark else self._usual(item.fixturenames)
        if by == "answers" and (why := self._unnoted(item)):
            if mark:
                raise pytest.UsageError(f"{item.nodeid} is remembered by its answers, but {why}")
            return "product"
        return by

    def _file(self, item: pytest.Item) -> Path:
        return self._folder / f"{hashlib.sha256(item.nodeid.encode()).hexdigest()[:32]}.json"

    def _stands(self, item: pytest.Item) -> bool:
        """Whether a check passed with all that it depends on as it is now."""
        try:
            entry = json.loads(self._file(item).read_text(encoding="utf-8"))
            return entry["of"] == self._now[item.nodeid] and all(
                self._answer(key) == value for key, value in entry["answers"].items()
            )
        except (OSError, ValueError, KeyError):
            return False

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        """Leave out what stands."""
        if not self._active:
            return
        self._kinds = {item.nodeid: kind for item in items if (kind := self._kind(item)) is not None}
        if not self._kinds:
            return
        self._load()
        kept, out = [], []
        for item in items:
            kind = self._kinds.get(item.nodeid)
            if kind is None:
                kept.append(item)
                continue
            # For all of them before any runs: what is remembered is what was there then.
            self._now[item.nodeid] = self._of(item, kind)
            (out if self._stands(item) else kept).append(item)
        self._left_out = len(out)
        if out:
            config.hook.pytest_deselected(items=out)
            items[:] = kept

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, Any, Any]:
        kind = self._kinds.get(item.nodeid)
        if kind is None:
            return (yield)
        self._file(item).unlink(missing_ok=True)
        self._reading = read = Read()
        try:
            answered = yield
        finally:
            self._reading = None
        known = (read.certain or kind == "product") and not self._sources.edited()
        if known and read.passed == {"setup", "call", "teardown"}:
            entry = {"check": item.nodeid, "of": self._now[item.nodeid], "answers": read.answers}
            self._write(self._file(item), entry)
        return answered

    @pytest.hookimpl(wrapper=True, trylast=True)
    def pytest_runtest_makereport(self) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        report = yield
        if self._reading is not None:
            (self._reading.passed.add if report.outcome == "passed" else self._reading.passed.discard)(report.when)
        return report

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        if self._left_out:
            terminalreporter.write_line(
                f"{self._left_out} checks passed before with all that they depend on as it is now (CI=1 runs them too)"
            )

    def pytest_sessionfinish(self, session: pytest.Session, exitstatus: int) -> None:
        if self._left_out and exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:
            session.exitstatus = pytest.ExitCode.OK
        if self._active and not self._sources.edited():
            self._save()

    def pytest_unconfigure(self) -> None:
        if self._active:
            _OPENED.memo = self._before
        self._patch.undo()

    # Answers are kept for as long as the whole product is the same: a plan takes a while to make

    def _load(self) -> None:
        try:
            found = json.loads((self._folder / "answers.json").read_text(encoding="utf-8"))
            if found["of"] == [self._product(), self._where()]:
                self._known.update(found["answers"])
        except (OSError, ValueError, KeyError):
            pass

    def _save(self) -> None:
        if self._known:
            self._write(self._folder / "answers.json", {"of": [self._product(), self._where()], "answers": self._known})

    def _write(self, path: Path, entry: Any) -> None:
        """All of it or nothing."""
        self._folder.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(f".{os.getpid()}.part")
        part.write_text(json.dumps(entry, sort_keys=True), encoding="utf-8")
        part.replace(path)
