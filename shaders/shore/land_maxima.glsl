// Heights of the land, by cells of a square: levels of half as many cells side by side. r: what it reaches at most in a cell; g: in that
// and the eight round it; b, a, of the finest level: the heights from which the sun's upper and lower rim are seen over it; m.
uniform sampler2D u_land_maxima;
