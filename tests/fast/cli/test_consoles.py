"""Consoles of other encodings, and names with control characters: readable text, exit code 0."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

from seafoam.api.app import create_app
from seafoam.cli.support import spelt
from support.command import COMMAND, run
from support.sweep import crossed

PLAIN_LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": ""}
CONSOLES = {"ascii": {"PYTHONIOENCODING": "ascii"}, "cp437": {"PYTHONIOENCODING": "cp437"}, "C locale": PLAIN_LOCALE}


COMMANDS = {
    "presets": r"^default +",
    "masks list": r"^vac-24 +",
    "masks shapes lace": r"largest component",
    "doctor": r"This machine can",
    "sequence --help": r"30000/1001",
    "masks make --size 32 --sigma 1 -o MASK": r"mask\.png: vac, 32 (x|\?|×) 32, ",
}
"""What each of them shows."""


@pytest.mark.parametrize(("command", "console"), crossed(COMMANDS, CONSOLES, len(CONSOLES)))
def test_every_console_gets_readable_text(tmp_path: Path, command: str, console: str) -> None:
    environment = {**os.environ, "PYTHONWARNDEFAULTENCODING": "1", "COLUMNS": "100", **CONSOLES[console]}
    arguments = command.replace("MASK", str(tmp_path / "mask.png")).split()
    done = subprocess.run([*COMMAND, *arguments], capture_output=True, timeout=60, env=environment)
    encoding = "cp437" if console == "cp437" else "ascii"
    text, errors = done.stdout.decode(encoding), done.stderr.decode(encoding)
    assert (done.returncode, errors) in ((0, ""), (1, "") if command == "doctor" else ())
    assert re.search(COMMANDS[command], text, re.MULTILINE), text
    assert "\\" not in text


def test_json_is_utf_8_on_every_console() -> None:
    done = subprocess.run([*COMMAND, "openapi"], capture_output=True, timeout=60, env={**os.environ, **PLAIN_LOCALE})
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout.decode("utf-8")) == create_app().openapi()


def test_errors_and_names_with_control_characters_take_one_readable_line(tmp_path: Path) -> None:
    done = run("render", "default", "-o", "ä.gif", PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "a.gif" in done.stderr
    path = tmp_path / "a\n\x1b[31mb\udcff.png"
    done = run("masks", "make", "--size", "32", "--sigma", "1", "-o", path)
    assert done.returncode == 0, done.stderr
    assert path.is_file()
    assert done.stdout.count("\n") == 1
    assert r"a\x0a\x1b[31mb\udcff.png: vac" in done.stdout


def test_what_cannot_be_shown_is_spelt() -> None:
    plain = {
        "640 × 360 − 2…": "640 x 360 - 2...",
        "σ ≤ Σ, µ": "sigma <= Sigma, u",
        "10⁻³ m², ½": "10-3 m2, 1/2",
        "Café “Å”": 'Cafe "A"',
        "海\udcff": "\\u6d77\\udcff",
    }
    for text, shown in plain.items():
        assert "".join(c if c.isascii() else spelt(UnicodeEncodeError("ascii", c, 0, 1, ""))[0] for c in text) == shown
