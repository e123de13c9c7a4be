"""Requests drawn at random over every route: no 500, no traceback, no wrong negotiation, what is described alone."""

import json
import logging
import math
import re
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import quote, unquote

import hypothesis
import pytest
import schemathesis
from fastapi.routing import iter_route_contexts
from hypothesis import strategies as st
from starlette.routing import compile_path
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.settings import Settings
from seafoam.render.service.queues import BackgroundFullError
from support.api_fakes import FakeRenderer
from support.serving import document, serving
from support.sweep import REST

MARGIN = 500
"""Bytes from which text is compressed."""
ELSEWHERE = "https://elsewhere.test"
APP = create_app(Settings(), renderer=FakeRenderer)
PATHS = document()["paths"]
DESCRIBED = schemathesis.openapi.from_dict(document())
ROUTES = sorted(
    {
        ("GET" if method == "HEAD" else method, str(route.path))
        for route in iter_route_contexts(APP.routes)
        for method in route.methods or ()
    }
    | {("GET", "/"), ("GET", "/icon.svg"), ("GET", "/assets/{name}")}  # what no route matches
)
PATTERNS = {path: compile_path(path)[0] for _, path in ROUTES if path.replace(":path}", "}") in PATHS}
GOOD = {
    "preset": "default", "mask": "vac-6", "name": "mask/vac-6/ranks", "format": "npy", "family": "vac", "size": "32",
    "width": "16", "height": "16", "time": "1.5", "x": "0", "y": "4.5", "z": "-20", "yaw": "0.35", "pitch": "-0.2",
    "roll": "0", "fov": "0.9", "plan": "0" * 64, "sequence": "0" * 32, "stream": "none", "quality": "fast",
}  # fmt: skip
"""Values that cost little; a parameter that is not named here is sent only if it is wrong."""
BAD = st.sampled_from([
    "", "1_000", "１２", "٣", " 5 ", "+5", "1e3", "1e999", "nan", "-Infinity", "0x10", "9" * 400, "\x00", "\r\nX: y",
    "\x1b[31m", "\ufffe", "\u202e", "💧", "..", "../..", "%", "a" * 300, "[", "\\", '"', "<b>", "vac:3_0:32:1",
]) | st.text(max_size=6)  # fmt: skip
WRONG = st.sampled_from([
    None, True, -1, 1e308, 2**70, "1_0", "１２", "\ud800", "x\udfffy", "\x00", "💧", [], {}, {"\udc00": 1},
    [["\ud83d"]], float("nan"), "9" * 500,
])  # fmt: skip
CODINGS = st.lists(st.sampled_from(["gzip", "br", "identity", "deflate", "zstd"]), max_size=4, unique=True)
OTHERS = st.fixed_dictionaries(
    {},
    optional={
        "Origin": st.sampled_from([ELSEWHERE, "null", "https://other.test"]),
        "If-None-Match": st.sampled_from(["*", '"x"', 'W/"x", "y"', '"', "x", ",", "é"]),
        "If-Modified-Since": st.sampled_from(["Sat, 01 Jan 2000 00:00:00 GMT", "0", "Sat, 99 Foo 9999999999"]),
        "Range": st.sampled_from(["bytes=0-3", "bytes=9-1", "bytes=-", "lines=1-2", "bytes=99999999-", "bytes=0-1,3-"]),
        "X-Request-ID": st.sampled_from(["sane", "a b", "é", "x" * 200]),
        "Authorization": st.sampled_from(["Basic /w==", "Bearer é", "Basic"]),
        "Host": st.sampled_from(["[", "a b", "é", "x:99999"]),
    },
)
Draw = Callable[[st.SearchStrategy[Any]], Any]


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    def full(*_: object) -> None:
        raise BackgroundFullError("none is measured here")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("seafoam.api.routers.masks.ON_REQUEST_SECONDS", 0.05)
        with serving(cors_origins=ELSEWHERE, max_side=64, queue=64, sequences_waiting=1, streams=2) as client:
            for name in ("sweep", "truth"):
                patch.setattr(client.app.state.context.sweeps, name, full)
            yield client


def address(draw: Draw, path: str, declared: list[dict[str, Any]]) -> str:
    """An address of a route, whose parameters are now and then wrong."""

    def value(name: str) -> str:
        wrong = draw(st.integers(0, 5)) == 0
        return quote(draw(BAD) if wrong or name not in GOOD else GOOD[name], safe="/" if not wrong else "")

    filled = re.sub(r"\{(\w+)(?::\w+)?\}", lambda found: value(found[1]), path)
    names = [each["name"] for each in declared if each["in"] == "query"]
    sent = [name for name in names if name in GOOD or draw(st.integers(0, 5)) == 0]
    return f"{filled}?{'&'.join(f'{name}={value(name)}' for name in sent)}" if sent else filled


