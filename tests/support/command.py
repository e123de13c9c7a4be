"""The command in a process of its own."""

import os
import subprocess
import sys

COMMAND = [sys.executable, "-c", "from seafoam.cli import main; main()"]


def run(*arguments, **environment):
    """The command with these arguments, and variables over those of this process; its output as text."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=60, env={**os.environ, **environment}
    )
