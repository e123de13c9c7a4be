// Where the open water breaks: folds of the sea, and fronts of single waves that rise fast.
uniform vec2 u_spray_crest;    // velocity of the sea's breaking crests, m/s
uniform float u_spray_strong;  // strength of what they throw, 0 to 1

// How hard, above 0 where it does; p: where the water rests, and returns where it is. onward: velocity of the front that throws the
// water, y: its rise, m/s; strong: of what it throws.
float spray_breaks(inout vec2 p, int batch, float age, out vec3 onward, out float strong) {
    float folds = sea_breaks(p, batch);
    vec4 fronts = fronts_then(p, age);
    float steep = front_breaks(fronts.w);
    strong = u_spray_strong;
    onward = vec3(u_spray_crest, strong * (0.2 + 0.3 * clamp(folds, 0.0, 1.0)) * length(u_spray_crest)).xzy;
    if (steep > folds) {
        // Level lines of the wave go on at rise over slope; a crest has none, and is held.
        strong = 1.0;
        onward = vec3(-fronts.yz * (fronts.w / max(dot(fronts.yz, fronts.yz), 0.02)), fronts.w).xzy;
    }
    return max(folds, steep);
}

// Height of the surface, m.
float spray_height(vec2 p, int batch, float age) {
    return sea_then(p, batch) + fronts_then(p, age).x + rings_then(p, age);
}
