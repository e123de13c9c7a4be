"""Where the GL driver keeps compiled programs between starts."""

import os
from contextlib import suppress
from pathlib import Path


def keep_programs(folder: Path) -> None:
    """Have Mesa keep what it compiles in a folder, unless the environment names one; workers inherit it."""
    if "MESA_SHADER_CACHE_DIR" not in os.environ:
        # Mesa makes the last folder of the path alone, and without it keeps nothing.
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            os.environ["MESA_SHADER_CACHE_DIR"] = str(folder)
