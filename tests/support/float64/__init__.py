"""Float64 forms of what only tests compute."""
