"""Plans and frames of requests: compiled, cached, answered, streamed."""
