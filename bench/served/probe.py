"""``python -m bench.served.probe PORT PATH``: a probe in a process of its own, which no
thread of the benchmark delays.

It asks until its standard input ends, and prints the wall times, s, as JSON.
"""

import json
import sys
import threading

from bench.served.server import probe


def main() -> None:
    """Probe."""
    port, path = sys.argv[1:]
    over = threading.Event()
    found: list[float] = []
    asking = threading.Thread(target=probe, args=(int(port), path, found, over))
    asking.start()
    sys.stdin.read()
    over.set()
    asking.join()
    print(json.dumps(found))


if __name__ == "__main__":
    main()
