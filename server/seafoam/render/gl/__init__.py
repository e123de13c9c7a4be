"""The OpenGL executor: plans, times and cameras become pixels.

It imports the frame graph and textures, neither effects nor the planner.
"""
