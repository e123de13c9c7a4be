"""What HTTP itself asks for: other origins, codings, conditional requests, parts of files."""

from pathlib import Path

import pytest
from starlette.testclient import TestClient

from support.serving import answering, problem

ELSEWHERE = {"Origin": "https://elsewhere.test"}
PUBLIC = (
    "/api/presets", "/api/presets/default", "/api/quality", "/api/schema", "/api/plans/default", "/api/masks",
    "/api/masks/vac-6", "/api/masks/custom/data.npy?family=vac&size=32", "/api/textures/mask/vac-6/ranks",
)  # fmt: skip
PRIVATE = (
    "/", "/docs", "/metrics", "/healthz", "/api/frames/default.png", "/api/presets/default/thumbnail.png?width=16",
    "/api/plans/0/frames/0.png", "/api/streams", "/api/sequences/0", "/api/accuracy/default/points",
)  # fmt: skip


def test_pages_of_every_site_read_public_data(client: TestClient) -> None:
    for url in PUBLIC:
        response = client.get(url, headers=ELSEWHERE)
        tag = response.headers.get("ETag", '"none"')
        wrong = client.get(f"{url.partition('?')[0]}?wrong=1", headers=ELSEWHERE)
        same = client.get(url, headers=ELSEWHERE | {"If-None-Match": tag})
        assert (response.status_code, wrong.status_code) == (200, 422), url
        for each in (response, wrong, same, client.head(url, headers=ELSEWHERE)):
            assert each.headers["Access-Control-Allow-Origin"] == "*", url
            assert "ETag" in each.headers["Access-Control-Expose-Headers"]


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
    # With keys nothing is public.
    other = client.get("/api/quality", headers={"Origin": "https://example.com"})
    assert "Access-Control-Allow-Origin" not in other.headers
    asked = {"Access-Control-Request-Method": "PUT", "Access-Control-Request-Headers": "authorization,content-type"}
    assert client.options("/api/streams/x", headers=asked | origin).status_code == 200
    assert client.options("/api/streams/x", headers=asked | {"Origin": "https://example.com"}).status_code == 400


def test_an_error_has_the_headers_of_a_success(monkeypatch: pytest.MonkeyPatch) -> None:
    client = answering(cors_origins=ELSEWHERE["Origin"], rate=1000.0)
    client.app.state.context.streams.limit = 0
    good = client.get("/api/streams", headers=ELSEWHERE)
    full = client.post("/api/streams", json={"scene": {}}, headers=ELSEWHERE)
    monkeypatch.setattr("seafoam.api.routers.streams.StreamState", lambda **_: 1 / 0)
    unexpected = client.get("/api/streams", headers=ELSEWHERE)
    bodiless = client.head("/api/streams", headers=ELSEWHERE)
    assert [each.status_code for each in (good, full, unexpected, bodiless)] == [200, 503, 500, 500]
    assert unexpected.headers["Content-Type"] == "application/problem+json"
    assert bodiless.content == b""
    for name in ("Access-Control-Allow-Origin", "Access-Control-Expose-Headers", "X-Content-Type-Options", "Vary"):
        assert {each.headers[name] for each in (full, unexpected, bodiless)} == {good.headers[name]}
    assert all("X-Request-ID" in each.headers for each in (good, unexpected))


PLAN, ATLAS = "/api/plans/default", "/api/textures/mask/vac-24/atlas"


def test_what_packs_well_is_packed_for_who_accepts_it(client: TestClient) -> None:
    # Ranks are as good as random: there is nothing to gain.
    shares = {PLAN: 1 / 3, "/api/presets": 1.0, "/": 1.0, ATLAS: 0.4, "/api/textures/mask/vac-24/ranks": None}
    for url, share in shares.items():
        plain, packed = (client.get(url, headers={"Accept-Encoding": coding}) for coding in ("identity", "gzip, br"))
        assert packed.content == plain.content
        assert (packed.headers.get("Content-Encoding") == "gzip") is (share is not None), url
        assert "Accept-Encoding" in packed.headers["Vary"]
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


