// Corner of a quadrilateral of two triangles that gl_VertexID names: right and up are 1, left and down -1.
vec2 quad_corner() {
    int corner = gl_VertexID % 6;
    return vec2(corner == 1 || corner == 4 || corner == 5 ? 1.0 : -1.0, corner == 2 || corner == 3 || corner == 5 ? 1.0 : -1.0);
}
