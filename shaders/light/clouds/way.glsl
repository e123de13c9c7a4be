// The way to a layer that is high (m) over the eye of a round earth, and the sine of the look's slant there.
const float EARTH = 6.371e6;   // radius, m
const float CLOUD_WIDTH = 1.4; // of a cell's fading, over the deviation of looks that fades it

vec2 way_to_layer(vec3 d, float high) {
    float along = EARTH * d.y;
    // Without the difference of two great numbers.
    float rest = (2.0 * EARTH + high) * high;
    float way = rest / (along + sqrt(along * along + rest));
    return vec2(way, (along + way) / (EARTH + high));
}
