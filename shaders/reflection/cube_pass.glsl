// The six faces of the cube map, its sky as level water of this roughness mirrors it.
uniform float u_roughness; // root mean square slope

out vec4 o_light;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 cell = texel / CUBE_SIZE;
    vec2 at = 2.0 * vec2(texel - cell * CUBE_SIZE) / float(CUBE_SIZE - 1) - 1.0;
    vec3 d = normalize(cube_direction(cell.x + 3 * cell.y, at));
    // Water mirrors nothing from under the horizon: half of the texels are never read.
    vec3 light = d.y < -0.1 ? vec3(0.0) : surroundings(d, 1.41421356 * u_roughness * vec3(1.0, length(vec2(d.y, u_roughness)), 0.0));
    o_light = vec4(min(light, BRIGHTEST), 1.0);
}
