"""Figures that tests measure, printed as tables when the run is over."""


class Report:
    """Tables by title; a row is a dict of words."""

    def __init__(self) -> None:
        self.tables: dict[str, list[dict[str, str]]] = {}

    def add(self, title: str, **row: str) -> None:
        """Add a row to a table."""
        self.tables.setdefault(title, []).append(row)

    def within(self, title: str, /, **row: object) -> None:
        """Add a row, and fail where a figure is over its bound: a pair is both, all else says what the row is of."""
        bounded = {name: value for name, value in row.items() if isinstance(value, tuple)}
        words = {name: f"{found:.3g} (bound {most:.3g})" for name, (found, most) in bounded.items()}
        plain = {name: f"{value:g}" if isinstance(value, float) else str(value) for name, value in row.items()}
        self.add(title, **plain | words)
        # NaN exceeds every bound.
        over = [f"{name} {found:.4g} > {most:.4g}" for name, (found, most) in bounded.items() if not found <= most]
        assert not over, f"{title}: {', '.join(over)}"

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
