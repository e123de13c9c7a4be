// Over level water no ray that rises comes to it, from no height.
float water_rise() {
    return 0.0;
}
