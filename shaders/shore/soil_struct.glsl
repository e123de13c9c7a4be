// What a ray sees of land. normal: unit vector of its relief; film: how much of it a film of water mirrors.
struct Soil {
    vec3 normal;
    vec3 albedo;
    float film;
};
