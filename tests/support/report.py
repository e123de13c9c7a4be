"""Figures that tests measure, printed as tables when the run is over."""


class Report:
    """Tables by title; a row is a dict of words."""

    def __init__(self) -> None:
        self.tables: dict[str, list[dict[str, str]]] = {}

    def add(self, title: str, **row: str) -> None:
        """Add a row to a table."""
        self.tables.setdefault(title, []).append(row)

    def lines(self) -> list[str]:
        """The tables as text."""
        lines: list[str] = []
        for title, rows in self.tables.items():
            names = list(rows[0])
            widths = [max(len(name), *(len(row[name]) for row in rows)) for name in names]
            lines += [
                "",
                title,
                "  ".join(name.replace("_", " ").ljust(w) for name, w in zip(names, widths, strict=True)),
            ]
            lines += ["  ".join(row[name].ljust(w) for name, w in zip(names, widths, strict=True)) for row in rows]
        return lines


REPORT = Report()
"""The one report of a run."""
