"""Waves: tiles of a sea, groups, ripples, rings, wakes, and the drift of water."""
