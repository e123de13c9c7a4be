"""Snippets of README.md and docs: each is run by a test or listed with a reason, and those that need no GL run here."""

import re
import runpy
import shlex
import sys

import pytest
from bench.__main__ import main as bench
from bench.gpu.__main__ import main as bench_gpu

from support.command import run
from support.snippets import NOT_RUN, PAGES, ROOT, blocks, commands, text

RUN = {
    "README.md": "tests/gpu/docs/test_snippets.py",
    "docs/python.md": "tests/gpu/docs/test_snippets.py",
    "docs/sequences.md": "tests/gpu/docs/test_snippets.py",
    "docs/operations.md": "tests/fast/cli/test_documented.py",
}
"""Pages -> the file that runs their fenced snippets and, but for those of NOT_RUN, their commands."""
BENCHES = {"bench": bench, "bench.gpu": bench_gpu}


def listed(command: str) -> bool:
    return any(command.startswith(beginning) for beginning in NOT_RUN)


def test_every_snippet_is_run_or_has_a_reason() -> None:
    for page in PAGES:
        languages = set(re.findall(r"^```(\w+)$", text(page), re.MULTILINE))
        assert languages <= {"python", "sh", "bibtex"}, f"{page}: {languages}"
        if page in RUN:
            assert page.removeprefix("docs/") in (ROOT / RUN[page]).read_text(encoding="utf-8"), page
        else:
            assert languages == set(), page
            assert [command for command in commands(page) if not listed(command)] == [], page


def test_every_reason_has_its_snippet() -> None:
    found = [command for page in PAGES for command in commands(page)]
    for beginning in NOT_RUN:
        assert any(command.startswith(beginning) for command in found), beginning


@pytest.mark.parametrize("page", PAGES)
def test_what_is_not_run_names_what_exists(page: str, monkeypatch: pytest.MonkeyPatch) -> None:
    targets = re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    for command in filter(listed, commands(page)):
        program, *arguments = shlex.split(command)
        if program == "make":
            assert set(arguments) <= set(targets), command
        elif "pytest" in program or arguments[0].endswith(".py"):
            assert all((ROOT / each).exists() for each in arguments if each.startswith(("tests/", "docs/"))), command
        elif arguments[:1] == ["-m"] and arguments[1] in BENCHES:
            monkeypatch.setattr(sys, "argv", ["bench", *arguments[2:], "--help"])
            with pytest.raises(SystemExit) as left:
                BENCHES[arguments[1]]()
            assert left.value.code == 0, command


def test_operations(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """docs/operations.md: a link signed by the command and by Python, and a size for other numbers."""
    sign, sizing = blocks("docs/operations.md", "sh")
    variables = dict(re.findall(r"(SEAFOAM_\w+)=(\w+)", sign))
    (command,) = [line for line in sign.splitlines() if line.startswith("seafoam")]
    done = run(*shlex.split(command)[1:], **variables)
    assert done.returncode == 0, done.stderr
    (python,) = blocks("docs/operations.md", "python")
    exec(compile(python, "operations.md", "exec"), {})
    assert capsys.readouterr().out == done.stdout
    program, script, *arguments = shlex.split(sizing)
    assert program == ".venv/bin/python"
    monkeypatch.setattr(sys, "argv", [script, *arguments])
    runpy.run_path(str(ROOT / script), run_name="__main__")
    assert "50,000   80%" in capsys.readouterr().out
