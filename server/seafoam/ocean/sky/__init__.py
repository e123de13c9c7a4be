"""Light that the air scatters."""
