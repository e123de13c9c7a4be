"""What drawing costs: frames, passes, effects, and programs against others."""
