"""The frame graph: rules, resources, passes and plans, the passes that a picture needs, and the values of uniforms.

Of the rest of Seafoam it imports only the camera.
"""
