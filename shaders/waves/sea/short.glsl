// The second tile of the sea: short waves that ride on those of the first. docs/formulae.md, section 3.
const bool SHORT_WAVES = true;

// Height and its gradient, of the place whose waves were asked for last.
vec3 short_waves() {
    return sea_short;
}
