// The table of drops at their births: rows of part 0 over those of parts 1 and 2.
out vec4 o_birth;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int part = at.y / SPRAY_ROWS;
    Drop drop;
    o_birth = vec4(0.0);
    if (spray_born((at.y - part * SPRAY_ROWS) * SPRAY_COLUMNS + at.x, part == 0, drop)) {
        float seed = float(drop.word >> 8u);
        o_birth = part == 0 ? vec4(drop.birth, drop.age)
            : part == 1 ? vec4(drop.velocity, drop.radius)
            : vec4(SPRAY_THINNER * drop.strength, drop.kind, seed, drop.life);
    }
}
