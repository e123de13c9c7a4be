"""Textures that plans refer to: typed descriptions, and the same bytes for every executor.

Nothing here depends on time or camera, and no effect is known by name.
"""

from seafoam.textures.foam import FoamTexture, foam_texture
from seafoam.textures.front import FRONT_NODES, FrontIntegral, front_fading, front_full
from seafoam.textures.masks import MaskTable, MaskTexture
from seafoam.textures.parts import TexturePart
from seafoam.textures.sea import FftTwiddles, SeaSpectrum
from seafoam.textures.shore import ROWS, ShoreFloor, ShoreProfiles, ShoreTravel, shore_profiles
from seafoam.textures.spec import TextureSpec, UnknownTextureError
from seafoam.textures.spray import SprayRocks, SprayStrands
from seafoam.textures.store import TextureData, spec_at, spec_of, texture, url_of

__all__ = [
    "FRONT_NODES",
    "ROWS",
    "FftTwiddles",
    "FoamTexture",
    "FrontIntegral",
    "MaskTable",
    "MaskTexture",
    "SeaSpectrum",
    "ShoreFloor",
    "ShoreProfiles",
    "ShoreTravel",
    "SprayRocks",
    "SprayStrands",
    "TextureData",
    "TexturePart",
    "TextureSpec",
    "UnknownTextureError",
    "foam_texture",
    "front_fading",
    "front_full",
    "shore_profiles",
    "spec_at",
    "spec_of",
    "texture",
    "url_of",
]
