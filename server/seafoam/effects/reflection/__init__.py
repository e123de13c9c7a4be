"""What the water mirrors beside the sky: cubemaps, boats and land."""
