// Foam of long ago, from its map and the levels of means below it.
uniform sampler2D u_old_foam;

float fold_old(vec2 p, Footprint fp) {
    // Its texels lie twice as far apart as the sea's.
    float level = SURFACE_FILTER ? max(sea_level(u_sea_size_0, fp) - 1.0, 0.0) : 0.0;
    return textureLod(u_old_foam, sea_place_0(p) + 0.5 / float(AGE_SIZE), level).r;
}
