// A boat under sun and sky, with its own shadow. docs/formulae.md, section 15.
vec3 boat_in_air(vec3 light, vec3 d, float distance_to_eye) {
    return hazed(light, horizon_light(d), distance_to_eye);
}

// d: unit vector toward the boat; o + t d is where it was met.
vec3 boat_light(int i, vec3 o, vec3 d, float t, BoatHit hit) {
    BoatFrame f = boat_frame(i);
    vec3 n = hit.normal.x * f.ahead + hit.normal.y * f.up + hit.normal.z * f.right;
    float gloss;
    vec3 albedo = boat_albedo(hit, u_boat_rig[i].x > 0.5, u_boat_hull[i], u_boat_sails[i], gloss);
    bool sail = hit.part == PART_SAIL;
    float facing = dot(n, u_sun_direction);
    float lit = sail ? max(facing, 0.0) + 0.4 * max(-facing, 0.0) : max(facing, 0.0);
    if (lit > 0.0) {
        // Off the surface on the sun's side, so that nothing shades itself.
        float away = 3e-3 * u_boat_form[i].x;
        vec3 from = o + t * d + away * (facing < 0.0 ? -n : n);
        float far;
        BoatHit other;
        if (trace_boats(from, u_sun_direction, 0.0, 1e4, false, far, other) >= 0) {
            lit = other.part == PART_SAIL ? 0.25 * lit : 0.0;
        }
        lit *= open_sun(from, Footprint(vec2(0.0), vec2(0.0)));
    }
    // From below comes what water mirrors of the light above.
    vec3 bounced = 0.1 * (u_sky_irradiance + u_sun_irradiance * max(u_sun_direction.y, 0.0)) * (0.5 - 0.5 * n.y);
    vec3 light = albedo / PI * (u_sun_irradiance * lit + u_sky_irradiance * (0.5 + 0.5 * n.y) + bounced);
    vec3 r = reflect(d, n);
    vec3 mirrored = sky_light(vec3(r.x, abs(r.y), r.z)) * mix(0.25, 1.0, smoothstep(-0.1, 0.1, r.y));
    return light + gloss * fresnel(clamp(-dot(n, d), 0.0, 1.0)) * (mirrored - light);
}
