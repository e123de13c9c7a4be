"""Pages, and previews of links to them."""
