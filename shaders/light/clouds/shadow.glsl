// The lamp's light past the clouds at a place, over its mean there: a column of the clouds where the way to the lamp meets them.
// docs/formulae.md, section 9. place: m from under the eye, y over still water.
uniform vec4 u_cloud_sunward; // way from still water to the clouds, along x and z, and up in them; deviation of the penumbra; cells
uniform vec3 u_cloud_gap;     // noise in the middle of the clouds' edge, its variance there, transmittance of the thickest
uniform vec2 u_cloud_shade;   // strength; mean transmittance

float cloud_sunlit(vec3 place, Footprint fp) {
    float cell = 1.0 / u_cloud_shape.y;
    float left = max(1.0 - place.y / u_cloud_shape.x, 0.0);
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    vec3 at = eye + vec3(place.xz * cell, 0.0) + vec3(left, left, 1.0) * u_cloud_sunward.xyz;
    // The footprint is a box, of a twelfth of its side's square in variance.
    float side2 = max(dot(fp.x, fp.x), dot(fp.y, fp.y)) * cell * cell / 12.0;
    float width = CLOUD_WIDTH * sqrt(side2 + u_cloud_sunward.w * u_cloud_sunward.w);
    float lost;
    float noise = cloud_octaves(at, width, CLOUD_SHADOW_OCTAVES, lost).x;
    // A mean over the lost noise, which is normal, as the edge is: as much wider.
    float x = clamp((u_cloud_gap.x - noise) * inversesqrt(u_cloud_gap.y + max(lost, 0.0)), -6.0, 6.0);
    float open = 1.0 / (1.0 + exp(-1.5976 * x - 0.07056 * x * x * x));
    float passed = mix(u_cloud_gap.z, 1.0, open);
    float under = 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x);
    return mix(1.0, passed / u_cloud_shade.y, under * u_cloud_shade.x);
}
