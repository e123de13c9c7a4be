// A boat's axes as it floats now, and the box that holds it. Metres from the eye's own (x, z).
uniform sampler2D u_boat_pose;

const vec3 BOAT_BOX_MIDDLE = vec3(0.03, 0.5, 0.0); // ahead, up, right; boat lengths
const vec3 BOAT_BOX_HALF = vec3(0.56, 0.74, 0.5);

struct BoatFrame {
    vec3 at;
    vec3 ahead;
    vec3 up;
    vec3 right;
};

BoatFrame boat_frame(int i) {
    vec3 pose = texel_at(u_boat_pose, ivec2(i, 0)).xyz;
    vec2 place = boat_place(i);
    vec2 heading = boat_forward(i);
    vec3 up = normalize(vec3(-pose.y, 1.0, -pose.z));
    vec3 ahead = vec3(heading.x, 0.0, heading.y);
    ahead = normalize(ahead - dot(ahead, up) * up);
    vec3 right = cross(ahead, up);
    vec2 heel = u_boat_form[i].zw;
    return BoatFrame(vec3(place.x, pose.x, place.y), ahead, heel.x * up + heel.y * right, heel.x * right - heel.y * up);
}
