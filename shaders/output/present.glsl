// Linear light to the screen: tone curve, then the sRGB transfer curve (IEC 61966-2-1), by hand since formats disagree on it.
uniform sampler2D u_linear;
out vec4 o_color;

vec3 srgb(vec3 x) {
    vec3 curved = 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
    return mix(12.92 * x, curved, step(0.0031308, x));
}

void main() {
    vec3 linear = texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0).rgb;
    o_color = vec4(srgb(tone(max(linear, 0.0))), 1.0);
}
