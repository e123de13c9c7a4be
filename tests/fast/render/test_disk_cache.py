"""What the renderer keeps on disk and in shared memory."""

import ast
import asyncio
import errno
import os
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import seafoam
from seafoam.files import only_writer, whole, write_whole
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.encode import encode
from seafoam.render.service import frame_cache as module
from seafoam.render.service.frame_cache import ABANDONED_SECONDS, DiskCache
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.shared_buffer import KEPT_BYTES, LEAST_BYTES, BufferPool, SharedBuffer, SharedPixels, send
from seafoam.scene import Scene
from support.api_fakes import FakeRenderer

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


SIDE = 512


def noise(seed: int, type: type = np.uint16) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (SIDE, SIDE, 4)).astype(type)


@pytest.mark.parametrize("type", [np.uint8, np.uint16, np.float32])
def test_pixels_arrive_and_stay_after_the_buffer_is_closed(type: type) -> None:
    buffer = SharedBuffer(noise(1, type).nbytes)
    sent = send(noise(1, type), buffer.address)
    assert isinstance(sent, SharedPixels)
    pixels = buffer.received(sent)
    buffer.close()
    np.testing.assert_array_equal(pixels, noise(1, type))


def test_small_pixels_and_those_that_do_not_fit_go_with_the_answer() -> None:
    assert SharedBuffer(LEAST_BYTES - 1).address is None
    buffer = SharedBuffer(LEAST_BYTES)
    for address in (None, buffer.address):
        assert send(noise(2), address) is not None
        assert not isinstance(send(noise(2), address), SharedPixels)
    pixels = noise(2)
    assert buffer.received(pixels) is pixels
    buffer.close()


def test_a_buffer_that_the_parent_has_closed_is_not_written_to() -> None:
    first = SharedBuffer(noise(3).nbytes)
    address = first.address
    first.close()
    np.testing.assert_array_equal(send(noise(3), address), noise(3))
    # Its file's number is another buffer's now.
    second = SharedBuffer(noise(3).nbytes)
    assert second.address.serial != address.serial
    second.close()


def test_buffers_are_used_again_within_bounds() -> None:
    buffers = BufferPool(2)
    taken = [buffers.take(1 << 20) for _ in range(3)]
    open_before = len(os.listdir("/proc/self/fd"))
    for buffer in taken:
        buffers.give_back(buffer)
    assert len(os.listdir("/proc/self/fd")) < open_before
    assert buffers.take(1 << 19) in taken
    assert buffers.take(1 << 14) not in taken  # far too large for it
    large = buffers.take(KEPT_BYTES + 1)
    buffers.give_back(large)
    assert large.address is None
    buffers.close()


@pytest.mark.anyio
async def test_frames_of_a_pool_are_what_its_renderer_drew() -> None:
    """Several at once and in turn, in one size, so that buffers are used again."""
    scene = Scene()
    pool = RenderPool(workers=1, queue=16, deadline=60.0, factory=FakeRenderer)
    await pool.start()
    try:
        jobs = [FrameJob(scene, TIERS["fast"], time, scene.camera, SIDE, SIDE, "npy") for time in range(8)]
        drawn = [frame.content for frame in await asyncio.gather(*(pool.render(job) for job in jobs))]
    finally:
        await pool.stop()
    renderer, plan = FakeRenderer(), make_plan(scene, TIERS["fast"])
    asked = {"camera": scene.camera, "width": SIDE, "height": SIDE, "output": "linear"}
    assert drawn == [encode(renderer.render(plan, time=time, **asked).pixels, "npy") for time in range(8)]
    assert len(set(drawn)) == 8


HOLDER = """
import sys
from pathlib import Path
from seafoam.files import only_writer
with only_writer(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_each_of_two_writers_has_a_file_of_its_own_and_one_that_fails_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "a"
    with whole(path) as first:
        with whole(path) as second:
            first.write_bytes(b"first")
            second.write_bytes(b"second")
            assert not path.exists()
        assert path.read_bytes() == b"second"
    assert path.read_bytes() == b"first"
    assert os.listdir(tmp_path) == ["a"]
    write_whole(path, b"before")
    with pytest.raises(OSError, match="full"), whole(path) as part:  # noqa: PT012
        part.write_bytes(b"half")
        raise OSError("full")
    assert path.read_bytes() == b"before"
    assert os.listdir(tmp_path) == ["a"]


def test_links_rights_and_pipes_are_as_if_it_were_written_in_place(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("a")
    write_whole(tmp_path / "link", b"x")
    assert (tmp_path / "a").read_bytes() == b"x"
    assert (tmp_path / "link").is_symlink()
    (tmp_path / "b").write_bytes(b"x")
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == stat.S_IMODE((tmp_path / "b").stat().st_mode)
    os.mkfifo(tmp_path / "pipe")
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append((tmp_path / "pipe").read_bytes()))
    reader.start()
    write_whole(tmp_path / "pipe", b"through")
    reader.join(10)
    assert read == [b"through"]
    write_whole(tmp_path / ("n" * 251 + ".png"), b"a name as long as file systems allow")


def test_a_directory_has_one_writer_among_processes_and_threads(tmp_path: Path) -> None:
    path = tmp_path / "run"
    command = [sys.executable, "-c", HOLDER, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(BlockingIOError), only_writer(path):
            pass
        holder.kill()
        holder.wait()
        with only_writer(path), pytest.raises(BlockingIOError), only_writer(path):
            pass


def test_a_directory_that_its_writer_removed_is_made_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    opened = os.open
    taken: list[int] = []

    def late(name: Path, flags: int) -> int:
        handle = opened(name, flags)
        if not taken:
            path.rmdir()  # by the one that had it, between the opening and the lock
        taken.append(handle)
        return handle

    monkeypatch.setattr(os, "open", late)
    with only_writer(path):
        assert path.is_dir()
    assert len(taken) == 2


def test_nothing_else_writes_files() -> None:
    """Every writer of the package takes ``files``; buffers in memory and the log of hashes are none."""
    found = set()
    for path in Path(seafoam.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Attribute) and node.attr in ("write_bytes", "write_text", "mkstemp"):
                found.add((path.name, node.attr))
            if isinstance(node, ast.Attribute) and ast.unparse(node) == "os.replace":
                found.add((path.name, node.attr))
    assert found == {("files.py", "write_bytes"), ("files.py", "replace")}
