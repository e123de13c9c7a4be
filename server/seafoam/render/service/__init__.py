"""Worker processes that draw for a server."""
