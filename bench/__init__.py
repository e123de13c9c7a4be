"""What Seafoam costs: frames by look and tier, requests by stage, and the page's first picture. ``python -m bench``."""
