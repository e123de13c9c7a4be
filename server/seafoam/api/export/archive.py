"""Zip archives, streamed, whose bytes depend on their contents alone."""

import io
import zipfile
from collections.abc import Iterable, Iterator

EPOCH = (1980, 1, 1, 0, 0, 0)
"""Time of every entry: the earliest that zip can hold."""
LEVEL = 6
_REGULAR_FILE = 0o100644


class _Sink(io.RawIOBase):
    """Keeps what is written until it is taken; cannot seek, so the archive is written from front to back."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        content = bytes(data)  # type: ignore[call-overload]
        self._parts.append(content)
        return len(content)

    def take(self) -> bytes:
        content = b"".join(self._parts)
        self._parts.clear()
        return content


def zipped(entries: Iterable[tuple[str, bytes]]) -> Iterator[bytes]:
    """Yield the parts of a zip archive with these entries (path, content) in their order.

    Times, permissions and the system are fixed, so the same entries give the same bytes with the same zlib.
    """
    sink = _Sink()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL) as archive:
        for path, content in entries:
            entry = zipfile.ZipInfo(path, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = _REGULAR_FILE << 16
            archive.writestr(entry, content, compresslevel=LEVEL)
            yield sink.take()
    yield sink.take()
