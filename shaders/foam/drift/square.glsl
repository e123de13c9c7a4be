// The square that drift acts on; places in it are counted from its middle.
uniform float u_drift_half; // half its side, m
