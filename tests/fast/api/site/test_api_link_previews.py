"""Each preset's own page, and what edits a scene: its schema alone, and scenes checked and completed."""

import html
import io
import json
import re

import pytest
from PIL import Image
from starlette.testclient import TestClient

from seafoam.api.site import PREVIEW
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset, preset_names
from support.serving import problem


def tags(page: str) -> dict[str, str]:
    """The content of a page's meta tags by name or property."""
    found = re.findall(r'<meta (?:name|property)="([\w:-]+)" content="([^"]*)"', page)
    return {name: html.unescape(content) for name, content in found}


@pytest.mark.parametrize("name", preset_names())
def test_each_preset_has_a_page_with_its_title_text_and_picture(client: TestClient, name: str) -> None:
    preset = load_preset(name)
    response = client.get(f"/water/{name}")
    assert (response.status_code, response.headers["Content-Type"].partition(";")[0]) == (200, "text/html")
    assert "Content-Security-Policy" in response.headers
    page = response.text
    assert f'data-preset="{name}"' in page
    assert html.unescape(page.split("<title>")[1].split("</title>")[0]) == f"{preset.title} · Seafoam"
    found = tags(page)
    assert found["description"] == found["og:description"] == preset.summary
    assert found["og:title"] == f"{preset.title} · Seafoam"
    assert found["og:url"] == f"http://testserver/water/{name}"
    assert found["twitter:card"] == "summary_large_image"
    picture = client.get(found["og:image"])
    assert picture.headers["Content-Type"] == "image/jpeg"
    with Image.open(io.BytesIO(picture.content)) as opened:
        assert opened.format == "JPEG"
        assert opened.size == PREVIEW
    assert len(picture.content) < 400_000


def test_the_files_of_a_presets_page_are_the_pages_own(client: TestClient) -> None:
    page = client.get("/water/coastline").text
    assert page.index("<base") < page.index("href=", page.index("<base") + 20)
    assert '<base href="../" />' in page
    addresses = re.findall(r'(?:src|href)="(\./[^"]+)"', page)
    assert len(addresses) >= 4
    for address in addresses:
        assert client.get(f"/water/../{address}").status_code == 200, address


def test_an_unknown_water_is_told_by_a_page(client: TestClient) -> None:
    for suffix in ("", ".jpg"):
        response = client.get(f"/water/%3Cb%3Eatlantis{suffix}")
        assert (response.status_code, response.headers["Content-Type"].partition(";")[0]) == (404, "text/html")
        assert "Content-Security-Policy" in response.headers
        assert "&lt;b&gt;atlantis" in response.text
        assert "<b>" not in response.text
    assert client.get("/message.css").status_code == 200


def test_the_schema_is_the_documents_and_complete(client: TestClient) -> None:
    schema = client.get("/api/schema").json()
    whole = client.get("/openapi.json").json()["components"]["schemas"]
    own = schema["components"]["schemas"]
    assert schema["tiers"] == list(TIERS)
    assert {"Scene", "Quality", "Light", "Foam"} <= set(own) < set(whole)
    assert "FramePlan" not in own
    assert all(whole[name] == described for name, described in own.items())
    assert set(re.findall(r'"#/components/schemas/(\w+)"', json.dumps(own))) <= set(own)


def test_a_scene_is_completed_or_what_cannot_be_drawn_is_told(client: TestClient) -> None:
    completed = client.post("/api/scenes", json={"light": {"exposure": -1.0}}).json()
    assert completed["light"]["exposure"] == -1.0
    assert {"waves", "foam", "camera", "water"} <= set(completed)
    own = client.get("/api/presets/storm").json()["scene"]
    assert client.post("/api/scenes", json=own).json() == own
    for scene, pointer in (
        ({"light": {"exposure": 1e9}}, "/light/exposure"),
        ({"foam": {"mask": "none"}}, "/foam/mask"),
    ):
        assert problem(client.post("/api/scenes", json=scene), 422)["errors"][0]["pointer"] == pointer
