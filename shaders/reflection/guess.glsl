// How far along the reflected ray the boat may be that comes nearest to it, m; negative: none comes near.
float mirror_guess(vec3 place, vec3 r) {
    float best = 1.0;
    float way = -1.0;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        float size = u_boat_form[i].x;
        vec2 at = boat_place(i);
        vec3 to = vec3(at.x, 0.35 * size, at.y) - place;
        float along = dot(to, r);
        float miss = (dot(to, to) - along * along) / (size * size);
        // What a boat is, and how far it may tilt and rise, is within its length of there.
        if (along > -size && miss < best) {
            best = miss;
            way = max(along, 0.01);
        }
    }
    return way;
}
