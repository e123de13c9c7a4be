// A photon of a regular grid, counted where it lands in the tile.
flat out vec3 v_photon; // texel where it lands; light
flat out vec4 v_part;   // which of four sums it joins

void main() {
    ivec2 corner = ivec2(gl_VertexID % CAUSTIC_PHOTONS, gl_VertexID / CAUSTIC_PHOTONS);
    vec3 landing = caustic_landing(corner, CAUSTIC_PHOTONS);
    vec2 place = fract(vec2(corner) / float(CAUSTIC_PHOTONS) + landing.xy / u_caustic_tile);
    vec2 texel = place * float(CAUSTIC_TEXELS) + float(CAUSTIC_RIM);
    float share = float(CAUSTIC_TEXELS) / float(CAUSTIC_PHOTONS);
    v_photon = vec3(texel, landing.z * share * share);
    // Half floats round at every addition: four sums of a quarter each round a quarter as much.
    ivec2 odd = corner & 1;
    v_part = vec4(equal(ivec4(odd.x + 2 * odd.y), ivec4(0, 1, 2, 3)));
    gl_PointSize = 4.0;
    gl_Position = vec4(2.0 * texel / float(CAUSTIC_TEXELS + 2 * CAUSTIC_RIM) - 1.0, 0.0, 1.0);
}
