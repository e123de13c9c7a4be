"""Who may ask and how often: API keys and signed links, rates by client, headers that tell a browser what it may do."""

import base64
import re

import pytest
from starlette.testclient import TestClient

from seafoam.api.guard.access_control import TokenBuckets, bucket_of
from seafoam.api.guard.keys import Signing, api_keys_of
from seafoam.api.settings import Settings
from support.command import run
from support.serving import Clock, answering, problem

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


BEARER = {"Authorization": f"Bearer {KEY}"}


def test_signatures_are_imgproxys() -> None:
    path = b"/rs:fill:300:400:0/g:sm/aHR0cDovL2V4YW1w/bGUuY29tL2ltYWdl/cy9jdXJpb3NpdHku/anBn.png"
    assert IMGPROXY.signature(path) == "oKfUtW34Dvo2BGQehJFR4Nr0_rIjOtdtzJ3QFsUcXH8"


def test_the_api_asks_for_a_key_and_pages_and_health_checks_do_not(restricted: TestClient) -> None:
    for url in ("/", "/docs", "/openapi.json", "/icon.svg", "/healthz", "/water/default"):
        assert restricted.get(url).status_code == 200, url
    for url in ("/api/quality", MASK, "/api/nothing", "/api/schema"):
        response = restricted.get(url)
        assert problem(response, 401)["type"] == "urn:seafoam:problem:unauthorized"
        assert {each.split()[0] for each in response.headers["WWW-Authenticate"].split(", ")} >= {"Basic", "Bearer"}


def test_a_key_opens_the_api_and_another_does_not(restricted: TestClient) -> None:
    basic = "Basic " + base64.b64encode(f"anyone:{KEY}".encode()).decode()
    keys = [f"Bearer {KEY}", f"Bearer {OTHER}", basic, f"bearer {KEY}"]
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
    for _ in range(2):  # from memory too
        assert restricted.get(MASK, headers=BEARER).headers["Cache-Control"].startswith("private")
    assert restricted.get(MASK).status_code == 401
    assert restricted.get(signing.link(MASK)).headers["Cache-Control"].startswith("public")
    names = [each.cls.__name__ for each in answering().app.user_middleware]
    assert names.index("AccessControl") < names.index("AnswerFromMemory")


def test_a_signed_link_is_its_own_permission_to_read(restricted: TestClient, signing: Signing) -> None:
    link = signing.link(MASK)
    response = restricted.get(link)
    assert (response.status_code, response.headers["Content-Type"]) == (200, "image/png")
    assert restricted.head(link).status_code == 200
    assert restricted.get(link, headers={"If-None-Match": response.headers["ETag"]}).status_code == 304
    assert restricted.get(signing.link(MASK.replace("custom", "c%75stom"))).content == response.content
    response = restricted.post(signing.link("/api/frames"), json={})
    assert (response.status_code, response.headers["Allow"]) == (405, "GET, HEAD")


def test_an_altered_link_is_refused(restricted: TestClient, signing: Signing) -> None:
    link = signing.link(MASK)
    signature = link.split("/")[2]
    spelt = ("seed=7", "seed=8"), ("data.png", "data.npy"), ("masks", "m%61sks"), (link[link.index("?") :], "")
    altered = [link.replace(*change) for change in spelt] + [f"{link}&seed=7"]
    altered += [link.replace(signature, other) for other in (signature[:-1], "x" * len(signature), "é")]
    altered += [f"/signed/{signature}", "/signed/", f"/signed/{signature}/docs", f"/signed{MASK}"]
    for each in altered:
        assert problem(restricted.get(each), 403)["type"] == "urn:seafoam:problem:bad-signature", each


def test_with_signing_alone_every_other_request_is_refused_and_without_settings_none(signing: Signing) -> None:
    client = answering(**SIGNING)
    assert client.get("/api/quality", headers=BEARER).status_code == 401
    assert client.get(signing.link("/api/quality")).status_code == 200
    client = answering()
    assert client.get(MASK, headers=BEARER).headers["Cache-Control"].startswith("public")
    assert client.get(signing.link("/api/quality")).status_code == 404


@pytest.mark.parametrize(
    "text", [KEY, f"alice:{KEY[:15]}", f"alice:{KEY},alice:{OTHER}", f"a:{KEY},b:{KEY}", f"a b:{KEY}", f"a:{KEY} {KEY}"]
)
def test_keys_must_have_names_and_length(text: str) -> None:
    with pytest.raises(ValueError, match=r"key \d") as refused:
        api_keys_of(text)
    assert KEY[:15] not in str(refused.value)


def test_secrets_are_not_shown() -> None:
    shown = repr(Settings(api_keys=f"alice:{KEY}", **SIGNING))
    assert [secret for secret in (KEY, *SIGNING.values()) if secret in shown] == []


