"""Effects of light: sun, sky, clouds, moon and stars, glitter, and reflections in the water."""
