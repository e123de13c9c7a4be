"""One module for each resource of the API.

Routers do not import each other's private parts; what several need is in :mod:`seafoam.api`.
"""
