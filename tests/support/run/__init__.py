"""What watches over a run of the tests: its memory, its work."""
