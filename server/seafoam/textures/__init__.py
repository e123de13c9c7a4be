"""Texture data that plans refer to, generated from their names with the same bytes for every executor."""

from seafoam.textures.foam import foam_texture
from seafoam.textures.front import FRONT_NODES, front_fading, front_full, front_integral_name
from seafoam.textures.sea import sea_spectrum_name
from seafoam.textures.shore import ROWS, shore_floor_name, shore_profiles, shore_profiles_name
from seafoam.textures.spray import spray_rocks_name
from seafoam.textures.store import TextureData, UnknownTextureError, texture

__all__ = [
    "FRONT_NODES",
    "ROWS",
    "TextureData",
    "UnknownTextureError",
    "foam_texture",
    "front_fading",
    "front_full",
    "front_integral_name",
    "sea_spectrum_name",
    "shore_floor_name",
    "shore_profiles",
    "shore_profiles_name",
    "spray_rocks_name",
    "texture",
]
