"""The command in a process of its own, as a server too, and a port for one."""

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

MAIN = "from seafoam.cli import main; main()"
COMMAND = [sys.executable, "-c", MAIN]
UNPLANNED = f"""
from seafoam.api.routers import presets

async def plan_none(plans):
    pass

# Seconds of every start: whoever asks for the list of presets has it made then.
presets.warm = plan_none
{MAIN}
"""
"""The command, whose servers do not plan all presets before anybody asks."""
FAKED = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parents[1])!r})
from functools import partial
from seafoam.api import app
from support.api_fakes import FakeRenderer

app.create_app = partial(app.create_app, renderer=FakeRenderer)
{UNPLANNED}
"""
"""The same, with a renderer that only pretends to draw."""


def run(*arguments, **environment):
    """The command with these arguments, and variables over those of this process; its output as text."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=60, env={**os.environ, **environment}
    )


@contextmanager
def served(*arguments: str, port: int = 0, code: str = MAIN, **environment: str) -> Iterator[str]:
    """The address of a server by the command or another code; it must end when it is told to."""
    command = [sys.executable, "-c", code, "serve", "--port", str(port), *arguments]
    environment = {**os.environ, **environment}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment)
    try:
        yield process.stdout.readline().split()[3]
    finally:
        process.send_signal(signal.SIGTERM)
        process.stdout.close()
        assert process.wait(30) in (0, -signal.SIGTERM)


def imported(code: str) -> list[str]:
    """Names of the modules that a program imports, in a process of its own, beyond those of Python's own start."""
    script = f"""
import sys
before = set(sys.modules)
try:
    exec({code!r})
except SystemExit as left:
    assert not left.code, left.code
print("\\nMODULES", *sorted(set(sys.modules) - before))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)
    return done.stdout.splitlines()[-1].split()[1:]


def free_port() -> int:
    """A port of this machine that nobody listens at."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port