def body(draw: Draw, schema: dict[str, Any]) -> bytes:
    """A small body of an operation, which is now and then wrong."""
    components = document()["components"]["schemas"]
    properties = components[schema["$ref"].rpartition("/")[2]]["properties"]
    known = {"scene": {}, "quality": "fast", "width": 16, "height": 16, "stop": 0.05, "format": "zip"}
    if "format" in properties and "zip" not in properties["format"]["enum"]:
        known["format"] = "png"
    made = {name: value for name, value in known.items() if name in properties}
    for _ in range(draw(st.integers(0, 2))):
        made[draw(st.sampled_from([*properties, "\ud800", "unknown"]))] = draw(WRONG)
    text = json.dumps(made).encode()
    return draw(st.sampled_from([text] * 6 + [text[:-1], text + b"\xff", b"[" * 2000, text.replace(b":", b":\x00", 1)]))


def check_problem(response: Any, asked: str) -> None:
    """Errors are problems, and a page of a listed origin can read them."""
    assert response.status_code not in (500, 502), asked
    media = response.headers.get("content-type", "")
    # Starlette's own words to a Range.
    told = "text/html" in media or ("text/plain" in media and "range" in response.request.headers)
    if response.status_code >= 400 and response.content and not told:
        assert media == "application/problem+json", asked
        assert response.json()["status"] == response.status_code
    for name, value in response.headers.items():
        assert not re.search(r"[\x00-\x1f\x7f]", name + value), asked


def check_coding(response: Any, codings: list[str], asked: str) -> None:
    """The coding is one that the client accepts."""
    coding = response.headers.get("content-encoding")
    if coding is not None:
        assert coding in codings, asked
        assert "accept-encoding" in response.headers["vary"].lower(), asked
    elif response.headers.get("content-type") == "application/json" and len(response.content) >= MARGIN:
        assert "gzip" not in codings, asked


def check_origin(response: Any, origin: str | None, route: tuple[str, str], asked: str) -> None:
    allowed = response.headers.get("access-control-allow-origin")
    if origin == ELSEWHERE:
        assert allowed in ("*", ELSEWHERE), asked
    elif route[1].startswith(
        ("/api/frames", "/api/streams", "/api/sequences", "/api/accuracy", "/api/export", "/metrics")
    ):
        assert allowed is None, asked


def check_description(response: Any, route: tuple[str, str], address: str) -> None:
    """What the route answers has a status, media type, headers and content that its operation describes."""
    method, path = route
    asked = unquote(address.partition("?")[0])
    # A wrong name may lead to another route, and any copy of what is not described as kept is current too.
    if [each for each in PATTERNS if PATTERNS[each].match(asked)] == [path] and response.status_code != 304:
        DESCRIBED[path.replace(":path}", "}")][method].validate_response(response)


def check_copy(client: TestClient, address: str, headers: list[tuple[str, str]], response: Any) -> None:
    """A copy is known by its tag."""
    tag = response.headers.get("etag")
    if tag is None or response.status_code != 200:
        return
    kept = [pair for pair in headers if pair[0] in ("Accept-Encoding", "Origin")]
    again = client.get(address, headers=[*kept, ("If-None-Match", f'"x", {tag}')])
    assert (again.status_code, again.content) == (304, b""), address
    assert again.headers["etag"] == tag, address
    assert again.headers.get("cache-control") == response.headers.get("cache-control"), address


@pytest.mark.parametrize("least", [200, pytest.param(10_000, marks=REST)])
@pytest.mark.parametrize("route", ROUTES, ids=" ".join)
def test_no_request_breaks_a_route(
    client: TestClient, route: tuple[str, str], least: int, caplog: pytest.LogCaptureFixture
) -> None:
    """So many requests, over all routes."""
    method, path = route
    operation = PATHS.get(path.replace(":path}", "}"), {}).get(method.lower(), {})
    declared = operation.get("parameters", [])
    content = operation.get("requestBody", {}).get("content", {}).get("application/json")

    @hypothesis.seed(35)
    @hypothesis.settings(
        max_examples=math.ceil(least / len(ROUTES)), deadline=None, database=None,
        phases=[hypothesis.Phase.generate], suppress_health_check=list(hypothesis.HealthCheck),
    )  # fmt: skip
    @hypothesis.given(data=st.data())
    def ask(data: st.DataObject) -> None:
        url = address(data.draw, path, declared)
        codings, others = data.draw(CODINGS), data.draw(OTHERS)
        headers = [("Accept-Encoding", ", ".join(codings)), *others.items()]
        if content:
            headers.append(("Content-Type", data.draw(st.sampled_from(["application/json"] * 5 + ["text/plain"]))))
        sent = body(data.draw, content["schema"]) if content else None
        verb = data.draw(st.sampled_from([method] * 6 + ["HEAD", "PATCH", "OPTIONS"]))
        encoded = [(name, value.encode("latin-1")) for name, value in headers]
        response = client.request(verb, url, headers=encoded, content=sent, follow_redirects=False)
        asked = f"{verb} {url} {headers} {sent!r}: {response.status_code} {response.text[:300]}"
        check_problem(response, asked)
        check_origin(response, others.get("Origin"), route, asked)
        if verb == "PATCH" and response.status_code != 404:
            assert response.status_code in (405, 429), asked
        if verb == method:
            check_coding(response, codings, asked)
            check_description(response, route, url)
        if verb == method == "GET":
            check_copy(client, url, headers, response)

    with caplog.at_level(logging.WARNING):
        ask()
    assert not [record for record in caplog.records if record.exc_info or "Traceback" in record.getMessage()]
