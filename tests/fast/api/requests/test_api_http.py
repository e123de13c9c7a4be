"""What HTTP itself asks for: other origins, codings, conditional requests."""

from pathlib import Path

import pytest
from starlette.testclient import TestClient

from seafoam.api.http.middleware import accepted
from support.serving import SMALL, answering, problem

ELSEWHERE = {"Origin": "https://elsewhere.test"}
PUBLIC = (
    "/api/presets", "/api/presets/default", "/api/quality", "/api/schema", "/api/plans/default", "/api/masks",
    "/api/masks/vac-6", "/api/masks/vac-6/data.png", "/api/masks/custom/data.npy?family=vac&size=32",
    "/api/textures/mask/vac-6/ranks",
)  # fmt: skip
PRIVATE = (
    "/", "/docs", "/metrics", "/healthz", "/api/frames/default.png", "/api/presets/default/thumbnail.png?width=16",
    "/api/plans/0/frames/0.png", "/api/streams", "/api/sequences/0", "/api/accuracy/default/points",
)  # fmt: skip


@pytest.mark.parametrize("url", PUBLIC)
def test_pages_of_every_site_read_public_data(client: TestClient, url: str) -> None:
    response = client.get(url, headers=ELSEWHERE)
    assert response.status_code == 200
    tag = response.headers.get("ETag", '"none"')
    wrong = client.get(f"{url.partition('?')[0]}?wrong=1", headers=ELSEWHERE)
    same = client.get(url, headers=ELSEWHERE | {"If-None-Match": tag})
    assert wrong.status_code == 422
    for each in (response, wrong, same, client.head(url, headers=ELSEWHERE)):
        assert each.headers["Access-Control-Allow-Origin"] == "*"
        assert "ETag" in each.headers["Access-Control-Expose-Headers"]
    asked = {"Access-Control-Request-Method": "GET", "Access-Control-Request-Headers": "if-none-match"}
    assert client.options(url, headers=ELSEWHERE | asked).headers["Access-Control-Allow-Origin"] == "*"


def test_the_rest_they_neither_read_nor_post_by_default(client: TestClient) -> None:
    for url in PRIVATE:
        assert "Access-Control-Allow-Origin" not in client.get(url, headers=ELSEWHERE).headers, url
    for url in ("/api/scenes", "/api/plans", "/api/frames"):
        asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "content-type"}
        preflight = client.options(url, headers=ELSEWHERE | asked)
        assert "Access-Control-Allow-Origin" not in preflight.headers
        assert preflight.status_code == 405


def test_other_origins_are_let_in_by_setting_alone_and_a_preflight_needs_no_key() -> None:
    origin = {"Origin": "https://example.org"}
    client = answering(cors_origins="https://example.org, https://a.test:8443", api_keys="a:correct-horse-battery")
    # An error too, so that the page can read it.
    response = client.get("/api/quality", headers=origin)
    assert response.status_code == 401
    assert response.headers["Access-Control-Allow-Origin"] == "https://example.org"
    readable = response.headers["Access-Control-Expose-Headers"]
    assert {"ETag", "Seafoam-Plan", "Retry-After", "RateLimit"} <= set(readable.split(", "))
    # With keys nothing is public.
    other = client.get("/api/quality", headers={"Origin": "https://example.com"})
    assert "Access-Control-Allow-Origin" not in other.headers
    asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "authorization,content-type"}
    assert client.options("/api/frames", headers=asked | origin).status_code == 200
    change = asked | origin | {"Access-Control-Request-Method": "PUT"}
    assert client.options("/api/streams/x", headers=change).status_code == 200
    assert client.options("/api/frames", headers=asked | {"Origin": "https://example.com"}).status_code == 400


def test_an_error_has_the_headers_of_a_success(monkeypatch: pytest.MonkeyPatch) -> None:
    client = answering(cors_origins=ELSEWHERE["Origin"], rate=1000.0)
    client.app.state.context.streams.limit = 0
    good = client.get("/api/streams", headers=ELSEWHERE)
    full = client.post("/api/streams", json={"scene": {}}, headers=ELSEWHERE)
    monkeypatch.setattr("seafoam.api.routers.streams._state", lambda context: 1 / 0)
    unexpected = client.get("/api/streams", headers=ELSEWHERE)
    bodiless = client.head("/api/streams", headers=ELSEWHERE)
    assert [each.status_code for each in (good, full, unexpected, bodiless)] == [200, 503, 500, 500]
    assert unexpected.headers["Content-Type"] == "application/problem+json"
    assert bodiless.content == b""
    for name in ("Access-Control-Allow-Origin", "Access-Control-Expose-Headers", "X-Content-Type-Options", "Vary"):
        assert {each.headers[name] for each in (full, unexpected, bodiless)} == {good.headers[name]}
    assert all("RateLimit" in each.headers and "X-Request-ID" in each.headers for each in (good, unexpected))


