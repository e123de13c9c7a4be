"""The widget for notebooks, and what its page asks of Python. It needs the extra ``notebook``."""

from seafoam.extras import require

require("notebook")

from seafoam.notebook.widget import WaterWidget as Water  # noqa: E402 (without anywidget the import fails without the remedy)

__all__ = ["Water"]
