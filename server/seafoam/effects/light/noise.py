"""Files of the noise library, for effects that call it."""

HASH = "noise/hash.glsl"
VALUE_NOISE = (HASH, "noise/value.glsl")
PERLIN_2 = (HASH, "noise/perlin_2.glsl")
PERLIN_3 = (HASH, "noise/perlin_3.glsl")
