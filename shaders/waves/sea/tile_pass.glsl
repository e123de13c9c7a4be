// A texel of the height field: what the water that is there has brought along.
void main() {
    Displaced here = displaced(resting(floor(gl_FragCoord.xy)));
    vec3 a = stretch(here);
    vec2 slope = unstretched(a, vec2(here.by_x.x, here.by_z.x) / u_sea_texel);
    slope *= min(1.0, u_sea_limit.y / max(length(slope), 1e-30));
    o_tile = vec4(clamp(here.value.x, -u_sea_limit.x, u_sea_limit.x), slope, a.x + a.y - 2.0);
}
