"""The machine that the figures are from."""

import os
import platform
from importlib.metadata import version

from seafoam.accuracy.model import processor


def load() -> str:
    """Load averages over 1, 5 and 15 minutes."""
    return " ".join(f"{value:.1f}" for value in os.getloadavg())


def describe() -> dict[str, str]:
    """Processor, cores and versions."""
    packages = ("seafoam", "moderngl", "numpy", "Pillow", "fastapi", "uvicorn")
    return {
        "processor": processor(),
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()} {platform.release()}, Python {platform.python_version()}",
        "packages": ", ".join(f"{name} {version(name)}" for name in packages),
        "load at the start": load(),
    }
