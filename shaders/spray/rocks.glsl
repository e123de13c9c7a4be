// Drops thrown up where surf breaks on rocks: each has its place on a rock, and starts when a crest gets there.
uniform sampler2D u_spray_rocks;  // place in the shore's square (m), way out to sea
uniform float u_spray_time[2];    // t modulo a period of the surf, and modulo 65536 periods, s
uniform float u_spray_period;     // s
uniform float u_spray_life;       // s
uniform float u_spray_speed;
uniform float u_spray_threshold;  // m/s

// birth: from the eye along x and z, its height; false: the drop is not in the air.
bool spray_born(int i, out vec3 birth, out vec3 velocity, out float age, out uint word) {
    uint own = noise_hash(uint(i));
    vec4 rock = texelFetch(u_spray_rocks, ivec2(i % SPRAY_ROCKS, 0), 0);
    vec2 along = vec2(-rock.w, rock.z);
    vec2 q = rock.xy + 2.0 * (spray_part(own, 0u) - 0.5) * along;
    ShoreField f = shore_field(q);
    // Crests are where the turn is a whole number; it falls as time goes on.
    float turn = -u_spray_time[0] / u_spray_period - f.here.r;
    int wave = int(floor(turn)) - int(floor((u_spray_time[1] - u_spray_time[0]) / u_spray_period + 0.5));
    word = noise_hash(own ^ uint(wave & 65535));
    // Waves do not break alike along a coast: patches of six metres, each wave anew, each burst a little after the crest.
    ivec2 spot = ivec2(floor(q / 6.0));
    uint burst = noise_hash(noise_hash(noise_hash(uint(spot.x)) ^ uint(spot.y)) ^ uint(wave & 65535));
    age = (1.0 - (turn - floor(turn))) * u_spray_period - SPRAY_DELAY * (0.7 * spray_part(burst, 0u) + 0.3 * spray_part(word, 1u));
    float strong = 0.3 + 0.7 * spray_part(burst, 1u);
    float start = u_spray_speed * sqrt(9.81 * max(f.here.g / 0.3, 0.0)) * strong;
    birth = vec3(q - shore_place(vec2(0.0)), f.here.g).xzy;
    // Jets, a metre and a half of rock each, lean out to sea and aside; their drops fan out about them.
    ivec2 jet = ivec2(floor(q / 1.5));
    uint way = noise_hash(noise_hash(noise_hash(uint(jet.x)) ^ uint(jet.y)) ^ uint(wave & 65535));
    float fast = start * (0.4 + 0.6 * spray_part(way, 0u)) * (0.25 + 0.75 * spray_part(word, 2u));
    float lean = 0.3 * spray_part(way, 1u) + 0.2 * spray_part(word, 4u) - 0.05;
    float aside = 0.7 * spray_part(way, 2u) + 0.3 * spray_part(word, 7u) - 0.5;
    velocity = vec3(0.0, fast * (0.8 + 0.2 * spray_part(word, 3u)), 0.0);
    velocity.xz = fast * (lean * rock.zw + aside * along);
    return age >= 0.0 && age < u_spray_life && start > u_spray_threshold;
}
