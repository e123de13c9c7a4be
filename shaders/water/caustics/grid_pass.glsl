// Light of a refracted triangle: its area where it entered over its area here, added where triangles overlap.
uniform vec3 u_caustic_channels; // 1 in those of its colour
in vec2 v_entered;
flat in vec3 v_triangles;
out vec4 o_light;

void main() {
    float ratio = v_entered.x >= v_triangles.z ? v_triangles.x : v_triangles.y;
    o_light = vec4(ratio * v_entered.y * u_caustic_channels, 0.0);
}
