"""The command's process: what it imports, where it listens, and what consoles show."""

import json
import os
import re
import socket
import subprocess
from pathlib import Path

import pytest

from seafoam.cli import listening
from seafoam.cli.listening import listen
from seafoam.cli.support import CommandError, spelt
from support.command import COMMAND, imported, run
from support.sweep import crossed

PLAIN_LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": ""}
CONSOLES = {"ascii": {"PYTHONIOENCODING": "ascii"}, "cp437": {"PYTHONIOENCODING": "cp437"}, "C locale": PLAIN_LOCALE}
COMMANDS = {
    "presets": r"^default +",
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
    text = done.stdout.decode("utf-8")
    assert (json.loads(text)["info"]["title"], text.isascii()) == ("Seafoam", False)


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
        "640 × 360 − 2…": "640 x 360 - 2...", "σ ≤ Σ, µ": "sigma <= Sigma, u", "10⁻³ m², ½": "10-3 m2, 1/2",
        "Café “Å”": 'Cafe "A"', "海\udcff": "\\u6d77\\udcff",
    }  # fmt: skip
    for text, shown in plain.items():
        assert "".join(c if c.isascii() else spelt(UnicodeEncodeError("ascii", c, 0, 1, ""))[0] for c in text) == shown


WITH_IPV6 = pytest.mark.skipif(not os.path.exists("/proc/net/if_inet6"), reason="this machine has no IPv6")


@pytest.mark.parametrize(
    ("host", "url", "reached"),
    [
        ("127.0.0.1", "http://127.0.0.1:", ["127.0.0.1"]), ("localhost", "http://localhost:", ["127.0.0.1"]),
        ("", "http://127.0.0.1:", ["127.0.0.1"]), ("0.0.0.0", "http://127.0.0.1:", ["127.0.0.1"]),
        pytest.param("::1", "http://[::1]:", ["::1"], marks=WITH_IPV6),
        pytest.param("[::1]", "http://[::1]:", ["::1"], marks=WITH_IPV6),
        pytest.param("::", "http://127.0.0.1:", ["127.0.0.1", "::1"], marks=WITH_IPV6),
    ],
)  # fmt: skip
def test_both_versions_of_ip(host: str, url: str, reached: list[str]) -> None:
    server, address = listen(host, 0)
    with server:
        port = server.getsockname()[1]
        assert address == f"{url}{port}"
        for place in reached:
            socket.create_connection((place, port), timeout=5).close()


def test_addresses_of_others_of_zones_and_unknown_names() -> None:
    with pytest.raises(CommandError, match=r"cannot listen on 192\.0\.2\.1:9: .*no such address.*--host"):
        listen("192.0.2.1", 9)
    for host in ("no.such.invalid", "a..b", "999.1.1.1", "::1::"):
        with pytest.raises(CommandError, match="neither an address nor a name"):
            listen(host, 0)
    assert listening._authority("fe80::1%eth0", 80) == "[fe80::1%25eth0]:80"


HELP = "from seafoam.cli import main; main(['--help'])"
RENDER = """
from seafoam.cli import app, frames
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene import load_preset
make_plan(load_preset("default").scene, TIERS["standard"])
"""
"""What `seafoam render` does before it draws."""
HEAVY = {
    "IPython", "OpenEXR", "PIL", "anywidget", "asyncio", "av", "distributed", "fastapi", "isal", "matplotlib",
    "moderngl", "multiprocessing", "numpy", "opentelemetry", "pebble", "prometheus_client", "pydantic",
    "pydantic_settings", "rich", "scipy", "starlette", "typer", "uvicorn",
}  # fmt: skip
"""Packages that take long to import, or that only some uses need."""


OTHERS = ("seafoam.accuracy", "seafoam.reference", "seafoam.sequences", "seafoam.library", "seafoam.notebook")
"""Parts that a frame does not need."""


@pytest.mark.parametrize(
    ("code", "packages", "most"),
    [
        ("import seafoam", set(), 40),
        (HELP, {"typer", "rich"}, 300),
        (RENDER, {"typer", "pydantic", "numpy", "moderngl", "isal"}, 580),
    ],
    ids=["import", "help", "render"],
)
def test_a_start_imports_little(code: str, packages: set[str], most: int) -> None:
    found = imported(code)
    assert {name.partition(".")[0] for name in found} & HEAVY <= packages
    assert [name for name in found if name.startswith(OTHERS)] == []
    assert len(found) <= most, f"{len(found)} modules"
