"""What HTTP itself asks for: other origins, codings, conditional requests."""

import pytest
from starlette.testclient import TestClient

from support.api_fakes import RAISE
from support.serving import SMALL, answering

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


@pytest.mark.parametrize("url", PRIVATE)
def test_the_rest_they_read_by_setting_alone(client: TestClient, url: str) -> None:
    assert "Access-Control-Allow-Origin" not in client.get(url, headers=ELSEWHERE).headers


def test_they_post_nothing_by_default(client: TestClient) -> None:
    for url in ("/api/scenes", "/api/plans", "/api/frames"):
        asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "content-type"}
        preflight = client.options(url, headers=ELSEWHERE | asked)
        assert "Access-Control-Allow-Origin" not in preflight.headers
        assert preflight.status_code == 405


def test_nothing_of_a_server_with_keys_is_public() -> None:
    restricted = answering(api_keys="a:correct-horse-battery")
    assert "Access-Control-Allow-Origin" not in restricted.get("/api/quality", headers=ELSEWHERE).headers


def test_an_error_has_the_headers_of_a_success(serve, monkeypatch: pytest.MonkeyPatch) -> None:
    with serve(cors_origins=ELSEWHERE["Origin"], streams=0, rate=1000.0) as client:
        good = client.get("/api/streams", headers=ELSEWHERE)
        full = client.post("/api/streams", json={"scene": {}}, headers=ELSEWHERE)
        drawn = client.get("/api/frames/default.png", params=SMALL | {"time": RAISE}, headers=ELSEWHERE)
        monkeypatch.setattr("seafoam.api.routers.streams._state", lambda context: 1 / 0)
        unexpected = client.get("/api/streams", headers=ELSEWHERE)
        bodiless = client.head("/api/streams", headers=ELSEWHERE)
    assert [each.status_code for each in (good, full, drawn, unexpected, bodiless)] == [200, 503, 500, 500, 500]
    assert unexpected.headers["Content-Type"] == "application/problem+json"
    assert bodiless.content == b""
    for name in ("Access-Control-Allow-Origin", "Access-Control-Expose-Headers", "X-Content-Type-Options", "Vary"):
        assert {each.headers[name] for each in (full, drawn, unexpected, bodiless)} == {good.headers[name]}
    assert all("RateLimit" in each.headers and "X-Request-ID" in each.headers for each in (good, unexpected))
