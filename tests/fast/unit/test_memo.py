"""What is remembered of checks: anything that changed runs them again, and nothing that failed is taken for passed."""

import sys
from pathlib import Path

import pytest

CONFTEST = """
import inputs

def pytest_configure(config):
    config.addinivalue_line("markers", "remembered(by): left out where nothing changed")
    config.pluginmanager.register(inputs.memo())
"""
INPUTS = """
from pathlib import Path
import product
from support.memo import Door, Memo
from support.sources import Sources

HERE = Path(__file__).parent

def memo():
    sources = Sources((HERE,), {("inputs", ""), ("product", "make_plan"), ("product", "CASES")})
    return Memo(
        root=HERE,
        folder=HERE / ".cache" / "checks",
        sources=sources,
        where=lambda: (HERE / "renderer").read_text(),
        doors={"plan": Door((product,), "make_plan", lambda name: [name], product.make_plan, str)},
        extra={"browser": lambda: (HERE / "bundle.js").read_text()},
        shared=frozenset({"browser"}),
        tables=frozenset({"CASES"}),
        usual=lambda fixtures: "answers" if "gpu" in fixtures else None,
        product=lambda: sources.digest_of([HERE / "shader", HERE / "other", HERE / "product.py"], HERE),
    )
"""
PRODUCT = """
from pathlib import Path

def make_plan(name):
    return (Path(__file__).parent / name).read_text()

CASES = ("a", "b")
"""
EXECUTOR = """
import helper

def draw(plan):
    return len(plan) + helper.EXTRA
"""
CHECKS = """
from pathlib import Path
import pytest
from executor import draw
from product import CASES, make_plan

HERE = Path(__file__).parent
TOLERANCE = 3

def ran(name):
    with (HERE / "ran.log").open("a") as log:
        log.write(name + " ")

@pytest.mark.remembered(by="answers")
@pytest.mark.parametrize("case", CASES)
def test_frame(case):
    ran("frame")
    want = int((HERE / "reference.txt").read_text())
    assert abs(draw(make_plan("shader")) - want) <= TOLERANCE

@pytest.mark.remembered(by="answers")
def test_other():
    ran("other")
    assert make_plan("other")

@pytest.fixture(scope="session")
def browser():
    yield "chromium"

@pytest.mark.remembered(by="answers")
def test_page(browser):
    ran("page")

@pytest.mark.remembered(by="product")
def test_whole():
    ran("whole")

def test_plain():
    ran("plain")
"""
ALL = ["frame", "frame", "other", "page", "whole", "plain"]


class Project:
    """A project of its own, with checks that the plugin remembers."""

    def __init__(self, pytester: pytest.Pytester) -> None:
        self._pytester = pytester
        self.path: Path = pytester.path
        self.write(
            **{
                "conftest.py": CONFTEST,
                "inputs.py": INPUTS,
                "product.py": PRODUCT,
                "executor.py": EXECUTOR,
                "test_all.py": CHECKS,
            },
            **{"helper.py": "EXTRA = 0\n", "shader": "abc", "other": "x", "renderer": "llvmpipe", "bundle.js": "1"},
            **{"reference.txt": "3"},
        )

    def write(self, **files: str) -> None:
        for name, text in files.items():
            (self.path / name).write_text(text, encoding="utf-8")

    def result(self) -> pytest.RunResult:
        """Run it."""
        return self._pytester.runpytest_inprocess("-q", "-p", "no:cacheprovider")

    def run(self, failed: int = 0, errors: int = 0) -> list[str]:
        """Run it; the checks that ran, in order. All that did not run were left out."""
        log = self.path / "ran.log"
        log.unlink(missing_ok=True)
        result = self.result()
        ran = log.read_text(encoding="utf-8").split()
        outcomes = {"passed": len(ran) - failed, "failed": failed, "errors": errors, "deselected": len(ALL) - len(ran)}
        result.assert_outcomes(**outcomes)
        return ran

    def refused(self, said: str) -> None:
        """Run it; nothing runs, and the reason is told."""
        result = self.result()
        assert result.ret == pytest.ExitCode.USAGE_ERROR
        assert not (self.path / "ran.log").exists()
        result.stderr.fnmatch_lines(f"*{said.replace('[', '[[]')}*")


