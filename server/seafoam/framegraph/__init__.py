"""The frame graph: rules, resources, passes and plans, what a picture needs of them, and uniforms' values."""
