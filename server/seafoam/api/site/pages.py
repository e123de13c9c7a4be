"""HTML pages: the web client at ``/``, its chapter at ``/learn`` and the API reference at ``/docs``, without external
resources."""

import mimetypes
import os
from pathlib import Path

from fastapi import FastAPI, Request
from starlette.datastructures import Headers
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from seafoam.api.http.etags import IMMUTABLE, REVALIDATE
from seafoam.api.site import link_previews
from seafoam.resources import data_dir

NOT_BUILT = """Seafoam is running, but its web client has not been built.

To build it, run:  make webclient
The API's description is at /openapi.json, a rendered frame at /api/frames/default.png.
"""

_MANUAL = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <title>Seafoam: API</title>
    <link rel="icon" href="icon.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="docs/swagger-ui.css" />
  </head>
  <body>
    <div id="manual" data-description="openapi.json"></div>
    <script src="docs/swagger-ui-bundle.js"></script>
    <script src="docs/manual.js"></script>
  </body>
</html>
"""


PAGES = {
    ".": "index.html",
    "masks": "masks/index.html",
    "learn": "learn/index.html",
    "learn/laboratory": "learn/laboratory/index.html",
}
"""Files of the build by the path of their page."""


class WebClient(StaticFiles):
    """Serves the built web client, or a text that says how to build it."""

    def __init__(self, directory: Path) -> None:
        super().__init__(directory=directory, html=True, check_dir=False)
        self.folder = directory

    async def check_config(self) -> None:
        """Accept a missing build."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """Return a file, compressed with Brotli if the build contains that and the client prefers it.

        Files under ``assets`` carry their hash in their name, so they never change.
        """
        if path in PAGES and not (self.folder / PAGES[path]).is_file():
            return PlainTextResponse(NOT_BUILT, headers={"Cache-Control": "no-store"})
        # Browsers ask for it beside answers that are no page.
        path = "icon.svg" if path == "favicon.ico" else path
        packed = os.path.isfile(self.folder / f"{path}.br")  # False, too, for a name that no file can have
        chosen = f"{path}.br" if packed and Headers(scope=scope).get("accept-encoding", "").startswith("br") else path
        response = await super().get_response(chosen, scope)
        if packed:
            response.headers["Vary"] = "Accept-Encoding"
        if chosen != path:
            response.headers["Content-Type"] = mimetypes.guess_type(path)[0] or "application/octet-stream"
            response.headers["Content-Encoding"] = "br"
        response.headers["Cache-Control"] = IMMUTABLE if path.startswith("assets/") else REVALIDATE
        return response


def install(app: FastAPI) -> None:
    """Serve the pages on paths that no route of the application matches."""
    link_previews.install(app, NOT_BUILT)
    app.add_api_route("/docs", _manual, include_in_schema=False)
    app.add_api_route("/api/", _operations, include_in_schema=False)
    # The stills' type, which Python 3.11 knows only where the system tells it.
    mimetypes.add_type("image/avif", ".avif")
    app.router.default = WebClient(data_dir("webclient"))


async def _operations(request: Request) -> Response:
    """Return what the API can do, a line each; a browser is led to the API reference."""
    if "text/html" in request.headers.get("accept", ""):
        return RedirectResponse("../docs", headers={"Vary": "Accept"})
    operations = [
        {"method": method.upper(), "path": path, "summary": operation["description"].partition("\n")[0]}
        for path, methods in request.app.openapi()["paths"].items()
        for method, operation in methods.items()
    ]
    content = {"reference": "../docs", "description": "../openapi.json", "operations": operations}
    return JSONResponse(content, headers={"Vary": "Accept", "Cache-Control": REVALIDATE})


async def _manual() -> Response:
    """Return the API reference. Its scripts are part of the web client's build: FastAPI's own page uses a CDN and an
    inline script.
    """
    if not (data_dir("webclient") / "docs" / "swagger-ui-bundle.js").is_file():
        return PlainTextResponse(NOT_BUILT, headers={"Cache-Control": "no-store"})
    return HTMLResponse(_MANUAL, headers={"Cache-Control": REVALIDATE})
