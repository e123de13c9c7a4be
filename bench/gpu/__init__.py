"""What a GPU draws, how right and how fast, in five minutes: ``python -m bench.gpu``, or ``make gpu``."""

import sys
from pathlib import Path

# The bounds that frames are held to are those of the tests.
sys.path.append(str(Path(__file__).resolve().parents[2] / "tests"))
