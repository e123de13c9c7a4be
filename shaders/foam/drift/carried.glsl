// The look's mask carried by the flow: two copies, each let go every second generation and carried until the next of its kind is there.
// Each thins its foam, and what neither covers stays free (foam/cover.glsl).
float foam_amount(float f, vec2 p, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    vec4 way;
    vec4 along_x;
    vec4 along_z;
    drift_ways(q, way, along_x, along_z);
    float grown = sin(0.5 * PI / DRIFT_GENERATION * drift_age(0));
    bool odd = (drift_generation(0) & 1u) == 1u;
    // Beyond the square the even copy alone is left, where it would be without any flow.
    float share = rim * (odd ? grown * grown : 1.0 - grown * grown);
    vec2 left = cover_free(clamp(f, 0.0, 1.0));
    float free = 1.0;
    // Asked at the end: drivers without branches would go through both where one has all the weight.
    int i = odd == (share > 0.0) ? 0 : 1;
    int copies = share > 0.0 && share < 1.0 ? 2 : 1;
    do {
        bool shifted = odd == (i == 0);
        vec2 back = rim * (i == 0 ? way.xy : way.zw);
        vec2 turn_x = rim * (i == 0 ? along_x.xy : along_x.zw);
        vec2 turn_z = rim * (i == 0 ? along_z.xy : along_z.zw);
        Footprint own = Footprint(fp.x + turn_x * fp.x.x + turn_z * fp.x.y, fp.y + turn_x * fp.y.x + turn_z * fp.y.y);
        vec2 apart = shifted ? vec2(DRIFT_APART_X, DRIFT_APART_Z) : vec2(0.0);
        free *= 1.0 - still_amount(cover_part(left, shifted ? share : 1.0 - share), p + back + apart, own);
        i = 1 - i;
        copies -= 1;
    } while (copies > 0);
    return 1.0 - free;
}
