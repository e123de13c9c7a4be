"""What Seafoam costs: frames by look and tier, requests by stage, and the page's first picture. ``python -m bench``."""

import sys
from pathlib import Path

# Scenes and bounds are those of the tests.
sys.path.append(str(Path(__file__).resolve().parents[1] / "tests"))