PLAN = "/api/plans/default"
CODINGS = [
    ("gzip", "gzip"), ("GZip", "gzip"), ("x-gzip", "gzip"), ("gzip;q=1.000", "gzip"), ("gzip ; Q=0.5", "gzip"),
    ("deflate, gzip;q=0.1", "gzip"), ("identity;q=0, gzip", "gzip"), ("gzip;q=0.5, identity;q=0.5", "gzip"),
    ("gzip, br;q=0.9", "gzip"), ("br;q=0, *", "gzip"), ("br", "br"), ("BR", "br"), ("br;q=0.001", "br"),
    ("gzip, br", "br"), ("br;q=0.5, gzip;q=0.5", "br"), ("gzip;q=0, br", "br"), ("gzip;q=0, *", "br"), ("*", "br"),
    ("*;q=0.5", "br"), ("zstd, *;q=0.1", "br"), ("identity;q=0, *;q=0.1", "br"), ("gzip;q=0.2, *;q=0.4", "br"),
    ("", None), ("gzip;q=0", None), ("gzip;q=0.000, deflate", None), ("*;q=0", None), ("x-gzip;q=0", None),
    ("gzipped", None), ("ungzip, deflate", None), ("identity", None), ("br;q=0", None), ("brotli", None),
    ("gzip;q=0.5, identity", None), ("br;q=0.1, identity", None), ("gzip;q=2", None), ("gzip;q=none", None),
    ("identity;q=0", None), ("gzip, identity;q=0, gzip;q=0", None),
]  # fmt: skip


def test_the_best_of_what_a_client_accepts_is_chosen() -> None:
    """Sent on one line, or on one for each coding."""
    for sent, coding in CODINGS:
        for lines in ([sent], sent.split(",")):
            assert next(iter(accepted(lines)), None) == coding, sent


@pytest.mark.parametrize("url", [PLAN, "/api/presets", "/api/textures/mask/vac-24/atlas", "/"])
def test_an_answer_has_the_coding_that_is_asked_for(client: TestClient, url: str) -> None:
    for lines, coding in ((["gzip"], "gzip"), (["identity;q=0", "*;q=0.1"], "gzip"), (["gzip;q=0", "deflate"], None)):
        response = client.get(url, headers=[("Accept-Encoding", line) for line in lines])
        assert (response.status_code, response.headers.get("Content-Encoding")) == (200, coding)
        assert "Accept-Encoding" in response.headers["Vary"]


def test_what_packs_well_is_packed(client: TestClient) -> None:
    # Ranks are as good as random: there is nothing to gain.
    shares = {PLAN: 1 / 3, "/api/textures/mask/vac-24/atlas": 0.4, "/api/textures/mask/vac-24/ranks": None}
    for url, share in shares.items():
        plain, packed = (client.get(url, headers={"Accept-Encoding": coding}) for coding in ("identity", "gzip"))
        assert packed.content == plain.content
        assert ("Content-Encoding" in packed.headers) is (share is not None)
        assert int(packed.headers["Content-Length"]) <= (share or 1.0) * len(plain.content)


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> TestClient:
    """A client of a built page, of which one file was packed."""
    monkeypatch.setattr("seafoam.api.site.data_dir", lambda kind: tmp_path)
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<title>sea</title>" * 100)
    (tmp_path / "assets" / "a.js").write_text("export {}" * 100)
    (tmp_path / "assets" / "a.js.br").write_bytes(b"packed")
    return answering()


