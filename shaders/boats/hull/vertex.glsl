// The rectangle of the picture that holds every boat's box, and three samples more for rays beside the middle ones. Drivers without
// branches would trace boats in every sample of the picture, to find none.
const float BOAT_NEAREST = 1e-2; // of a corner before the eye, m

void main() {
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec2 low = vec2(1.0);
    vec2 high = vec2(-1.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        BoatFrame f = boat_frame(i);
        float size = u_boat_form[i].x;
        vec2 least = vec2(1e30);
        vec2 most = vec2(-1e30);
        float nearest = 1e30;
        float farthest = -1e30;
        for (int corner = 0; corner < 8; ++corner) {
            vec3 side = vec3(corner & 1, (corner >> 1) & 1, corner >> 2) * 2.0 - 1.0;
            vec3 local = size * (BOAT_BOX_MIDDLE + side * BOAT_BOX_HALF);
            vec3 place = f.at - vec3(0.0, u_eye_height, 0.0) + local.x * f.ahead + local.y * f.up + local.z * f.right;
            float depth = dot(place, u_ray_z);
            vec2 clip = vec2(dot(place, u_ray_x), dot(place, u_ray_y)) / (squares * max(depth, BOAT_NEAREST));
            least = min(least, clip);
            most = max(most, clip);
            nearest = min(nearest, depth);
            farthest = max(farthest, depth);
        }
        // A box that is partly behind the eye may show anywhere, one that is wholly behind it nowhere.
        bool shows = farthest > 0.0;
        bool anywhere = shows && nearest <= BOAT_NEAREST;
        low = anywhere ? vec2(-1.0) : shows ? min(low, least) : low;
        high = anywhere ? vec2(1.0) : shows ? max(high, most) : high;
    }
    vec2 pad = 6.0 / u_viewport;
    low = clamp(low - pad, -1.0, 1.0);
    high = max(clamp(high + pad, -1.0, 1.0), low);
    gl_Position = vec4(mix(low, high, greaterThan(quad_corner(), vec2(0.0))), FULLSCREEN_DEPTH, 1.0);
}
