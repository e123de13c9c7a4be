"""What a mask is like: spectra, shapes of its foam, and plots of both."""