@pytest.mark.parametrize(("sent", "coding"), [("gzip, br", "br"), ("gzip, br;q=0.9", "gzip"), ("br;q=0", None)])
def test_packed_files_are_for_who_prefers_them(built: TestClient, sent: str, coding: str | None) -> None:
    with built.stream("GET", "/assets/a.js", headers={"Accept-Encoding": sent}) as response:
        assert response.headers.get("Content-Encoding") == coding
        assert response.headers["Vary"] == "Accept-Encoding"
        assert response.headers["Content-Type"].startswith("text/javascript")
        assert "immutable" in response.headers["Cache-Control"]
        tag = response.headers["ETag"]
    again = built.get("/assets/a.js", headers={"Accept-Encoding": sent, "If-None-Match": f'"x", {tag}'})
    assert (again.status_code, again.headers["ETag"], again.headers["Vary"]) == (304, tag, "Accept-Encoding")


@pytest.mark.parametrize("coding", ["gzip", "identity"])
@pytest.mark.parametrize(
    "url", [PLAN, "/api/textures/mask/vac-24/atlas", "/api/masks/vac-6/data.png", "/api/masks/mix/spectrum", "/"]
)
def test_a_copy_is_known_by_its_tag(built: TestClient, client: TestClient, url: str, coding: str) -> None:
    asked = built if url == "/" else client
    sent = {"Accept-Encoding": coding}
    first = asked.get(url, headers=sent)
    tag = first.headers["ETag"]
    strong = tag.removeprefix("W/")
    assert tag.startswith("W/") is ("Content-Encoding" in first.headers)
    for lines in ([tag], ['"x"', tag], [tag, '"x"'], [f'"x",{strong}', '"y"'], [f"W/{strong}"]):
        again = asked.get(url, headers=[*sent.items(), *(("If-None-Match", line) for line in lines)])
        assert (again.status_code, again.content) == (304, b"")
        assert again.headers["ETag"].removeprefix("W/") == strong
        assert set(first.headers.get("Vary", "").split(", ")) - {""} <= set(again.headers["Vary"].split(", "))
        assert again.headers["Cache-Control"] == first.headers["Cache-Control"]
    for lines in (['"x"'], ['"x"', 'W/"y"'], [strong.strip('"')], [f'"{strong[1:-2]}"']):
        other = asked.get(url, headers=[*sent.items(), *(("If-None-Match", line) for line in lines)])
        assert other.status_code == 200


@pytest.mark.parametrize("url", [*PUBLIC, "/", "/docs", "/openapi.json", "/water/", "/water/default", "/api/"])
def test_any_copy_of_what_is_there_is_current(client: TestClient, url: str) -> None:
    for method in ("GET", "HEAD"):
        response = client.request(method, url, headers={"If-None-Match": "*"})
        assert (response.status_code, response.content) == (304, b"")
    assert client.get("/api/presets/none", headers={"If-None-Match": "*"}).status_code == 404
    assert client.post("/api/scenes", json={}, headers={"If-None-Match": "*"}).status_code == 200


def test_a_tag_goes_before_a_date(built: TestClient) -> None:
    first = built.get("/")
    date = {"If-Modified-Since": first.headers["Last-Modified"]}
    assert built.get("/", headers=date).status_code == 304
    assert built.get("/", headers=date | {"If-None-Match": '"x"'}).status_code == 200
    for old in ("Sat, 01 Jan 2000 00:00:00 GMT", "yesterday"):
        assert built.get("/", headers={"If-Modified-Since": old}).status_code == 200
    known = {"If-Modified-Since": old, "If-None-Match": first.headers["ETag"]}
    assert built.get("/", headers=known).status_code == 304


SURROGATES = [
    ('{"\\ud800": 1}', r"/\ud800"), ('{"foam": {"a\\udfff/b": 1}}', r"/foam/a\udfff~1b"), ('"\\udc00"', ""),
    ('{"foam": {"mask": "\\ud800"}}', "/foam/mask"), ('{"waves": [{}, {"model": "x\\ud83dy"}]}', "/waves/1/model"),
    ('{"extensions": {"a": [["\\ud800"]]}}', "/extensions/a/0/0"), (b'{"foam": "\xed\xa0\x80"}', "/foam"),
]  # fmt: skip
UNREADABLE = [
    (b'{"foam": "\xff"}', "byte 10"), (b'{"\xc3(": 1}', "byte 2"), ("[" * 100_000, "levels"),
    ("[" * 900 + "]" * 900, "invalid JSON"), ('{"a":' * 900 + "1" + "}" * 900, "invalid JSON"),
    ('{"a": ' + "9" * 5000 + "}", "digits"), ("{,}", "character 1"),
]  # fmt: skip


