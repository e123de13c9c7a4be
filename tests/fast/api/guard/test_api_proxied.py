"""The server below a path of a proxy: no answer leads out of it."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urljoin

import httpx2
import pytest
from starlette.testclient import TestClient

import seafoam
from seafoam.api.guard.proxy_headers import relative
from seafoam.scene import preset_names
from support.browser.proxy import proxied
from support.command import free_port
from support.serving import answering, served

PREFIX = "/water"
"""The hardest one, since addresses of the server begin so."""
PAGES = ("", "learn", "learn/laboratory", "masks", "docs", "docs/", "api/", "water", "water/default", "water/nothing")
LOCATIONS = Path(__file__).parents[4] / "scripts" / "deploy" / "nginx-path.conf"
NGINX = shutil.which("nginx")


@contextmanager
def documented(address: str, folder: Path) -> Iterator[str]:
    """nginx with the file for it."""
    assert NGINX
    locations = LOCATIONS.read_text().replace("http://127.0.0.1:8000", address)
    outside = f"127.0.0.1:{free_port()}"
    kinds = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    temporary = " ".join(f"{kind}_temp_path {folder / kind};" for kind in kinds)
    server = f"access_log off; server {{ listen {outside}; include {folder}/locations; }}"
    (folder / "locations").write_text(locations)
    (folder / "nginx.conf").write_text(f"pid {folder}/pid; events {{}} http {{ {temporary} {server} }}")
    command = [NGINX, "-c", folder / "nginx.conf", "-e", folder / "errors", "-g", "daemon off;"]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    try:
        yield f"http://{outside}{PREFIX}"
    finally:
        process.terminate()
        process.wait(20)


@pytest.fixture(
    scope="module",
    params=["here", pytest.param("nginx", marks=pytest.mark.skipif(NGINX is None, reason="nginx is not installed"))],
)
def behind(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a server behind a proxy."""
    folder = tmp_path_factory.mktemp("served")
    with served(folder) as (address, _):
        proxy = documented(address, folder) if request.param == "nginx" else proxied(address, PREFIX)
        with proxy as outside:
            yield f"{outside}/"


@pytest.fixture(scope="module")
def web() -> Iterator[httpx2.Client]:
    """One for all requests: each of its own would read the certificates of all authorities first."""
    with httpx2.Client(timeout=60) as client:
        yield client


SEEN: set[str] = set()
"""Addresses that something was found at: most pages name the same files."""


def addresses(page: httpx2.Response) -> set[str]:
    """What a page loads and links to on its server."""
    base = re.search(r'<base href="([^"]+)"', page.text)
    start = urljoin(str(page.url), base[1]) if base else str(page.url)
    named = re.findall(r'<(?!base).*(?:src|href|data-description)="([^"#]+)"', page.text)
    found = {urljoin(start, each) for each in named}
    return {each for each in found if each.startswith("http://127.0.0.1")}


@pytest.mark.parametrize("name", PAGES)
def test_pages_lead_nowhere_else(behind: str, web: httpx2.Client, name: str) -> None:
    page = web.get(behind + name, follow_redirects=True)
    assert page.status_code == (404 if name.endswith("nothing") else 200)
    assert str(page.url).startswith(behind)
    linked = addresses(page)
    assert len(linked) > 2
    for address in linked - SEEN:
        assert address.startswith(behind), address
        assert web.get(address, follow_redirects=True).status_code == 200, address
    SEEN.update(linked)


def test_a_page_names_the_proxys_address_where_links_are_previewed_and_operations_listed(
    behind: str, web: httpx2.Client
) -> None:
    own = f"{behind}water/coastline"
    page = web.get(own).text
    for tag in (f'="og:url" content="{own}"', f'rel="canonical" href="{own}"', f'="og:image" content="{own}.jpg"'):
        assert tag in page
    assert web.get(f"{own}.jpg").headers["content-type"] == "image/jpeg"
    document = web.get(f"{behind}openapi.json")
    (server,) = document.json()["servers"]
    assert urljoin(str(document.url), server["url"]) == behind
    page = web.get(f"{behind}water/").text
    assert re.findall(r'<a href="\./([^"]+)"', page) == list(preset_names())


def test_programs_draw_by_the_proxys_address(behind: str, web: httpx2.Client) -> None:
    frame = web.get(f"{behind}api/frames/default.png?width=16&height=16")
    where = re.search("<(.+)>", frame.headers["link"])
    assert where
    assert web.get(urljoin(str(frame.url), where[1])).headers["link"]
    with seafoam.connect(behind) as connection:
        assert connection.frame("default", size=(16, 16)).size == (16, 16)
    opened = web.post(f"{behind}api/streams", json={"scene": {}, "quality": "fast"})
    stream = urljoin(str(opened.url), opened.headers["location"])
    query = "time=1&width=16&height=16&x=0&y=3&z=0&yaw=0&pitch=0&roll=0&fov=1"
    assert web.get(f"{stream}/frame.jpg?{query}").headers["content-type"] == "image/jpeg"


def test_a_prefix_is_set_or_told_by_who_is_trusted() -> None:
    app = answering(root_path="/set/").app
    for peer, told, base in (
        ("127.0.0.1", None, "/set/"),
        ("127.0.0.1", "/told/", "/told/"),
        ("127.0.0.1", '/"><script>', "/set/"),
        ("203.0.113.9", "/told", "/set/"),
    ):
        sent = {"X-Forwarded-Prefix": told} if told else {}
        page = TestClient(app, client=(peer, 1)).get("/water/default", headers=sent).text
        assert f'property="og:url" content="http://testserver{base}water/default"' in page, (peer, told)


def test_relative_addresses_lead_where_absolute_ones_do() -> None:
    for path in ("/learn", "/docs/", "/a/b", "/a/b/"):
        for target in ("/learn/", "/docs", "/a/b/", "/a:b/c?d=e", "/"):
            whole = "http://testserver" + target
            assert urljoin("http://testserver" + path, relative(path, whole)) == whole, (path, target)
