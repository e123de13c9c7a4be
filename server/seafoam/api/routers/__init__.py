"""One module a resource of the API. What several need stands in :mod:`seafoam.api`."""
