// Nothing throws up drops.
uniform float u_spray_life; // s

bool spray_born(int i, out vec3 birth, out vec3 velocity, out float age, out uint word) {
    birth = vec3(0.0);
    velocity = vec3(0.0);
    age = 0.0;
    word = 0u;
    return false;
}
