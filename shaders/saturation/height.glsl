// Foam by height, f = (H - H0)/(Hmax - H0) (Kryachko 2005); heights in metres, f in [0, 4].
uniform float u_height_level; // still water over the paper's troughs, from which H0 and Hmax count, m
uniform float u_height_base;  // H0, m
uniform float u_height_full;  // Hmax, at least 1 mm above H0, m

float height_saturation(vec2 p, float height, Footprint fp) {
    return clamp((height + u_height_level - u_height_base) / max(u_height_full - u_height_base, 1e-3), 0.0, 4.0);
}
