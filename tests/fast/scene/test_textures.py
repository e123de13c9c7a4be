"""Addresses of textures: each is read back as what it was written from, in any process."""

import base64
import gzip
import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from seafoam.scene import Sea, Shore, Surf
from seafoam.textures.foam import FoamTexture
from seafoam.textures.masks import MaskTexture
from seafoam.textures.shore import ShoreFloor, ShoreProfiles, SprayRocks
from seafoam.textures.spec import _JSON, _PATH, TextureSpec, UnknownTextureError
from seafoam.textures.store import lower_part, spec_of, texture, upper_part, url_of
from seafoam.textures.waves import FftTwiddles, FrontIntegral, SeaSpectrum

PATH = re.compile(r"^/api/textures/[A-Za-z0-9\-._~!$&'()*+,;=:@/]+$")
"""Characters of a path that need no escapes (RFC 3986)."""


def height_map(seed: int, *size: int) -> str:
    """A picture as base64, whose alphabet has +, / and =."""
    buffer = io.BytesIO()
    Image.fromarray(np.random.default_rng(seed).integers(0, 256, size, dtype=np.uint8)).save(buffer, format="PNG")
    return base64.b64encode(buffer.getvalue()).decode()


SEAS = st.builds(
    Sea,
    model=st.sampled_from(("fft", "gerstner")),
    wind=st.floats(0.0, 60.0),
    fetch=st.floats(100.0, 1e7),
    wind_direction=st.floats(-6.28, 6.28),
    spread=st.floats(0.0, 100.0),
    against=st.floats(0.0, 1.0),
    choppiness=st.floats(0.0, 1.0),
    seed=st.integers(0, 65535),
)
SHORES = st.one_of(
    st.builds(
        Shore,
        kind=st.sampled_from(("beach", "island", "islands", "lagoon")),
        size=st.floats(40.0, 10000.0),
        heading=st.floats(-6.28, 6.28),
        level=st.floats(-1000.0, 100.0),
        seed=st.integers(0, 65535),
        place=st.tuples(st.floats(-1e7, 1e7), st.floats(-1e7, 1e7)),
        surf=st.builds(Surf, height=st.floats(0.0, 6.0)),
    ),
    st.builds(
        Shore,
        kind=st.just("image"),
        image=st.builds(height_map, st.integers(0, 999), st.just(32), st.just(48)),
        height=st.floats(0.0, 300.0),
    ),
)
SIDES = st.sampled_from((32, 64, 128, 256, 512, 1024))
SPECS: st.SearchStrategy[TextureSpec] = st.one_of(
    st.just(FftTwiddles()),
    st.just(FoamTexture()),
    st.builds(FrontIntegral, intensity=st.floats(0.01, 1e4), log_base=st.floats(0.1, 10.0)),
    st.builds(
        MaskTexture,
        masks=st.lists(
            st.sampled_from(("vac-24", "lace", "vac:1.5:64:7", "lace:4:128:1:2.5:0.1")), min_size=1, max_size=3
        ),
        table=st.sampled_from(("quantiles", "ramps")),
    ),
    st.builds(SeaSpectrum, sea=SEAS, depth=st.none() | st.floats(0.05, 11000.0)),
    st.builds(ShoreFloor, shore=SHORES, texels=SIDES),
    st.builds(ShoreProfiles, nodes=SIDES, skew=st.floats(0.0, 1.0), sharpness=st.floats(0.0, 0.15)),
    st.builds(SprayRocks, shore=SHORES, steep=st.floats(0.0, 2.0)),
)


@settings(max_examples=400, deadline=None)
@given(SPECS)
def test_an_address_is_read_back_as_the_texture_it_was_written_from(spec: TextureSpec) -> None:
    url = url_of(spec)
    assert PATH.match(url), url
    assert spec_of(url) == spec
    # What stands for JSON's punctuation is nowhere else in it.
    assert spec.canonical.translate(_PATH).translate(_JSON) == spec.canonical


def test_what_a_texture_does_not_depend_on_is_not_in_its_address() -> None:
    calm = SeaSpectrum(sea=Sea(choppiness=0.0, model="gerstner"))
    assert url_of(calm) == url_of(SeaSpectrum(sea=Sea())) == "/api/textures/sea/('sea':())"
    far = Shore(place=(100.0, 0.0), surf=Surf(height=0.0), sand=(0.0, 0.0, 0.0))
    assert ShoreFloor(shore=far, texels=64) == ShoreFloor(shore=Shore(), texels=64)


def test_a_picture_of_heights_stands_in_the_address_and_no_longer() -> None:
    image = height_map(1, 70, 82)
    assert 7000 < len(image) <= 8192
    url = url_of(ShoreFloor(shore=Shore(kind="image", image=image, size=640.0, depth=8.0), texels=512))
    assert len(url) < len(image) + 200
    assert texture(spec_of(url)).width == 512


@pytest.mark.parametrize(
    "address",
    [
        "", "nope", "foam/", "foam/()", "foam/('size':1)", "sea", "sea/", "sea/('sea':())/",
        "sea/('sea':('wind':61.0))", "sea/('sea':('wind':NaN))", "sea/('sea':('wind':'15'))",
        "sea/('sea':('wind':15))", "sea/('sea':('choppiness':0.5))", "sea/('sea':(),'depth':-1.0)",
        "sea/('depth':3.0,'sea':(), 'x':1)", "shore-floor/('shore':(),'texels':65)",
        "shore-floor/('shore':('kind':'moon'),'texels':64)", "shore-floor/('shore':('kind':'image'),'texels':64)",
        "shore-floor/('texels':64,'shore':())", "shore-profiles/('nodes':128,'sharpness':0.05,'skew':1.5)",
        "shore-profiles/('nodes':100,'sharpness':0.05,'skew':0.5)", "spray-rocks/('shore':(),'steep':3.0)",
        "front-integral/('intensity':0.0,'log_base':1.0)", "mask/vac-24", "mask/vac-24/nope", "mask/vac-24/ranks/",
        "mask/vac-24+/ramps", "mask/lace+lace/ranks",
    ],
)  # fmt: skip
def test_an_address_of_nothing_is_refused(address: str) -> None:
    with pytest.raises(UnknownTextureError):
        spec_of(f"/api/textures/{address}")


def test_what_nothing_can_be_made_of_is_refused() -> None:
    masks = (MaskTexture(masks=("nope",), table="ranks"), MaskTexture(masks=("vac-24", "vac-6", "nope"), table="ramps"))
    for spec in (*masks, SprayRocks(shore=Shore(slope=0.05, roughness=0.0), steep=0.5)):
        with pytest.raises(UnknownTextureError):
            texture(spec)


def test_the_parts_are_those_that_the_page_joins_and_only_texels_of_16_bits_have_them() -> None:
    """``webclient/tests/textureparts.test.ts`` reads the same file."""
    golden = json.loads((Path(__file__).parents[2] / "golden/texture_parts.json").read_text(encoding="utf-8"))
    texels = np.array(golden["texels"], np.uint16).reshape(-1, golden["width"])
    assert list(gzip.decompress(upper_part(texels))) == golden["upper"]
    assert list(lower_part(texels)) == golden["lower"]
    with pytest.raises(ValueError, match="R16UI"):
        texture(FoamTexture()).part("upper")
