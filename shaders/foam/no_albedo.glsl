// No foam: nothing scatters.
float foam_albedo() {
    return 0.0;
}
