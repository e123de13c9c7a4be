"""Masks: every format of shipped and custom masks holds the same ranks."""

import hashlib
import io
import struct

import numpy as np
import pytest
from PIL import Image

from seafoam.masks.catalogue import load_catalogue, load_mask

CUSTOM = {"family": "vac", "sigma": 2, "size": 64, "seed": 5}
SOURCES = [("/api/masks/vac-6", {}), ("/api/masks/custom", CUSTOM)]


@pytest.fixture(params=SOURCES, ids=["shipped", "custom"])
def fetch(client, request):
    base, params = request.param

    def get(part=""):
        response = client.get(base + part, params=params)
        assert response.status_code == 200, response.text
        return response

    return get


def test_the_catalogue(client):
    listed = client.get("/api/masks").json()
    assert [mask["name"] for mask in listed] == list(load_catalogue())
    for mask in listed:
        assert client.get(f"/api/masks/{mask['name']}").json() == mask


def test_all_formats_hold_the_mask_of_the_hash(fetch):
    info = fetch().json()
    size = info["parameters"]["size"]
    thresholds = np.load(io.BytesIO(fetch("/data.npy").content), allow_pickle=False)
    ranks = np.rint(thresholds.astype(np.float64) * size * size - 0.5).astype(np.uint32)
    assert thresholds.dtype == np.float32
    assert hashlib.sha256(ranks.astype("<u4").tobytes()).hexdigest() == info["sha256"]
    words = (ranks.astype(np.uint64) << 16) // (size * size)
    np.testing.assert_array_equal(np.frombuffer(fetch("/data.u16").content, "<u2").reshape(size, size), words)
    png = Image.open(io.BytesIO(fetch("/data.png").content))
    assert png.mode == "I;16"
    np.testing.assert_array_equal(np.asarray(png), words)
    png8 = Image.open(io.BytesIO(fetch("/data8.png").content))
    assert png8.mode == "L"
    np.testing.assert_array_equal(np.asarray(png8), words >> 8)
    dds = fetch("/data.dds").content
    assert dds[:4] == b"DDS "
    assert struct.unpack_from("<2I", dds, 12) == (size, size)
    np.testing.assert_array_equal(np.frombuffer(dds, "<u2", offset=148).reshape(size, size), words)


def test_a_download_has_a_name(fetch):
    name = fetch().json()["name"]
    assert fetch("/data.dds").headers["Content-Disposition"] == f'inline; filename="{name}.dds"'


def test_the_sidecar_holds_the_description_and_the_measurements(fetch):
    sidecar = fetch("/sidecar").json()
    assert sidecar.items() >= fetch().json().items()
    assert sidecar["spectrum"] == fetch("/spectrum").json()
    assert sidecar["quantile"]["entries"]


def test_the_plot_is_a_picture(fetch):
    assert Image.open(io.BytesIO(fetch("/spectrum.png").content)).format == "PNG"


def test_a_custom_mask_is_the_same_each_time_and_differs_by_seed(client):
    first = client.get("/api/masks/custom/data.u16", params=CUSTOM)
    again = client.get("/api/masks/custom/data.u16", params=CUSTOM)
    other = client.get("/api/masks/custom/data.u16", params=CUSTOM | {"seed": 6})
    assert first.content == again.content
    assert first.content != other.content
    assert first.headers["ETag"] == again.headers["ETag"] != other.headers["ETag"]


@pytest.mark.parametrize("family", ["vac", "blur", "clump", "bubble", "mix"])
def test_every_family_is_made_with_its_own_default(client, family):
    info = client.get("/api/masks/custom", params={"family": family, "size": 64}).json()
    assert info["family"] == family
    assert info["parameters"]["size"] == 64


def test_the_shipped_ranks_are_served(client):
    content = client.get("/api/masks/mix/data.u16").content
    ranks = load_mask("mix").ranks
    np.testing.assert_array_equal(np.frombuffer(content, "<u2"), (ranks.ravel() // 4).astype("<u2"))
