"""The frame graph: rules, resources, passes and plans, what a picture needs of them, and their numbers.

It imports the camera and nothing else of Seafoam.
"""
