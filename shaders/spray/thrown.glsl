// What all births of drops depend on.
uniform float u_spray_speed;
uniform float u_spray_size; // m
uniform float u_spray_mist; // share that is mist
uniform float u_spray_threshold; // m/s

// How hard a front breaks that rises as fast (m/s).
float front_breaks(float rise) {
    return 2.0 * (rise / max(u_spray_threshold, 0.1) - 1.0);
}
