"""Effects that displace or tilt the surface: parametric waves, seas, rings, ripples."""