@pytest.mark.parametrize(("sent", "coding"), [("gzip, deflate, br, zstd", "br"), ("gzip", "gzip"), ("identity", None)])
def test_packed_files_are_for_who_accepts_them(built: TestClient, sent: str, coding: str | None) -> None:
    with built.stream("GET", "/assets/a.js", headers={"Accept-Encoding": sent}) as response:
        assert response.headers.get("Content-Encoding") == coding
        assert "Accept-Encoding" in response.headers["Vary"]
        assert response.headers["Content-Type"].startswith("text/javascript")
        assert "immutable" in response.headers["Cache-Control"]


@pytest.mark.parametrize("coding", ["gzip", "identity"])
@pytest.mark.parametrize("url", [PLAN, ATLAS, "/api/masks/mix/spectrum", "/"])
def test_a_copy_is_known_by_its_tag(built: TestClient, client: TestClient, url: str, coding: str) -> None:
    asked = built if url == "/" else client
    sent = {"Accept-Encoding": coding}
    first = asked.get(url, headers=sent)
    tag = first.headers["ETag"]
    for known in (tag, f'"x", {tag}', f"W/{tag}"):
        again = asked.get(url, headers=sent | {"If-None-Match": known})
        assert (again.status_code, again.content) == (304, b""), known
        assert again.headers["ETag"] == tag
        assert again.headers["Cache-Control"] == first.headers["Cache-Control"]
    for known in ('"x", W/"y"', f'"{tag[1:-2]}"'):
        assert asked.get(url, headers=sent | {"If-None-Match": known}).status_code == 200, known


def test_a_part_of_a_file_is_sent_and_of_one_that_it_does_not_hold_the_size(built: TestClient) -> None:
    def part(asked: str):
        return built.get("/assets/a.js", headers={"Range": asked, "Accept-Encoding": "identity"})

    assert part("bytes=0-5").text == "export"
    response = part("bytes=900-")
    assert (response.status_code, response.headers["Content-Range"]) == (416, "bytes */900")


def test_a_body_that_cannot_be_read_is_refused(client: TestClient) -> None:
    for body in (
        '{"\\ud800": 1}', '{"foam": {"mask": "\\ud800"}}', b'{"foam": "\xff"}', "[" * 100_000, "{,}",
        '{"a":' * 900 + "1" + "}" * 900, '{"a": ' + "9" * 5000 + "}",
    ):  # fmt: skip
        response = client.post("/api/scenes", content=body, headers={"Content-Type": "application/json"})
        assert "JSON" in problem(response, 422)["errors"][0]["detail"], body[:20]


@pytest.mark.parametrize("path", ["/{}", "/assets/{}.js", "/water/{}", "/water/{}.jpg", "/api/textures/mask/{}/ranks"])
def test_a_name_of_any_bytes_is_not_found(client: TestClient, path: str) -> None:
    for name in ("%00", "%ff", "%ed%a0%80", "%0d%0a", "a" * 5000, "..%5c", "%f0%9f%8c%8a"):
        assert client.get(path.format(name)).status_code == 404, name


@pytest.mark.parametrize("text", ["1_0", "１２", "%205", "1,5"])
@pytest.mark.parametrize(
    ("url", "parameter"),
    [
        ("/api/frames/default.png?time={}", "time"), ("/api/masks/custom?family=vac&size={}", "size"),
        (f"/api/plans/{'0' * 64}/frames/{{}}.png?width=8&height=8&x=0&y=1&z=0&yaw=0&pitch=0&roll=0&fov=1", "time"),
    ],
)  # fmt: skip
def test_a_number_is_written_in_one_way(client: TestClient, url: str, parameter: str, text: str) -> None:
    (error,) = problem(client.get(url.format(text)), 422)["errors"]
    assert error["parameter"] == parameter
