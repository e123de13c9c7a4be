// Light of a refracted triangle: its area where it entered over its area here, added where triangles overlap.
in vec3 v_light;
out vec4 o_light;

const float CAUSTIC_MOST = 12.0; // a triangle folded to nothing would be infinitely bright

void main() {
    vec2 x = dFdx(v_light.xy);
    vec2 y = dFdy(v_light.xy);
    float texels = float(CAUSTIC_TEXELS) / float(CAUSTIC_CELLS);
    float ratio = min(abs(x.x * y.y - x.y * y.x) * texels * texels, CAUSTIC_MOST);
    o_light = vec4(ratio * v_light.z, 0.0, 0.0, 0.0);
}
