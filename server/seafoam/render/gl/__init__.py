"""The OpenGL executor: draws plans at given times from given cameras.

It imports the frame graph and textures, but neither effects nor the planner.
"""
