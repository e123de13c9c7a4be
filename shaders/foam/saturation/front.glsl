// Foam from the wave's front (Yingst, Alford and Parberry 2011), at a point. Without unit, [0, 4].
float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 by_x;
    vec2 by_z;
    vec2 signal = front_signal(p, by_x, by_z);
    float rho = length(signal);
    return front_gate(rho) * front_profile(signal, rho);
}
