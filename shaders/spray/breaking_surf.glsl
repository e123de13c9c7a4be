// Where surf breaks on a beach: fronts of the shore's waves that rise fast.

// How hard, above 0 where it does. onward: velocity of the front that throws the water, y: its rise, m/s; strong: of what it throws.
float spray_breaks(inout vec2 p, int batch, float age, out vec3 onward, out float strong) {
    strong = 1.0;
    onward = vec3(0.0);
    vec2 q = shore_place(p);
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        return 0.0;
    }
    ShoreField f = shore_field(q);
    if (f.here.g <= 0.0) {
        return 0.0;
    }
    float rise = (shore_then(f, q, age - SPRAY_MOMENT) - shore_then(f, q, age + SPRAY_MOMENT)) / (2.0 * SPRAY_MOMENT);
    // The phase grows out to sea, by a period in the time that a wave takes.
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    onward = vec3(-out_to_sea / (max(dot(out_to_sea, out_to_sea), 1e-4) * u_spray_period), rise).xzy;
    return front_breaks(rise);
}

// Height of the surface, m.
float spray_height(vec2 p, int batch, float age) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    return f.here.a * (sea_then(p, batch) + fronts_then(p, age).x + rings_then(p, age)) + shore_then(f, q, age);
}
