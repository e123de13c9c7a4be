// What a wake is drawn from, wherever its boat is.
uniform vec4 u_wake[BOAT_COUNT];      // k (rad/m), height (m), length (m), shortest waves (rad/m)
uniform vec2 u_wake_boat[BOAT_COUNT]; // the boat's length and its circle's radius, m
