"""The cache on disk: bounded, and never anything else than what was put in, whatever happens to disk and process."""

import errno
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from seafoam.render.service import frame_cache as module
from seafoam.render.service.frame_cache import ABANDONED_SECONDS, DiskCache

BLOCK = 4096


def files(cache: DiskCache) -> list[Path]:
    return sorted(path for path in cache.directory.rglob("*") if path.is_file())


def size(cache: DiskCache) -> int:
    return sum(-(-path.stat().st_size // BLOCK) * BLOCK for path in files(cache))


@pytest.fixture
def cache(tmp_path: Path) -> DiskCache:
    return DiskCache(tmp_path / "frames", 100 * BLOCK)


def test_what_is_put_in_comes_out_also_after_a_restart_unless_it_is_too_large(cache: DiskCache) -> None:
    assert cache.get("ab12") is None
    for content in (b"", b"x", os.urandom(50_000)):
        assert cache.put("ab12", content)
        assert cache.get("ab12") == content
        assert DiskCache(cache.directory, cache.limit).get("ab12") == content
    assert len(files(cache)) == 1
    cache.put("aa", b"small")
    assert not cache.put("bb", bytes(cache.limit))
    assert cache.get("aa") == b"small"


@pytest.mark.parametrize("damage", ["cut off", "one bit", "emptied", "longer", "no header"])
def test_a_damaged_file_is_absent_and_removed(cache: DiskCache, damage: str) -> None:
    cache.put("ab12", os.urandom(9000))
    (path,) = files(cache)
    stored = bytearray(path.read_bytes())
    if damage == "one bit":
        stored[5000] ^= 4
    kept = {"cut off": stored[:4000], "emptied": b"", "longer": stored + b"x", "no header": stored[40:]}
    path.write_bytes(kept.get(damage, stored))
    assert cache.get("ab12") is None
    assert files(cache) == []
    assert cache.damaged == 1
    assert cache.put("ab12", b"again")
    assert cache.get("ab12") == b"again"


def test_it_stays_within_its_limit_and_forgets_what_was_read_longest_ago(cache: DiskCache) -> None:
    for number in range(60):
        cache.put(f"{number:02d}", bytes(BLOCK))  # with its header, two blocks
        stamp = time.time() - 1000 + number
        os.utime(next(path for path in files(cache) if path.name == f"{number:02d}"), (stamp, stamp))
        assert size(cache) <= cache.limit
        if number == 40:
            assert cache.get("00") is not None  # read now, so it stays
    held = {path.name for path in files(cache)}
    assert "00" in held
    assert "59" in held
    assert "01" not in held
    assert len(held) >= 40


def test_files_of_another_process_count_too(cache: DiskCache) -> None:
    other = DiskCache(cache.directory, cache.limit)
    for number in range(30):
        cache.put(f"a{number:02d}", bytes(BLOCK))
        other.put(f"b{number:02d}", bytes(BLOCK))
    # Each knows of the other's files when it counts again, which it does before its own exceed the limit.
    assert size(cache) <= 2 * cache.limit
    fresh = DiskCache(cache.directory, cache.limit)
    fresh.put("c", bytes(BLOCK))
    assert size(cache) <= cache.limit


@pytest.mark.parametrize("at", ["write", "sync", "rename"])
def test_a_full_disk_leaves_nothing_behind_and_is_left_in_peace(
    cache: DiskCache, monkeypatch: pytest.MonkeyPatch, at: str
) -> None:
    cache.put("aa", b"before")
    tries = []

    def full(*_: object) -> None:
        tries.append(1)
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        owner, name = {"write": (Path, "open"), "sync": (module.os, "fsync"), "rename": (module.os, "replace")}[at]
        patched.setattr(owner, name, full)
        assert not cache.put("bb", b"content")
        assert not cache.put("cc", b"content")
    assert len(tries) == 1
    assert cache.failures == 1
    assert [path.name for path in files(cache)] == ["aa"]
    assert cache.get("aa") == b"before"
    assert not cache.put("bb", b"content")  # still within the minute
    monkeypatch.setattr(module.time, "monotonic", lambda: 1e9)
    assert cache.put("bb", b"content")


def test_a_folder_that_cannot_be_made_is_an_empty_cache(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    cache = DiskCache(tmp_path / "file" / "frames", 1 << 20)
    assert cache.get("aa") is None
    assert not cache.put("aa", b"content")


def test_a_writer_killed_midway_leaves_no_file_under_a_name(tmp_path: Path) -> None:
    program = (
        "import os, signal, sys\n"
        "from pathlib import Path\n"
        "from seafoam.render.service.frame_cache import DiskCache\n"
        "os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)\n"
        "DiskCache(Path(sys.argv[1]), 1 << 20).put('aa', bytes(100_000))\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False)
    assert done.returncode == -signal.SIGKILL
    cache = DiskCache(tmp_path, 1 << 20)
    assert cache.get("aa") is None
    (left,) = files(cache)
    cache.put("bb", b"content")
    assert left in files(cache)  # its writer might still be at work
    old = time.time() - 2 * ABANDONED_SECONDS
    os.utime(left, (old, old))
    DiskCache(tmp_path, 1 << 20).put("cc", b"content")
    assert left not in files(cache)
