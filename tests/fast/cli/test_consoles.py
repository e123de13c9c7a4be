"""The command's process: what it imports, where it listens, and what consoles show."""

import os
import socket
from pathlib import Path

import pytest

from seafoam.cli.listening import listen
from seafoam.cli.support import CommandError
from support.command import imported, run


def test_what_a_console_cannot_show_ends_no_command_and_takes_one_readable_line(tmp_path: Path) -> None:
    done = run("render", "default", "-o", "ä.gif", PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert r"\xe4.gif" in done.stderr
    path = tmp_path / "a\n\x1b[31mb\udcff.png"
    done = run("masks", "make", "--size", "32", "--sigma", "1", "-o", path, PYTHONIOENCODING="ascii")
    assert done.returncode == 0, done.stderr
    assert path.is_file()
    assert done.stdout.count("\n") == 1
    assert r"a\x0a\x1b[31mb\udcff.png: vac, 32 \xd7 32" in done.stdout


WITH_IPV6 = pytest.mark.skipif(not os.path.exists("/proc/net/if_inet6"), reason="this machine has no IPv6")


@pytest.mark.parametrize(
    ("host", "url", "reached"),
    [
        ("localhost", "http://localhost:", ["127.0.0.1"]), ("", "http://127.0.0.1:", ["127.0.0.1"]),
        pytest.param("::1", "http://[::1]:", ["::1"], marks=WITH_IPV6),
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


def test_addresses_of_others_and_unknown_names() -> None:
    for host in ("192.0.2.1", "no.such.invalid", "a..b"):
        with pytest.raises(CommandError, match=f"cannot listen on {host}:9: .*--host"):
            listen(host, 9)


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
