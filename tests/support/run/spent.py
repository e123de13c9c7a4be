"""Writes a table of the dearest files of tests into docs/tests.md, from what ``make test SPENT=FILE`` left."""

import json
import sys
from collections import Counter
from pathlib import Path

DOCUMENT = Path(__file__).parents[3] / "docs" / "tests.md"
BEGIN, END = "<!-- spent: begin -->\n", "<!-- spent: end -->\n"
ROWS = 25


def main(file: Path) -> None:
    spent: Counter[str] = Counter()
    for line in file.read_text(encoding="utf-8").splitlines():
        spent.update(json.loads(line))
    rows = "".join(f"| `{name}` | {seconds:.0f} |\n" for name, seconds in spent.most_common(ROWS))
    table = f"| file | seconds, of {spent.total():.0f} |\n|---|---|\n{rows}"
    head, rest = DOCUMENT.read_text(encoding="utf-8").split(BEGIN)
    DOCUMENT.write_text(head + BEGIN + table + END + rest.split(END)[1], encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
