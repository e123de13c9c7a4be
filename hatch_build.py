"""Puts shaders, masks and the built web client into the wheel; an editable install reads them in place."""

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

DATA = {"shaders": "shaders", "masks": "masks", "webclient/dist": "webclient"}


class DataHook(BuildHookInterface):
    """Maps the checkout's data folders to ``seafoam/_data``."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if self.target_name != "wheel" or version == "editable":
            return
        for source, name in DATA.items():
            path = Path(self.root, source)
            if not path.is_dir():
                raise FileNotFoundError(f"{source} is missing: run 'make webclient' before building the wheel")
            for file in path.rglob("*"):
                if file.is_file() and file.suffix not in (".py", ".pyc"):
                    build_data["force_include"][str(file)] = f"seafoam/_data/{name}/{file.relative_to(path)}"
