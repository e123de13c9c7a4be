// First step of the distance map: a texel on land is its own nearest land, one at sea its own nearest sea.
// rg: nearest land, ba: nearest sea, in texels; -1: none known.
uniform vec2 u_viewport;
out vec4 o_nearest;

void main() {
    vec2 at = floor(gl_FragCoord.xy);
    bool land = shore_floor(((at + 0.5) / u_viewport - 0.5) * u_shore_size).x >= 0.0;
    o_nearest = land ? vec4(at, -1.0, -1.0) : vec4(-1.0, -1.0, at);
}
