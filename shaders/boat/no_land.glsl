// Open sea: no land stands before a boat.
bool boat_behind_land(vec3 ray, float farthest) {
    return false;
}
