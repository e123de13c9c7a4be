"""API keys and signed links: what they protect, what they let in, and what is refused."""

import base64

import pytest
from starlette.testclient import TestClient

from seafoam.api.guard.keys import Access, Signing, api_keys_of
from seafoam.api.settings import Settings
from support.command import run
from support.serving import answering, problem

KEY = "correct-horse-battery"
OTHER = "staple-correct-horse"
# The key, salt and path of imgproxy's own example, https://docs.imgproxy.net/usage/signing_url.
IMGPROXY = Signing(b"secret", b"hello")
SIGNING = {"signing_key": "7365637265747365637265747365637265", "signing_salt": "68656c6c6f"}
MASK = "/api/masks/custom/data.png?family=blur&sigma=4&size=32&seed=7"


@pytest.fixture(scope="module")
def restricted() -> TestClient:
    """Asks for a key or a signature."""
    return answering(api_keys=f"alice:{KEY},bob:{OTHER}", **SIGNING)


@pytest.fixture(scope="module")
def signing() -> Signing:
    return Signing.of(SIGNING["signing_key"], SIGNING["signing_salt"])


def basic(key: str) -> str:
    return "Basic " + base64.b64encode(f"anyone:{key}".encode()).decode()


def bearer(key: str) -> str:
    return f"Bearer {key}"


def test_signatures_are_imgproxys() -> None:
    path = b"/rs:fill:300:400:0/g:sm/aHR0cDovL2V4YW1w/bGUuY29tL2ltYWdl/cy9jdXJpb3NpdHku/anBn.png"
    assert IMGPROXY.signature(path) == "oKfUtW34Dvo2BGQehJFR4Nr0_rIjOtdtzJ3QFsUcXH8"


def test_the_api_asks_for_a_key_and_pages_and_health_checks_do_not(restricted: TestClient) -> None:
    for url in ("/", "/docs", "/openapi.json", "/icon.svg", "/healthz", "/water/default"):
        assert restricted.get(url).status_code == 200, url
    for url in ("/api/quality", MASK, "/api/nothing", "/api/schema"):
        response = restricted.get(url)
        told = problem(response, 401)
        assert {each.split()[0] for each in response.headers["WWW-Authenticate"].split(", ")} >= {"Basic", "Bearer"}
        assert told["type"] == "urn:seafoam:problem:unauthorized"
        assert "Bearer" in told["detail"]


def test_a_key_opens_the_api_and_another_does_not(restricted: TestClient) -> None:
    keys = [bearer(KEY), bearer(OTHER), basic(KEY), f"bearer {KEY}"]
    others = [
        "", "Bearer", "Bearer ", f"Bearer {KEY}x", f"Bearer {KEY[:-1]}", f"Digest {KEY}", KEY, "Bearer alice",
        "Basic !!!", "Basic /w==", f"Basic {base64.b64encode(KEY.encode()).decode()}",
    ]  # fmt: skip
    for url in ("/api/quality", MASK):
        found = {sent: restricted.get(url, headers={"Authorization": sent}).status_code for sent in keys + others}
        assert found == dict.fromkeys(keys, 200) | dict.fromkeys(others, 401)


def test_an_answer_to_a_key_is_given_behind_the_gate_and_not_for_shared_caches(
    restricted: TestClient, signing: Signing
) -> None:
    assert restricted.get(MASK, headers={"Authorization": bearer(KEY)}).headers["Cache-Control"].startswith("private")
    # From memory too.
    assert restricted.get(MASK, headers={"Authorization": bearer(KEY)}).headers["Cache-Control"].startswith("private")
    assert restricted.get(MASK).status_code == 401
    assert restricted.get(signing.link(MASK)).headers["Cache-Control"].startswith("public")
    names = [each.cls.__name__ for each in answering().app.user_middleware]
    assert names.index("AccessControl") < names.index("AnswerFromMemory")


def test_a_signed_link_is_its_own_permission_to_read(restricted: TestClient, signing: Signing) -> None:
    link = signing.link(MASK)
    response = restricted.get(link)
    assert response.status_code == 200
    assert response.headers["Content-Type"] == "image/png"
    assert restricted.head(link).status_code == 200
    assert restricted.get(link, headers={"If-None-Match": response.headers["ETag"]}).status_code == 304
    assert restricted.get(signing.link(MASK.replace("custom", "c%75stom"))).content == response.content
    response = restricted.post(signing.link("/api/frames"), json={})
    assert response.status_code == 405
    assert response.headers["Allow"] == "GET, HEAD"


def test_an_altered_link_is_refused(restricted: TestClient, signing: Signing) -> None:
    link = signing.link(MASK)
    signature = link.split("/")[2]
    altered = [
        link.replace("seed=7", "seed=8"),
        link.replace("data.png", "data.npy"),
        link + "&seed=7",
        link.split("?")[0],
        link.replace("masks", "m%61sks"),
        link.replace(signature, signature[:-1]),
        link.replace(signature, "x" * len(signature)),
        link.replace(signature, "é"),
        f"/signed/{signature}",
        "/signed/",
        f"/signed/{signature}/docs",
        "/signed" + MASK,
    ]
    for each in altered:
        assert problem(restricted.get(each), 403)["type"] == "urn:seafoam:problem:bad-signature", each


def test_with_signing_alone_every_other_request_is_refused_and_without_settings_none(signing: Signing) -> None:
    client = answering(**SIGNING)
    assert client.get("/api/quality", headers={"Authorization": bearer(KEY)}).status_code == 401
    assert client.get(signing.link("/api/quality")).status_code == 200
    client = answering()
    assert client.get(MASK, headers={"Authorization": bearer(KEY)}).headers["Cache-Control"].startswith("public")
    assert client.get(signing.link("/api/quality")).status_code == 404


@pytest.mark.parametrize(
    "text", [KEY, f"alice:{KEY[:15]}", f"alice:{KEY},alice:{OTHER}", f"a:{KEY},b:{KEY}", f"a b:{KEY}", f"a:{KEY} {KEY}"]
)
def test_keys_must_have_names_and_length(text: str) -> None:
    with pytest.raises(ValueError, match=r"key \d") as refused:
        api_keys_of(text)
    assert KEY[:15] not in str(refused.value)


def test_secrets_are_not_shown() -> None:
    settings = Settings(api_keys=f"alice:{KEY}", **SIGNING)
    assert KEY not in repr(settings)
    assert SIGNING["signing_key"] not in repr(settings)
    assert isinstance(settings.access, Access)


def test_the_command_signs_what_the_server_accepts(restricted: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in SIGNING.items():
        monkeypatch.setenv(f"SEAFOAM_{name.upper()}", value)
    done = run("sign", MASK)
    assert done.returncode == 0, done.stderr
    link = done.stdout.strip()
    assert restricted.get(link).status_code == 200
    # A proxy strips the path below which it serves the server.
    monkeypatch.setenv("SEAFOAM_ROOT_PATH", "/water/")
    assert run("sign", MASK).stdout.strip() == f"/water{link}"
