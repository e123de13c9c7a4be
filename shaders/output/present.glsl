// Linear light to the screen: tone curve, then the sRGB transfer curve (IEC 61966-2-1), by hand since formats disagree on it.
uniform sampler2D u_linear;
out vec4 o_color;

// x in [0, 1]. 1.055 x^(5/12) - 0.055 as a polynomial in x^(1/4), to 0.002 of a level: a power costs as much as two roots and more.
vec3 srgb(vec3 x) {
    vec3 s = sqrt(sqrt(max(x, 0.0031308)));
    vec3 curved = -0.0614833354 + s * (0.163495493 + s * (1.24977997 + s * (-0.567387739 + s * (0.280971055 - 0.0653806371 * s))));
    return mix(12.92 * x, curved, step(0.0031308, x));
}

void main() {
    vec3 linear = texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0).rgb;
    o_color = vec4(srgb(tone(max(with_glare(linear), 0.0))), 1.0);
}
