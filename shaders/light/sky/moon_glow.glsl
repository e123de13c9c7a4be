// Moonlight that the air scatters: the sky of a small sun.
uniform vec3 u_moon_direction;
uniform vec3 u_moon_path;        // optical depth of the air that its light passes down to here
uniform vec3 u_moon_power;       // irradiance over the air

vec3 moon_glow(vec3 d) {
    return air_glow(d, u_moon_direction, u_moon_path, u_moon_power, 0.0);
}