def posted(client: TestClient, content: str | bytes, path: str = "/api/scenes") -> dict[str, object]:
    """The one error of a body that is refused."""
    response = client.post(path, content=content, headers={"Content-Type": "application/json"})
    (error,) = problem(response, 422)["errors"]
    return error


@pytest.mark.parametrize(("body", "pointer"), SURROGATES)
def test_half_a_surrogate_pair_is_refused_with_its_place(client: TestClient, body: str | bytes, pointer: str) -> None:
    error = posted(client, body)
    assert error["pointer"] == pointer
    assert "surrogate" in str(error["detail"])


def test_every_body_must_be_text_and_one_that_cannot_be_read_is_told_why(client: TestClient) -> None:
    for path in ("plans", "frames", "export", "sequences", "streams"):
        assert posted(client, '{"scene": {}, "preset": "\\ud800"}', f"/api/{path}")["pointer"] == "/preset"
    assert posted(client, '{"\\ud83c\\udf0a": 1}')["pointer"] == "/🌊", "a whole pair is text"
    for body, said in UNREADABLE:
        assert said in str(posted(client, body)["detail"])


@pytest.mark.parametrize("path", ["/{}", "/assets/{}.js", "/water/{}", "/water/{}.jpg", "/api/textures/mask/{}/ranks"])
def test_a_name_of_any_bytes_is_not_found(client: TestClient, path: str) -> None:
    for name in ("%00", "%ff", "%ed%a0%80", "%0d%0a", "a" * 5000, "..%5c", "%f0%9f%8c%8a"):
        assert client.get(path.format(name)).status_code == 404, name


@pytest.mark.parametrize("text", ["1_0", "１２", "٣", "%205", "5%20", "1e3_0", "0x10", "1,5", "1e", ".", "--1", "5%00"])
@pytest.mark.parametrize(
    ("url", "parameter"),
    [
        ("/api/frames/default.png?time={}", "time"), ("/api/frames/default.png?width={}", "width"),
        ("/api/frames/default.png?quality=auto&budget_ms={}", "budget_ms"), ("/api/frames/default.png?fov={}", "fov"),
        ("/api/masks/custom?family=vac&size={}", "size"), ("/api/masks/custom?family=vac&sigma={}", "sigma"),
        ("/api/presets/default/thumbnail.png?width={}", "width"),
        (f"/api/plans/{'0' * 64}/frames/{{}}.png?width=8&height=8&x=0&y=1&z=0&yaw=0&pitch=0&roll=0&fov=1", "time"),
    ],
)  # fmt: skip
def test_a_number_is_written_in_one_way(client: TestClient, url: str, parameter: str, text: str) -> None:
    (error,) = problem(client.get(url.format(text)), 422)["errors"]
    assert error["parameter"] == parameter


def test_usual_ways_of_writing_a_number_are_taken(client: TestClient) -> None:
    tags = {
        client.get("/api/frames/default.png", params=SMALL | {"time": text}).headers["ETag"]
        for text in ("10", "10.0", "1e1", "1E+1", "+10", "10.", "010", "100e-1")
    }
    assert len(tags) == 1


def test_a_malformed_range_is_ignored_and_one_outside_of_a_file_a_problem(built: TestClient) -> None:
    for sent in ("lines=0-1", "bytes=5-1", "bytes=", "bytes=-", "bytes=a-b", "bytes=1_0-", "bytes"):
        whole = built.get("/assets/a.js", headers={"Range": sent, "Accept-Encoding": "identity"})
        assert whole.status_code == 200, sent
    assert built.get("/assets/a.js", headers={"Range": "bytes=0-5", "Accept-Encoding": ""}).text == "export"
    last = len(whole.content) - 1
    asked = {"Range": f"bytes={last + 1}-", "Accept-Encoding": "identity"}
    response = built.get("/assets/a.js", headers=asked)
    (error,) = problem(response, 416)["errors"]
    assert response.headers["Content-Range"] == f"bytes */{last + 1}"
    assert (error["allowed"], f"0 to {last}" in error["detail"]) == ({"minimum": 0, "maximum": last}, True)
    bodiless = built.head("/assets/a.js", headers=asked)
    assert (bodiless.status_code, bodiless.content) == (416, b"")
