"""Rates by client: the bucket, who a client is, and what the answers say."""

import pytest
from starlette.testclient import TestClient

from seafoam.api.guard.access_control import TokenBuckets, bucket_of
from support.serving import Clock, answering, problem

KEY = "correct-horse-battery"
URL = "/api/quality"


def of(client: TestClient, address: str) -> TestClient:
    """The same app, asked from another address."""
    return TestClient(client.app, client=(address, 50000))


def test_a_bucket_holds_its_burst_and_refills_as_a_refused_client_is_told() -> None:
    clock = Clock()
    buckets = TokenBuckets(2.0, 5, clock=clock)
    assert [buckets.take("a").left for _ in range(5)] == [4, 3, 2, 1, 0]
    refused = buckets.take("a")
    assert not refused.allowed
    assert refused.seconds == 1
    clock.now += 0.49
    assert not buckets.take("a").allowed
    clock.now += 0.01
    assert buckets.take("a").allowed
    clock.now += 60.0
    assert buckets.take("a").left == 4
    buckets = TokenBuckets(0.3, 2, clock=clock)
    for _ in range(2):
        buckets.take("a")
    clock.now += buckets.take("a").seconds
    assert buckets.take("a").allowed


@pytest.mark.parametrize(("rate", "burst"), [(0.1, 1), (3.0, 7), (250.0, 20)])
def test_no_window_holds_more_than_burst_and_rate_allow(rate: float, burst: int) -> None:
    clock = Clock()
    buckets = TokenBuckets(rate, burst, clock=clock)
    step = 0.1 / rate
    allowed = 0
    for _ in range(1000):
        allowed += buckets.take("a").allowed
        clock.now += step
    assert burst + 99 - 1 <= allowed <= burst + 100


def test_the_memory_is_bounded_and_the_busy_are_remembered() -> None:
    buckets = TokenBuckets(1.0, 2, clients=100, clock=Clock())
    for number in range(1000):
        buckets.take(f"client {number}")
        buckets.take("busy")
    assert len(buckets._full_at) == 100
    assert not buckets.take("busy").allowed


def test_an_ipv6_network_is_one_client() -> None:
    same = {("2001:db8::1", "2001:db8::ffff:1"), ("::ffff:10.0.0.1", "10.0.0.1")}
    others = {("10.0.0.1", "10.0.0.2"), ("2001:db8:0:1::1", "2001:db8:0:2::1"), ("testclient", "")}
    assert {pair for pair in same | others if bucket_of(pair[0]) == bucket_of(pair[1])} == same


def test_beyond_its_rate_a_client_is_told_when_to_come_back() -> None:
    client = answering(rate=0.5, rate_burst=2)
    first = client.get(URL)
    assert first.status_code == 200
    assert first.headers["RateLimit-Policy"] == '"api";q=2;w=4'
    assert first.headers["RateLimit"] == '"api";r=1;t=2'
    client.get(URL)
    refused = client.get(URL)
    told = problem(refused, 429)
    assert (refused.headers["Retry-After"], refused.headers["RateLimit"]) == ("2", '"api";r=0;t=2')
    assert told["type"] == "urn:seafoam:problem:rate-exceeded"
    assert "2 requests at once and 0.5 a second" in told["detail"]


def test_pages_and_health_checks_have_no_rate_and_without_the_setting_nothing_has() -> None:
    client = answering(rate=0.001, rate_burst=1)
    for url in ("/", "/docs", "/healthz", "/icon.svg") * 3:
        response = client.get(url)
        assert response.status_code == 200
        assert "RateLimit" not in response.headers
    client = answering()
    responses = [client.get("/api/nothing") for _ in range(30)]
    assert {each.status_code for each in responses} == {404}
    assert not any("RateLimit" in each.headers for each in responses)


def test_each_client_has_a_rate_of_its_own() -> None:
    client = answering(rate=0.001, rate_burst=1, api_keys=f"alice:{KEY}")
    key = {"Authorization": f"Bearer {KEY}"}
    assert of(client, "10.0.0.1").get(URL, headers=key).status_code == 200
    # A key is one client at every address.
    assert of(client, "10.0.0.2").get(URL, headers=key).status_code == 429
    # Guesses at keys are counted too.
    assert [of(client, "10.0.0.3").get(URL).status_code for _ in range(2)] == [401, 429]
    assert of(client, "10.0.0.4").get(URL).status_code == 401


def test_only_a_trusted_proxy_says_who_the_client_is() -> None:
    client = answering(rate=0.001, rate_burst=1, trusted_proxies="10.0.0.0/8, ::1")

    def status(peer: str, forwarded: str) -> int:
        return of(client, peer).get(URL, headers={"X-Forwarded-For": forwarded}).status_code

    assert status("10.1.2.3", "203.0.113.1") == 200
    assert status("10.1.2.3", "203.0.113.2") == 200
    assert status("10.1.2.3", "203.0.113.1") == 429
    # The last that the proxy did not trust counts, whatever a client puts before it.
    assert status("10.1.2.3", "198.51.100.7, 203.0.113.2") == 429
    assert status("192.0.2.1", "203.0.113.3") == 200
    assert status("192.0.2.1", "203.0.113.4") == 429
