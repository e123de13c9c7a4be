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
layout(location = 0) out vec4 o_place;
layout(location = 1) out vec4 o_scattered;
layout(location = 2) out vec4 o_onward;

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int i = at.y * SPRAY_COLUMNS + at.x;
    vec4 traits = spray_entry(u_spray_births, i, 2);
    o_place = o_scattered = o_onward = vec4(0.0);
    if (traits.x <= 0.0) {
        return;
    }
    vec4 born = spray_entry(u_spray_births, i, 0);
    vec4 thrown = spray_entry(u_spray_births, i, 1);
    vec2 fall = spray_fall(traits.y, spray_part(uint(traits.z), 6u));
    float rides = spray_rides(traits.y, uint(traits.z), born.w);
    vec3 drop = spray_flight(born.xyz + rides * vec3(thrown.x, 0.0, thrown.z), thrown.xyz, born.w - rides, fall.x, fall.y);
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
    float sun = open_sun(drop + vec3(0.0, u_eye_height, 0.0), Footprint(vec2(0.0), vec2(0.0)));
    o_place = vec4(drop, spray_hidden(drop, depth) ? 0.0 : min(over / (0.35 / SPRAY_WIDER * thrown.w + 0.02), 1.0));
    o_scattered = vec4(spray_scattered(face, drop / away, sun, away), over);
    o_onward = vec4(spray_onward(drop / away, sun, away), 0.0);
}
