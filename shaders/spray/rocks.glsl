// Water thrown up where surf breaks on rocks: each drop has its place on a rock, and starts when a crest gets there.
uniform sampler2D u_spray_rocks;  // place in the shore's square (m), way out to sea
uniform float u_spray_surf_time[2]; // t modulo a period of the surf, and modulo 65536 periods, s
uniform float u_spray_surf_life;  // s

bool rock_born(int i, bool high, out Drop drop) {
    uint own = noise_hash(uint(i));
    vec4 rock = texel_at(u_spray_rocks, ivec2(i % SPRAY_ROCKS, 0));
    vec2 along = vec2(-rock.w, rock.z);
    vec2 q = rock.xy + 2.0 * (spray_part(own, 0u) - 0.5) * along;
    ShoreField f = shore_field(q);
    // Crests are where the turn is a whole number; it falls as time goes on.
    float turn = -u_spray_surf_time[0] / u_spray_period - f.here.r;
    int wave = int(floor(turn)) - int(floor((u_spray_surf_time[1] - u_spray_surf_time[0]) / u_spray_period + 0.5));
    drop.word = noise_hash(own ^ uint(wave & 65535));
    // Waves do not break alike along a coast: patches of six metres, each wave anew, each burst a little after the crest.
    ivec2 spot = ivec2(floor(q / 6.0));
    uint burst = noise_hash(noise_hash(noise_hash(uint(spot.x)) ^ uint(spot.y)) ^ uint(wave & 65535));
    drop.age = (1.0 - (turn - floor(turn))) * u_spray_period - SPRAY_DELAY * (0.7 * spray_part(burst, 0u) + 0.3 * spray_part(drop.word, 1u));
    float strong = 0.3 + 0.7 * spray_part(burst, 1u);
    float start = u_spray_speed * sqrt(9.81 * max(f.here.g / 0.3, 0.0)) * strong;
    vec2 p = q - shore_place(vec2(0.0));
    drop.birth = vec3(p.x, 0.0, p.y);
    if (high) {
        drop.birth.y = shore_then(f, q, drop.age) + f.here.a * (fronts_then(p, drop.age).x + rings_then(p, drop.age));
    }
    // Jets, a metre and a half of rock each, lean out to sea and aside; their drops fan out about them.
    ivec2 jet = ivec2(floor(q / 1.5));
    uint way = noise_hash(noise_hash(noise_hash(uint(jet.x)) ^ uint(jet.y)) ^ uint(wave & 65535));
    float fast = start * (0.4 + 0.6 * spray_part(way, 0u)) * (0.25 + 0.75 * spray_part(drop.word, 2u));
    float lean = 0.3 * spray_part(way, 1u) + 0.2 * spray_part(drop.word, 4u) - 0.05;
    float aside = 0.7 * spray_part(way, 2u) + 0.3 * spray_part(drop.word, 7u) - 0.5;
    drop.velocity = vec3(0.0, fast * (0.8 + 0.2 * spray_part(drop.word, 3u)), 0.0);
    drop.velocity.xz = fast * (lean * rock.zw + aside * along);
    drop.kind = spray_part(drop.word, 5u) < u_spray_mist ? SPRAY_MIST : SPRAY_SHEET;
    drop.radius = 4.5 * u_spray_size * SPRAY_WIDER;
    drop.life = u_spray_surf_life;
    drop.strength = drop.kind == SPRAY_MIST ? 0.3 : 0.8;
    return drop.age >= 0.0 && drop.age < drop.life && start > u_spray_threshold;
}
