// What the wakes of boats add to the surface: heights over still water, slopes along x and z.

// Height, gradient, and the mean square wavenumber where slopes are.
vec4 wake_sum(vec2 p) {
    vec4 sum = vec4(0.0);
    float weight = 1e-12;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        WakeWay way = wake_way(i, p);
        vec4 here = wake_here(i, vec2(way.behind, abs(way.aside)));
        vec2 slope = here.y * way.on_behind + (way.aside < 0.0 ? -here.z : here.z) * way.on_aside;
        float steep = dot(slope, slope);
        sum += vec4(here.x, slope, here.w * steep);
        weight += steep;
    }
    return vec4(sum.xyz, sum.w / weight);
}

vec3 wakes_waves(vec2 p) {
    return wake_sum(p).xyz;
}

// The same without what is smaller than the footprint, and the unresolved mean square slope.
vec4 wakes_shading(vec2 p, Footprint fp) {
    vec4 here = wake_sum(p);
    float kept = 1.0;
    if (SURFACE_FILTER) {
        kept = wave_kept(here.w, fp);
    }
    return vec4(kept * here.xyz, (1.0 - kept * kept) * dot(here.yz, here.yz));
}
