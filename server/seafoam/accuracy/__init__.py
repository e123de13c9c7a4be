"""The cost of accuracy in time: every tier and every setting, measured for time and for error against float64.

The float64 reference gives the correct picture, the renderer draws it at each quality, and the comparison gives a
table, the Pareto front, and the quality to use for a given time budget in milliseconds.
"""
