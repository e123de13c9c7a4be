// A place seen from a stone in a current: how far behind its upstream edge, and how far to the side. docs/formulae.md, section 16.
uniform vec4 u_stone_course[STONE_COUNT]; // from the stone to the eye x, z (m), 0, radius of its course through the water (m)
uniform vec4 u_stone_form[STONE_COUNT];   // length of a hull that makes such waves (m), radius (m), length of its waves (m), 0
uniform vec2 u_stone_flow;                // direction of the current

struct StoneWay {
    float behind;    // m
    float aside;     // m
    vec2 on_behind;  // gradients along x and z
    vec2 on_aside;
};

StoneWay stone_way(int i, vec2 p) {
    vec2 from = p + u_stone_course[i].xy;
    vec2 across = vec2(-u_stone_flow.y, u_stone_flow.x);
    return StoneWay(dot(from, u_stone_flow) + u_stone_form[i].y, dot(from, across), u_stone_flow, across);
}
