// What place_corner places, from an eye on one side of the water; from the other it lies outside the picture. Drivers without branches
// would shade every sample for both.
void main() {
    place_corner();
    if ((u_eye_height >= waves(vec2(0.0)).x) != FROM_OVER) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }
}
