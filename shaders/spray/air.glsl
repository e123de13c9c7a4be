// Water in the air as a veil.

// @part thick
// All drops before a sample: what their water hides by its optical depth, and the mean of its light. Premultiplied.
uniform sampler2D u_spray_thick;
out vec4 o_color;

void main() {
    vec4 sum = textureLod(u_spray_thick, sample_place() / u_viewport, 0.0);
    if (sum.a < 1e-4) {
        discard;
    }
    float cover = 1.0 - exp(-sum.a);
    o_color = vec4(sum.rgb * (cover / sum.a), cover);
}

// @part air
// The drops as they are now: place from the eye (m) and how much of one is seen; scattered light and
// height over the surface (m); and light of the sun that goes on.
out vec4 o_air;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int part = at.y / SPRAY_ROWS;
    int i = (at.y - part * SPRAY_ROWS) * SPRAY_COLUMNS + at.x;
    vec4 traits = spray_entry(u_spray_births, i, 2);
    o_air = vec4(0.0);
    if (traits.x <= 0.0) {
        return;
    }
    vec4 born = spray_entry(u_spray_births, i, 0);
    vec4 thrown = spray_entry(u_spray_births, i, 1);
    vec2 fall = spray_fall(traits.y, spray_part(uint(traits.z), 6u));
    vec3 drop = spray_flight(born.xyz, thrown.xyz, born.w, fall.x, fall.y);
    drop.y -= u_eye_height;
    float depth = dot(drop, u_ray_z);
    float away = length(drop);
    if (depth < 0.3) {
        return;
    }
    // Nothing of one under the surface is seen, nor does an eye under it see any.
    float over = spray_over(drop);
    if (over <= 0.0 || u_eye_height < waves(vec2(0.0)).x) {
        return;
    }
    // Outward of where they fly: a column has a bright and a dark side.
    vec2 aside = thrown.xz / max(length(thrown.xz), 1e-3);
    vec3 face = vec3(0.8 * aside, 0.6).xzy;
    vec3 place = drop + vec3(0.0, u_eye_height, 0.0);
    float sun = part == 0 ? 1.0 : open_sun(place, Footprint(vec2(0.0), vec2(0.0)));
    if (part == 0) {
        o_air = vec4(drop, spray_hidden(drop, depth) ? 0.0 : min(over / (0.35 / SPRAY_WIDER * thrown.w + 0.02), 1.0));
    } else if (part == 1) {
        o_air = vec4(spray_scattered(face, drop / away, sun, away), over);
    } else {
        o_air = vec4(spray_onward(drop / away, sun, away), 0.0);
    }
}
