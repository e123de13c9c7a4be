"""What accuracy costs in time: every tier and every single knob, measured for time and for error against float64.

The reference says what the picture should be, the renderer draws it at each quality, and both are compared: a table,
the front of what is worth having, and the quality to take for a given number of milliseconds.
"""