@pytest.fixture
def project(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.delenv("CI", raising=False)
    # Compiled files are told apart by second and size; here files change within one.
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    # Its own, not the project's of that name.
    monkeypatch.delitem(sys.modules, "inputs", raising=False)
    return Project(pytester)


def test_what_did_not_change_does_not_run_again(project: Project) -> None:
    assert project.run() == ALL
    assert project.run() == ["plain"]
    assert project.run() == ["plain"]


def test_a_run_of_which_nothing_is_left_is_a_good_one(project: Project) -> None:
    project.write(**{"test_all.py": CHECKS.replace("def test_plain", "def not_a_test")})
    for _ in range(2):
        result = project.result()
        assert result.ret == pytest.ExitCode.OK
    result.stdout.fnmatch_lines("5 checks passed before*")


CHANGES = {
    "plan": ("shader", "abcd", ["frame", "frame", "whole", "plain"]),
    "another plan": ("other", "xy", ["other", "whole", "plain"]),
    "reference": ("reference.txt", "4", ["frame", "frame", "plain"]),
    "renderer": ("renderer", "another", ALL),
    "bundle": ("bundle.js", "2", ["page", "plain"]),
    "executor": ("executor.py", EXECUTOR.replace("len(plan)", "len(plan) * 1"), ALL),
    "what that imports": ("helper.py", "EXTRA = 1\n", ALL),
    "tolerance": ("test_all.py", CHECKS.replace("TOLERANCE = 3", "TOLERANCE = 2"), ALL),
    "body": ("test_all.py", CHECKS.replace('assert make_plan("other")', 'assert make_plan("other") != ""'), ALL),
    "case": ("product.py", PRODUCT.replace('("a", "b")', '("a", "c")'), ["frame", "whole", "plain"]),
    "planner": ("product.py", PRODUCT.replace("text()", "text() + '!'"), ["frame", "frame", "other", "whole", "plain"]),
}
"""What changes, to what, and which checks run again."""


@pytest.mark.parametrize("change", CHANGES)
def test_what_changed_runs_again(project: Project, change: str) -> None:
    file, text, again = CHANGES[change]
    assert project.run() == ALL
    project.write(**{file: text})
    assert project.run() == again
    assert project.run() == ["plain"]


def test_a_check_that_failed_is_not_remembered(project: Project) -> None:
    project.write(**{"reference.txt": "99"})
    assert project.run(failed=2) == ALL
    assert project.run(failed=2) == ["frame", "frame", "plain"]
    # Nor is that it passed before it failed.
    project.write(**{"reference.txt": "3"})
    assert project.run() == ["frame", "frame", "plain"]
    project.write(**{"reference.txt": "99"})
    assert project.run(failed=2) == ["frame", "frame", "plain"]
    project.write(**{"reference.txt": "3"})
    assert project.run() == ["frame", "frame", "plain"]


def test_a_check_whose_tear_down_failed_is_not_remembered(project: Project) -> None:
    project.write(**{"test_all.py": CHECKS.replace('yield "chromium"', 'yield "chromium"\n    assert False')})
    # The browser is closed after the last check, which is no remembered one; alone, the page's closes it.
    project.write(**{"test_all.py": (project.path / "test_all.py").read_text().replace('scope="session"', "")})
    assert project.run(errors=1) == ALL
    assert project.run(errors=1) == ["page", "plain"]


def test_ci_runs_every_check_and_remembers_none(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CI", "1")
    assert project.run() == project.run() == ALL
    assert not (project.path / ".cache").exists()
    monkeypatch.delenv("CI")
    assert project.run() == ALL
    monkeypatch.setenv("CI", "1")
    assert project.run() == ALL


def test_what_was_edited_while_it_ran_is_not_remembered(project: Project) -> None:
    editing = CHECKS.replace('ran("page")', 'ran("page"); (HERE / "helper.py").write_text("EXTRA = 0 # again")')
    project.write(**{"test_all.py": editing})
    assert project.run() == ALL
    # Frames ran before the edit and hold for the text before it; the edit is another text.
    assert project.run() == ALL


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('ran("other")', 'ran("other"); assert CASES', "uses ['CASES']"),
        ("TOLERANCE = 3", "TOLERANCE = len(CASES)", "uses ['TOLERANCE']"),
        ("def test_other():", "def test_other(tmp_path_factory, wide):", "its fixture wide is shared"),
    ],
)
def test_what_could_not_be_noted_is_refused(project: Project, old: str, new: str, said: str) -> None:
    wide = '@pytest.fixture(scope="module")\ndef wide(): ...\n'
    project.write(**{"test_all.py": CHECKS.replace(old, new).replace("@pytest.fixture", wide + "@pytest.fixture", 1)})
    project.refused(said)


def test_a_door_that_raises_is_not_remembered(project: Project) -> None:
    raising = CHECKS.replace('assert make_plan("other")', "with pytest.raises(OSError): make_plan('none')")
    project.write(**{"test_all.py": raising})
    assert project.run() == ALL
    assert project.run() == ["other", "plain"]
