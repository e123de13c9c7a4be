"""Masks: every format of shipped and custom masks holds the same ranks."""

import asyncio
import hashlib
import io
import re

import numpy as np
import pytest

from seafoam.api.routers import masks
from seafoam.masks.catalogue import is_kept, load_catalogue
from seafoam.masks.formats import to_dds, to_npy, to_png8, to_png16, to_u16
from support.serving import picture, problem

CUSTOM = {"family": "vac", "sigma": 2, "width": 96, "height": 64, "seed": 5}
SOURCES = [("/api/masks/vac-6", {}), ("/api/masks/custom", CUSTOM)]


@pytest.fixture(params=SOURCES, ids=["shipped", "custom"])
def fetch(client, request):
    base, params = request.param

    def get(part=""):
        response = client.get(base + part, params=params)
        assert response.status_code == 200, response.text
        return response

    return get


def test_the_catalogue_lists_what_is_served(client):
    listed = client.get("/api/masks").json()
    assert [mask["name"] for mask in listed] == list(load_catalogue())
    for mask in listed:
        assert client.get(f"/api/masks/{mask['name']}").json() == mask


def test_all_formats_hold_the_mask_of_the_hash(fetch):
    """What the formats are is tested in test_formats.py."""
    info = fetch().json()
    texels = info["parameters"]["width"] * info["parameters"]["height"]
    thresholds = np.load(io.BytesIO(fetch("/data.npy").content), allow_pickle=False)
    ranks = np.rint(thresholds.astype(np.float64) * texels - 0.5).astype(np.uint32)
    assert hashlib.sha256(ranks.astype("<u4").tobytes()).hexdigest() == info["sha256"]
    for suffix, form in {"npy": to_npy, "u16": to_u16, "png": to_png16, "dds": to_dds}.items():
        assert fetch(f"/data.{suffix}").content == form(ranks), suffix
    assert fetch("/data8.png").content == to_png8(ranks)


def test_a_download_has_a_name_and_the_sidecar_the_description_and_the_measurements(fetch):
    name = fetch().json()["name"]
    assert fetch("/data.dds").headers["Content-Disposition"] == f'inline; filename="{name}.dds"'
    sidecar = fetch("/sidecar").json()
    assert sidecar.items() >= fetch().json().items()
    assert sidecar["spectrum"] == fetch("/spectrum").json()
    assert sidecar["quantile"]["entries"]
    assert picture(fetch("/spectrum.png")).format == "PNG"


def test_a_slow_mask_is_followed_and_then_there(client, monkeypatch):
    monkeypatch.setattr("seafoam.masks.catalogue.ON_REQUEST_SECONDS", 0.001)
    monkeypatch.setattr("seafoam.api.routers.masks.ON_REQUEST_SECONDS", 0.001)
    params = {"family": "vac", "sigma": 2, "size": 128, "seed": 77}
    refused = client.get("/api/masks/custom/data.u16", params=params)
    assert "GET /api/masks/custom/events" in problem(refused, 422)["errors"][0]["detail"]
    events = client.get("/api/masks/custom/events", params=params)
    assert events.headers["Content-Type"].startswith("text/event-stream")
    names = re.findall(r"^event: (\w+)$", events.text, re.MULTILINE)
    assert names[-1] == "done"
    assert set(names[:-1]) == {"progress"}
    shares = [float(share) for share in re.findall(r"progress\ndata: ([\d.]+)", events.text)]
    assert shares == sorted(shares)
    assert client.get("/api/masks/custom/data.u16", params=params).status_code == 200


def test_few_slow_masks_at_once(client, monkeypatch):
    monkeypatch.setattr(client.app.state.context.slow_masks, "_queue", 0)
    busy = client.get("/api/masks/custom/events", params=CUSTOM)
    problem(busy, 503)
    assert busy.headers["Retry-After"]


@pytest.mark.anyio
async def test_a_mask_that_nobody_follows_ends_early():
    asked = masks.check_custom(masks.CustomMask(family="vac", sigma=2, size=256, seed=78), slow=True)
    made = []
    making = masks._Making(asked)
    events = making.events(asyncio.create_task(asyncio.to_thread(lambda: made.append(making.run()))))
    assert b"progress" in await anext(events)
    await events.aclose()
    assert made == []
    assert not is_kept(asked)