def test_the_command_signs_what_the_server_accepts(restricted: TestClient) -> None:
    """Below the path that a proxy strips; at the root: test_documented.py."""
    done = run(
        "sign", MASK, SEAFOAM_ROOT_PATH="/water/", **{f"SEAFOAM_{name.upper()}": SIGNING[name] for name in SIGNING}
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("/water/signed/")
    assert restricted.get(done.stdout.strip().removeprefix("/water")).status_code == 200


URL = "/api/quality"


def of(client: TestClient, address: str) -> TestClient:
    """The same app, asked from another address."""
    return TestClient(client.app, client=(address, 50000))


def test_a_bucket_holds_its_burst_and_refills_as_a_refused_client_is_told() -> None:
    clock = Clock()
    buckets = TokenBuckets(2.0, 5, clock)
    assert [buckets.take("a") for _ in range(6)] == [0, 0, 0, 0, 0, 1]
    for seconds, allowed in ((0.49, False), (0.01, True)):
        clock.now += seconds
        assert (buckets.take("a") == 0) is allowed
    buckets = TokenBuckets(0.3, 2, clock)
    for _ in range(2):
        buckets.take("a")
    clock.now += buckets.take("a")
    assert buckets.take("a") == 0


def test_the_memory_is_bounded_and_the_busy_are_remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seafoam.api.guard.access_control.CLIENTS_KEPT", 100)
    buckets = TokenBuckets(1.0, 2, Clock())
    for number in range(1000):
        buckets.take(f"client {number}")
        buckets.take("busy")
    assert len(buckets._full_at._held) == 100
    assert buckets.take("busy") > 0


def test_an_ipv6_network_is_one_client() -> None:
    same = {("2001:db8::1", "2001:db8::ffff:1"), ("::ffff:10.0.0.1", "10.0.0.1")}
    others = {("10.0.0.1", "10.0.0.2"), ("2001:db8:0:1::1", "2001:db8:0:2::1"), ("testclient", "")}
    assert {pair for pair in same | others if bucket_of(pair[0]) == bucket_of(pair[1])} == same


def test_beyond_its_rate_a_client_is_told_when_to_come_back() -> None:
    client = answering(rate=0.01, rate_burst=2)
    first, _, refused = (client.get(URL) for _ in range(3))
    assert first.status_code == 200
    assert "2 requests at once and 0.01 a second" in problem(refused, 429)["detail"]
    # A busy machine may take some seconds between the requests.
    assert 80 <= int(refused.headers["Retry-After"]) <= 100


def test_each_client_has_a_rate_of_its_own() -> None:
    client = answering(rate=0.001, rate_burst=1, api_keys=f"alice:{KEY}")
    # A key is one client at every address.
    for address, status in (("10.0.0.1", 200), ("10.0.0.2", 429)):
        assert of(client, address).get(URL, headers=BEARER).status_code == status
    # Guesses at keys are counted too.
    assert [of(client, "10.0.0.3").get(URL).status_code for _ in range(2)] == [401, 429]
    assert of(client, "10.0.0.4").get(URL).status_code == 401


def test_only_a_trusted_proxy_says_who_the_client_is() -> None:
    client = answering(rate=0.001, rate_burst=1, trusted_proxies="10.0.0.0/8, ::1")

    for peer, forwarded, status in (
        ("10.1.2.3", "203.0.113.1", 200),
        ("10.1.2.3", "203.0.113.2", 200),
        ("10.1.2.3", "203.0.113.1", 429),
        # The last that the proxy did not trust counts, whatever a client puts before it.
        ("10.1.2.3", "198.51.100.7, 203.0.113.2", 429),
        ("192.0.2.1", "203.0.113.3", 200),
        ("192.0.2.1", "203.0.113.4", 429),
    ):
        assert of(client, peer).get(URL, headers={"X-Forwarded-For": forwarded}).status_code == status


@pytest.mark.parametrize("url", ["/", "/docs"])
def test_a_page_runs_and_loads_nothing_but_files_of_the_server(client: TestClient, url: str) -> None:
    response = client.get(url)
    policy = dict(rule.split(" ", 1) for rule in response.headers["Content-Security-Policy"].split("; "))
    own = ("script-src", "style-src", "connect-src", "font-src", "worker-src", "base-uri", "frame-ancestors")
    expected = {"default-src": "'none'", "img-src": "'self' blob: data:", **dict.fromkeys(own, "'self'")}
    assert policy.items() >= expected.items()
    assert not re.search(r"unsafe|https?:|\*", response.headers["Content-Security-Policy"])
    # What a policy without unsafe-inline would block.
    inline = re.findall(r"<script(?![^>]*\ssrc=)|<style|<\w[^>]*\s(?:style|on\w+)=", response.text)
    assert (response.text.count("<script") >= 2, inline) == (True, [])
    others = {
        "X-Content-Type-Options": "nosniff",
        "X-Frame-Options": "SAMEORIGIN",
        "Referrer-Policy": "strict-origin-when-cross-origin",
        "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    }
    assert {name: response.headers.get(name) for name in others} == others


def test_an_opener_policy_is_sent_only_where_browsers_heed_it_and_pages_alone_have_a_content_policy(
    client: TestClient,
) -> None:
    assert "Cross-Origin-Opener-Policy" not in client.get("http://testserver/").headers
    assert client.get("https://testserver/").headers["Cross-Origin-Opener-Policy"] == "same-origin"
    for url in ("/api/presets", "/api/presets/none", "/icon.svg"):
        headers = client.get(url).headers
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert "Content-Security-Policy" not in headers
