"""Land, shallows and the waves that reach them."""
