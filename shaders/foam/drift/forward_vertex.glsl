// Forward mapping, one step (particle maps): the foam of a cell goes from the cell's middle along the flow into the cell where it ends. A
// step shorter than half a cell leads nowhere, and cells that no way leads to stay empty. One point a cell and generation.
uniform sampler2D u_drift_from;
uniform float u_drift_texel; // m
flat out vec4 v_foam;

void main() {
    int j = gl_VertexID & 3;
    ivec2 cell = ivec2((gl_VertexID >> 2) % DRIFT_SIZE, (gl_VertexID >> 2) / DRIFT_SIZE);
    vec4 only = vec4(equal(ivec4(0, 1, 2, 3), ivec4(j)));
    v_foam = only * texel_at(u_drift_from, cell);
    vec2 q = (vec2(cell) + 0.5) * u_drift_texel - u_drift_half;
    q += drift_velocity(q) * drift_age(j) / float(DRIFT_MOVES);
    // What has nothing to carry is drawn nowhere.
    gl_Position = dot(v_foam, only) > 0.0 ? vec4(q / u_drift_half, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}
