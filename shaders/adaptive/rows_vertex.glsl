// One triangle over those rows of the target that chosen pixels fill, and over no other. docs/formulae.md, section 1.
uniform sampler2D u_chosen_rows;
uniform vec2 u_picture; // pixels
uniform vec2 u_target;  // pixels

void main() {
    float blocks = chosen_total(texelFetch(u_chosen_rows, ivec2(0, textureSize(u_chosen_rows, 0).y - 1), 0).zw);
    float columns = float(chosen_columns(int(u_picture.x)));
    float filled = 2.0 * ceil(blocks / columns) * u_chosen.y / u_target.y - 1.0;
    vec2 corner = gl_VertexID == 0 ? vec2(-9.0, filled) : gl_VertexID == 1 ? vec2(9.0, filled) : vec2(0.0, -9.0);
    gl_Position = vec4(corner.x, corner.y * u_chosen.z, FULLSCREEN_DEPTH, 1.0);
}
