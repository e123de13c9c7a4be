// Distance to the nearest point of the opposite kind (Outerra 2011), m: positive at sea, negative on land; r. The coast
// lies half a texel off the texels along it. Depth of the floor, m; g. Without any coast: as far as the square is wide.
uniform vec2 u_viewport;
uniform sampler2D u_nearest;
out vec4 o_distance;

void main() {
    vec2 at = floor(gl_FragCoord.xy);
    vec4 found = texelFetch(u_nearest, ivec2(at), 0);
    float height = shore_floor(((at + 0.5) / u_viewport - 0.5) * u_shore_size).x;
    bool land = height >= 0.0;
    vec2 other = land ? found.zw : found.xy;
    float texels = other.x < 0.0 ? u_viewport.x : length(other - at) - 0.5;
    o_distance = vec4((land ? -texels : texels) * u_shore_size / u_viewport.x, -height, 0.0, 1.0);
}
