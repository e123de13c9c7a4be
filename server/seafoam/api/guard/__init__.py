"""Who may ask, how often, and from where: keys, signed links, rates, other origins, proxies."""
