"""The command in a process of its own, and a port for a server."""

import os
import socket
import subprocess
import sys

COMMAND = [sys.executable, "-c", "from seafoam.cli import main; main()"]


def run(*arguments, **environment):
    """The command with these arguments, and variables over those of this process; its output as text."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=60, env={**os.environ, **environment}
    )


def free_port() -> int:
    """A port of this machine that nobody listens at."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port
