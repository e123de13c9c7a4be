"""Seafoam: scenes compiled into frame plans, which a server and the browser draw alike.

This module contains nothing: import from the packages below it.
"""
