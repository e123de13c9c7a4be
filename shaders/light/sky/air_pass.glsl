// What changes little between the samples of a sky.
out vec4 o_air;

void main() {
    o_air = min(exposed_air(normalize(camera_ray(gl_FragCoord.xy))), BRIGHTEST);
}
