"""Files that have their names only when they are complete, and directories that one process writes at a time."""

import contextlib
import os
import secrets
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PART = ".seafoam-part-"
"""Start of the names of files that are being written."""


@contextmanager
def whole(path: Path, *, alone: bool = False) -> Iterator[Path]:
    """Give a file to write, which replaces ``path`` when the block ends without an error.

    It is absolute, in the same directory, and another one for every writer: of several at once the last one's file is
    there, whole. A link stays, and what it leads to is replaced. alone: the caller sees to it that there is one writer,
    who then goes over what a killed one has left. Raises ``OSError``.
    """
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():  # a pipe or a device, whose place no file can take
        yield target
        return
    own = f"{zlib.crc32(os.fsencode(target.name)):08x}" if alone else secrets.token_hex(8)
    part = target.with_name(f"{PART}{own}")
    try:
        yield part
        os.replace(part, target)
    except BaseException:
        with contextlib.suppress(OSError):
            part.unlink()
        raise


def write_whole(path: Path, content: bytes) -> None:
    """Write a file as :func:`whole` does. Raises ``OSError``."""
    with whole(path) as part:
        part.write_bytes(content)


@contextmanager
def only_writer(directory: Path) -> Iterator[None]:
    """Create a directory, and keep others who ask for it out of it until the block ends.

    Raises ``BlockingIOError`` while another one writes it, and ``OSError``. Windows and some network file systems
    cannot lock directories: there nobody is kept out.
    """
    with contextlib.ExitStack() as opened:
        while True:
            directory.mkdir(parents=True, exist_ok=True)
            if os.name == "nt":
                break
            import fcntl

            try:
                handle = os.open(directory, os.O_RDONLY)
                opened.callback(os.close, handle)
                try:
                    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    raise
                except OSError:
                    break
                if os.path.samestat(os.fstat(handle), directory.stat()):
                    break
            except FileNotFoundError:
                pass  # the one before has just removed it
        yield
