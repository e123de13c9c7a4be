// Fronts of waves in groups: a front that is none of the waves' own has their factor too.
uniform vec2 u_front_advance; // way of a group past water that drifts, m/rad of the mean phase

// Factor of the waves that passed the water at q, `ago` of the mean phase (rad) before.
float front_group(vec2 q, float ago) {
    return wave_groups(q + u_front_advance * ago).x;
}
