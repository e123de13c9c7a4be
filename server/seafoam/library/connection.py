"""A server's frames and masks, over its REST API."""

import json
import threading
import time
from http import HTTPStatus
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.parse import quote, urlencode, urlsplit
from urllib.request import Request, urlopen

from seafoam.library.request import InvalidRequestError, ServerError
from seafoam.library.source import MaskRequest, PictureSource
from seafoam.render.service.jobs import FrameJob

REQUESTS = 4
"""Requests at a time of one connection."""
ATTEMPTS = 4
"""Requests for one picture while the server is busy."""
LONGEST_WAIT = 30.0
"""Between two of them, s, however long the server asks to wait."""
_LATER = (HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE)
_REFUSED = (HTTPStatus.NOT_FOUND, HTTPStatus.REQUEST_ENTITY_TOO_LARGE, HTTPStatus.UNPROCESSABLE_ENTITY)


class Connection(PictureSource):
    """Draws on a Seafoam server, at ``http://`` or ``https://``; scenes are sent whole.

    Nothing is sent before the first picture is asked for. A busy server (503), or one that is asked too often (429), is
    asked again after the time that it names. The server's limits of size hold.

    key: of the server's API, where it asks for one. timeout: s, of each request. Raises
    :class:`seafoam.InvalidRequestError` for another kind of address.
    """

    def __init__(self, url: str, *, key: str | None = None, timeout: float = 60.0) -> None:
        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise InvalidRequestError(f"url: must begin with http:// or https:// and a host, not {url!r}")
        self.url = url.rstrip("/")
        self._headers = {} if key is None else {"Authorization": f"Bearer {key}"}
        self._timeout = timeout
        self._places = threading.BoundedSemaphore(REQUESTS)

    def close(self) -> None:
        """Do nothing: each request has a connection of its own."""

    def _draw(self, job: FrameJob) -> bytes:
        return self._ask("/api/frames", json.dumps(job.request).encode())

    def _mask(self, asked: MaskRequest) -> bytes:
        given = asked.given
        if size := given.pop("size", None):
            given["width"], given["height"] = size if isinstance(size, tuple) else (size, size)
        query = urlencode({"family": asked.name, **given})
        mask = f"custom/data.npy?{query}" if given else f"{quote(asked.name, safe='')}/data.npy"
        return self._ask(f"/api/masks/{mask}", None)

    def _ask(self, path: str, body: bytes | None) -> bytes:
        media = {} if body is None else {"Content-Type": "application/json"}
        request = Request(self.url + path, body, self._headers | media)
        for attempt in range(1, ATTEMPTS + 1):
            try:
                with self._places, urlopen(request, timeout=self._timeout) as response:
                    content: bytes = response.read()
                    return content
            except HTTPError as error:
                with error:
                    problem = _problem(error)
                if error.code not in _LATER or attempt == ATTEMPTS:
                    kind = InvalidRequestError if error.code in _REFUSED else None
                    raise (kind(problem) if kind else ServerError(problem, error.code)) from None
                time.sleep(_wait(error, attempt))
            except (URLError, TimeoutError, ConnectionError) as error:
                why = getattr(error, "reason", error)
                raise ServerError(f"{self.url} does not answer: {why}") from error
        raise AssertionError("the last attempt returns or raises")


def _problem(error: HTTPError) -> str:
    try:
        document: Any = json.load(error)
        return str(document["detail"])
    except (ValueError, TypeError, KeyError):
        return f"the server answered {error.code} {error.reason}"


def _wait(error: HTTPError, attempt: int) -> float:
    asked = error.headers.get("Retry-After", "")
    return min(LONGEST_WAIT, float(asked) if asked.isdecimal() else float(attempt))
