// A level floor.
uniform vec3 u_floor_albedo;
uniform float u_floor_depth; // under still water, m
