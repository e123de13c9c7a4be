// What was drawn after surface and sky (premultiplied alpha), laid over them. A stays the water's foam amount.
uniform sampler2D u_beneath;
uniform sampler2D u_above;
out vec4 o_color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 beneath = texelFetch(u_beneath, at, 0);
    vec4 above = texelFetch(u_above, at, 0);
    o_color = vec4(min(beneath.rgb * (1.0 - min(above.a, 1.0)) + above.rgb, BRIGHTEST), beneath.a);
}
