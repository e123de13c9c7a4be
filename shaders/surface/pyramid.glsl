// tau before which the tile's rays are known to be free, of water and of land over y = 0.
vec2 pyramid_free = vec2(0.0);

// The rays of a tile of the picture, between ray - side - top and ray + side + top.
struct Pyramid {
    float aside;  // how far from the middle ray they are at most, m a unit: level
    float raised; // and upright
    float speed;  // m a unit, level, of the fastest
    float reach;  // tau beyond which nothing is looked for
};

Pyramid pyramid(vec3 ray, vec3 side, vec3 top) {
    float aside = length(side.xz) + length(top.xz);
    float speed = length(ray.xz) + aside;
    return Pyramid(aside, abs(side.y) + abs(top.y), speed, 1e5 / max(speed, 1e-6 * length(ray)));
}

// tau at which the first of the rays comes to a level that the eye is `over` metres over (0: it is beyond); toward: m a unit.
float pyramid_enters(Pyramid rays, float over, float toward) {
    return over > 0.0 ? (toward > 0.0 ? over / toward : rays.reach) : 0.0;
}
