"""Long work beside requests, on the render pool: sweeps of accuracy, and sequences."""
