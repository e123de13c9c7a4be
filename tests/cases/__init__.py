"""Cases of the effects of the package, by the names of their modules."""
