// No waves are told apart as short.
const bool SHORT_WAVES = false;

vec3 short_waves() {
    return vec3(0.0);
}
