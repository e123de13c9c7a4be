"""Files of the noise library, for effects that call it."""

HASH = "lib/noise/hash.glsl"
VALUE_NOISE = (HASH, "lib/noise/value.glsl")
PERLIN_2 = (HASH, "lib/noise/perlin_2.glsl")
PERLIN_3 = (HASH, "lib/noise/perlin_3.glsl")
