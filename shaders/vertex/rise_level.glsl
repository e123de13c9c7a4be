// Over level water no ray that rises comes to it.
float water_rise() {
    return u_eye_height >= 0.0 ? 0.0 : 1e9;
}
