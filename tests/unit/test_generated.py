"""What is generated and checked in is what would be generated now."""

import json
import subprocess
from pathlib import Path

from seafoam.api.app import create_app

WEB = Path(__file__).parents[2] / "webclient"


def test_the_openapi_document_is_the_apis() -> None:
    written = json.loads((WEB / "openapi.json").read_text(encoding="utf-8"))
    assert written == json.loads(json.dumps(create_app().openapi())), "run make docs"


def test_the_clients_types_are_of_that_document(tmp_path: Path) -> None:
    made = tmp_path / "api.ts"
    script = json.loads((WEB / "package.json").read_text(encoding="utf-8"))["scripts"]["types"]
    words = [str(made) if word == "src/generated/api.ts" else word for word in script.split()]
    command = [WEB.parent / "scripts" / "node.sh", "npx", "--no-install", *words]
    subprocess.run(command, cwd=WEB, check=True, capture_output=True)
    assert made.read_text() == (WEB / "src" / "generated" / "api.ts").read_text(), "run make docs"
